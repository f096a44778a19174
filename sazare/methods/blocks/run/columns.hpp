#pragma once

/// What runs of method blocks write: columns of their tables, fields of their snapshots, headline figures of their manifests, all
/// in their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::blocks {

using observe::Column;

inline constexpr std::array pieces = {Column{"broken_joints", "-", "so far"}, Column{"fragments", "-", "now"}};
inline constexpr std::array energies = {
    Column{"energy_work", "J", "done by loads, gravity, water, forces given in Python and moving boundaries"},
    Column{"energy_kinetic", "J", "increase since the beginning"},
    Column{"energy_elastic", "J", "stored in joints, deformable elements, contacts and boundaries since the beginning"},
    Column{"energy_joint_dashpot", "J", "dissipated by dashpots of joints, and by the bulk damping of deformable elements"},
    Column{"energy_slip", "J", "dissipated by slip of joints before they break"},
    Column{"energy_fracture", "J", "dissipated by softening of joints"},
    Column{"energy_release", "J", "released by joints whose faces opened"},
    Column{"energy_contact_dashpot", "J", "dissipated by dashpots of contacts"},
    Column{"energy_friction", "J", "dissipated by friction of contacts"},
    Column{"energy_boundary_dashpot", "J", "dissipated by absorbing and fixed faces"}};
inline constexpr std::array progress = {Column{"energy_residual", "J", "residual of the energy balance"},
                                        Column{"smallest_step", "s", "of any element since the last row"},
                                        Column{"pair_evaluations", "-", "so far"}};
inline constexpr std::array boundary = {
    Column{"NAME.force", "N", "of a boundary on the body", 3},
    Column{"NAME.absorbed", "J",
           "dissipated by dashpots of the boundary; of an absorbing one, what waves have carried through it"}};
inline constexpr std::array charge = {
    Column{"NAME.pressure", "Pa", "of the gas of a charge"},
    Column{"NAME.volume", "m3", "of the gas of a charge"},
    Column{"NAME.released", "J", "energy of what has detonated of a charge"},
    Column{"NAME.work", "J", "done by the gas of a charge on the wall of its hole, and in cracks"},
    Column{"NAME.lost", "J", "energy of a charge that has left through the collar or through cracks, and that of its stemming"},
    Column{"NAME.in_cracks", "J", "energy of the gas of a charge in cracks"}};
inline constexpr std::array gauge = {Column{"NAME.velocity", "m/s", "of the point", 3}};
inline constexpr std::array gauge_peaks = {
    Column{"gauge", "", "its name"}, Column{"point", "m", "at the beginning", 3},
    Column{"ppv", "m/s", "largest magnitude of the velocity at any base step"}, Column{"time", "s", "at which that was"},
    Column{"peak", "m/s", "largest magnitude of each component of the velocity at any base step", 3}};
inline constexpr std::array holes = {
    Column{"hole", "", "name of the charge or of the blast"},
    Column{"delay", "s", "when it fires"},
    Column{"first", "m", "end of the charge nearer to the collar; of a blast, where the wall under pressure begins or ends", 3},
    Column{"last", "m", "the other end; the same point for a hole that is no cylinder", 3},
    Column{"diameter", "m", "of the hole; of a blast, that of the cylinder, or else the sphere, of the same volume"},
    Column{"mass", "kg", "of the explosive; 0 for a blast, which does not tell it"}};
inline constexpr std::array half_casts = {
    Column{"hole", "", "physical group of its wall"},
    Column{"first", "m", "where the wall begins, on the axis", 3},
    Column{"last", "m", "where it ends", 3},
    Column{"length", "m", "of the wall"},
    Column{"half_cast", "m", "length over which half of the wall around the axis, less one face, is on rock that stays"},
    Column{"whole", "m", "length over which all of it is: the hole has not broken out"},
    Column{"standing", "-", "share of the wall around the axis that is on rock that stays, the mean along the hole"}};
inline constexpr std::array ranks = {
    Column{"time", "s", "end of an interval between two distributions of the work"},
    Column{"rank", "-", ""},
    Column{"processor_time", "s", "of the rank in evaluations and updates so far"},
    Column{"exchange_time", "s", "spent in messages so far, waiting included"},
    Column{"lock_step", "-",
           "mean over the ranks of their evaluations and updates at a tick over the largest of it, all ticks of the "
           "interval together; 1: no rank waited for another one's work"},
    Column{"elements", "-", "of the rank in the interval"},
    Column{"border_elements", "-", "those of them that other ranks need at every tick"},
    Column{"ranges", "-", "pieces of the curve along which elements are stored that the rank has"},
    Column{"bytes_sent", "B", "to other ranks so far"},
    Column{"messages_sent", "-", "to other ranks so far; what all give to all counts as one to each"},
    Column{"expected_motion_bytes", "B",
           "of `motion_bytes`, as foretold at the beginning of every interval from levels and owners"},
    Column{"expected_motion_messages", "-", "of `motion_messages`, likewise"}};
/// What the messages of a rank are about, in the order of parallel::Topic.
inline constexpr std::array<std::string_view, 6> rank_topics = {"motion", "changes", "search", "rows", "state", "other"};
inline constexpr std::array rank_topic = {Column{"NAME_bytes", "B",
                                                 "so far, by topic: `motion` of elements at borders, `changes` of what is "
                                                 "linked, `search` for contacts, `rows` of histories, `state` for "
                                                 "snapshots, checkpoints and new owners, `other`"},
                                          Column{"NAME_messages", "-", "so far, by topic"}};
inline constexpr std::array rank_level = {
    Column{"elements_NAME", "-", "of the rank that are updated at a time level, `level_0`, `level_1` ..."}};
inline constexpr std::array elements = {
    Column{"element", "-", "number in the mesh"},
    Column{"region", "-", "physical group in the mesh, counted from 0 in the order of their numbers"},
    Column{"material", "-", "number in the case"},
    Column{"displacement", "m", "of the centre"},
    Column{"velocity", "m/s", "of the centre"},
    Column{"angular_velocity", "rad/s", ""},
    Column{"speed", "m/s", ""},
    Column{"level", "-", "0 is the base step, each level has half the step of the one before"},
    Column{"step", "s", "of the level"},
    Column{"fragment", "-", ""},
    Column{"broken_fraction", "-", "share of its joints that are broken"},
    Column{"normal_stress", "Pa", "xx, yy, zz, the mean over the element; tension is positive"},
    Column{"shear_stress", "Pa", "xy, yz, zx"},
    Column{"von_mises_stress", "Pa", ""},
    Column{"largest_principal_stress", "Pa", "tension is positive"},
    Column{"smallest_principal_stress", "Pa", ""},
    Column{"volumetric_strain", "-",
           "of the material of deformable elements, joints included, by the change of its stress; tension is positive; 0 of "
           "rigid elements"}};
inline constexpr std::array joints = {
    Column{"state", "-", "0 intact, 1 softening, 2 broken, 3 sheared: without strength, and pressed together"},
    Column{"mode", "-", "of a crack: 1 opening, 2 shear, whichever has dissipated more; else 0"},
    Column{"opening", "m", "largest of its corners"},
    Column{"slip", "m", "largest of its corners: how far its sides are apart along the face, less after they have slipped back"},
    Column{"kind", "-", "number in the case"},
    Column{
        "strength_factor", "-",
        "strength over that of the case, where strengths scatter or follow the rate of strain: that of a joint that has softened "
        "stays; else 1"}};
/// Beside these where there are natural joints; 0 of others.
inline constexpr std::array natural_joints = {
    Column{"slip_path", "m", "path of slip under pressure, to and fro, the largest of its corners"},
    Column{"mobilised_jrc", "-", "what slip has mobilised, and left, of JRC at the length of the joint, at that corner"},
    Column{"closure", "m", "of the joint without its springs, the largest of its corners"},
    Column{"dilation", "m", "so far, the largest of its corners"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {
    Column{"elements", "-", ""},
    Column{"joints", "-", ""},
    Column{"explosive_released", "J", "energy of what has detonated; where there are charges"},
    Column{"explosive_work", "J", "done by the gas of charges; where there are charges"},
    Column{"broken_joints", "-", "cracks, also those whose faces are pressed together"},
    Column{"broken_in_shear", "-", "of these, the ones in which slip has dissipated more than opening"},
    Column{"dynamic_increase", "-",
           "mean factor by which the rate of strain has raised the strength of cracks; where a joint has a rate law"},
    Column{"fragments", "-", ""},
    Column{"largest_fragment_volume", "m3", ""},
    Column{"detached_fragments", "-", "without those that stay, see `stays` of fragments.csv"},
    Column{"detached_volume", "m3", "of these"},
    Column{"half_cast_factor", "-", "half_cast over length of half_casts.csv, of all holes together; where there are holes"},
    Column{"p20", "m", "size that 20 % of their mass passes; diameter of the sphere of equal volume"},
    Column{"p50", "m", "size that 50 % of their mass passes"},
    Column{"p80", "m", "size that 80 % of their mass passes"},
    Column{"throw_max", "m", "largest displacement of a fragment's centre"},
    Column{"settlement", "m", "largest displacement of an element before time began; where it settles"},
    Column{"peak_speed", "m/s", "largest of any element, at the rows of the history"},
    Column{"peak_strain", "-",
           "largest of any deformable element, the norm of the tensor, at the rows of the history; where there are such"},
    Column{"steps", "-", "base steps"},
    Column{"updates", "-", "of elements, each at its level"},
    Column{"update_times", "-", "times at which elements were updated"},
    Column{"smallest_step", "s", "of any element"},
    Column{"pair_evaluations", "-", "of joints and contacts"},
    Column{"uniform_evaluations", "-", "that a uniform step, the smallest one, would have needed"}};

}  // namespace sazare::runs::columns::blocks
