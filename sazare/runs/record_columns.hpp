#pragma once

/// All columns of the tables and all fields of the snapshots that runs write, in their order: the reference (folder_page.cpp)
/// prints them. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns {

using observe::Column;

inline constexpr std::array time = {Column{"time", "s", "since the beginning"}};
inline constexpr std::array clock = {Column{"wall_seconds", "s", "of the clock on the wall since the run began"}};

/// Of gauges.
inline constexpr std::array place_motion = {Column{"NAME.displacement", "m", "since the beginning", 3},
                                            Column{"NAME.velocity", "m/s", "", 3}, Column{"NAME.acceleration", "m/s2", "", 3}};

inline constexpr std::array fragments = {
    Column{"fragment", "-", "number, as in the snapshots"},
    Column{"elements", "-", "of bonded bodies their spheres"},
    Column{"volume", "m3", ""},
    Column{"mass", "kg", ""},
    Column{"size", "m", "diameter of the sphere of the same volume"},
    Column{"center", "m", "of mass", 3},
    Column{"velocity", "m/s", "of the centre", 3},
    Column{"throw", "m", "way of the centre; of bonded bodies from where the group puts it"}};

namespace blocks {

inline constexpr std::array pieces = {Column{"broken_joints", "-", "so far"}, Column{"fragments", "-", "now"}};
inline constexpr std::array energies = {
    Column{"energy_work", "J", "done by loads and gravity"},
    Column{"energy_kinetic", "J", "in motion, more than at the beginning"},
    Column{"energy_elastic", "J", "in joints, contacts and boundaries"},
    Column{"energy_joint_dashpot", "J", "taken by dashpots of joints"},
    Column{"energy_slip", "J", "taken by joints that slide before they fail"},
    Column{"energy_fracture", "J", "taken by softening"},
    Column{"energy_release", "J", "elastic energy left in joints when their faces came apart"},
    Column{"energy_contact_dashpot", "J", "taken by dashpots of contacts"},
    Column{"energy_friction", "J", "taken by friction of contacts"},
    Column{"energy_boundary", "J", "taken by absorbing and fixed faces"}};
inline constexpr std::array progress = {Column{"energy_residual", "J", "work that is found nowhere"},
                                        Column{"smallest_step", "s", "of any element since the last row"},
                                        Column{"pair_evaluations", "-", "so far"}};
inline constexpr std::array gauge = {Column{"NAME.velocity", "m/s", "of the point", 3}};
inline constexpr std::array ranks = {Column{"time", "s", "end of an interval between new shares"},
                                     Column{"rank", "-", ""},
                                     Column{"processor_time", "s", "of its work so far"},
                                     Column{"exchange_time", "s", "in messages, in the interval"},
                                     Column{"bytes_sent", "B", "in the interval"},
                                     Column{"first_element", "-", "of its share"}};
inline constexpr std::array elements = {Column{"element", "-", "number in the mesh"},
                                        Column{"region", "-", "physical group in the mesh"},
                                        Column{"material", "-", "number in the case"},
                                        Column{"displacement", "m", "of the centre"},
                                        Column{"velocity", "m/s", "of the centre"},
                                        Column{"speed", "m/s", ""},
                                        Column{"level", "-", "0 is the base step, each further one half of it"},
                                        Column{"step", "s", "of the level"},
                                        Column{"fragment", "-", ""},
                                        Column{"damage", "-", "share of its joints that broke"}};
inline constexpr std::array joints = {Column{"state", "-", "0 intact, 1 softening, 2 broken"},
                                      Column{"opening", "m", "largest of its corners"},
                                      Column{"slip", "m", "largest of its corners"}, Column{"kind", "-", "number in the case"}};

}  // namespace blocks

namespace mps {

inline constexpr std::array motion = {Column{"energy_kinetic", "J", ""}, Column{"energy_elastic", "J", ""},
                                      Column{"displacement_max", "m", "of any particle, since the beginning"},
                                      Column{"speed_max", "m/s", "of any particle"},
                                      Column{"acceleration_max", "m/s2", "of any particle"}};
inline constexpr std::array books = {Column{"energy_gravity", "J", "work of gravity"},
                                     Column{"energy_boundary", "J", "work of viscous boundaries with their waves"},
                                     Column{"energy_prescribed", "J", "work of moved supports"},
                                     Column{"energy_applied", "J", "work of the caller's own forces"},
                                     Column{"energy_damping", "J", "taken by Rayleigh's damping"},
                                     Column{"energy_residual", "J", "what no cause accounts for"}};
inline constexpr std::array failure = {
    Column{"energy_flow", "J", "taken by flow"}, Column{"energy_rupture", "J", "taken by links that broke"},
    Column{"energy_contact", "J", "held in contacts"}, Column{"links_broken", "-", "so far"}, Column{"contacts", "-", "now"}};
inline constexpr std::array particles = {Column{"displacement", "m", "since the beginning"},
                                         Column{"velocity", "m/s", ""},
                                         Column{"acceleration", "m/s2", ""},
                                         Column{"region", "-", "number in the case"},
                                         Column{"material", "-", "number in the case"},
                                         Column{"spacing", "m", ""}};
inline constexpr std::array failed_particles = {Column{"slip", "-", "plastic shear strain"},
                                                Column{"broken_share", "-", "share of its links that broke"}};

}  // namespace mps

namespace rectangles {

inline constexpr std::array history = {Column{"energy_kinetic", "J", ""},
                                       Column{"energy_elastic", "J", "in links and contacts"},
                                       Column{"energy_joint_dashpot", "J", "taken by dashpots of links"},
                                       Column{"energy_slip", "J", "taken by links that slide"},
                                       Column{"energy_fracture", "J", "taken by links that broke"},
                                       Column{"energy_contact_dashpot", "J", "taken by dashpots of contacts"},
                                       Column{"energy_friction", "J", "taken by friction of contacts"},
                                       Column{"energy_work", "J", "of gravity, supports, plate and the caller's forces"},
                                       Column{"energy_residual", "J", "work that is found nowhere"},
                                       Column{"broken_springs", "-", "so far"},
                                       Column{"open_links", "-", "links whose springs are all broken"},
                                       Column{"contacts", "-", "that touch"},
                                       Column{"displacement_max", "m", "of any element so far"},
                                       Column{"speed_max", "m/s", "of any element so far"}};
inline constexpr std::array support = {Column{"NAME.force", "N", "of a wall or roller on the elements", 2},
                                       Column{"NAME.displacement", "m", "of the wall or roller", 2}};
inline constexpr std::array gauge_rotation = {Column{"NAME.rotation", "rad", "since the beginning"}};
inline constexpr std::array elements = {Column{"displacement", "m", ""},
                                        Column{"velocity", "m/s", ""},
                                        Column{"rotation", "rad", ""},
                                        Column{"block", "-", "number in the case, or -1"},
                                        Column{"kind", "-", "of its outline: 0 rectangle, 1 circle, 2 wall, 3 polygon"},
                                        Column{"broken", "-", "a bit for each face whose link has lost a spring"}};

}  // namespace rectangles

namespace spheres {

inline constexpr std::array history = {Column{"energy_translation", "J", ""},
                                       Column{"energy_rotation", "J", ""},
                                       Column{"energy_elastic", "J", "in contacts"},
                                       Column{"energy_sliding", "J", "in springs of contacts along their faces"},
                                       Column{"energy_potential", "J", "of gravity"},
                                       Column{"work_dashpots", "J", "taken by dashpots of contacts"},
                                       Column{"work_friction", "J", "taken by friction and rolling"},
                                       Column{"work_walls", "J", "brought in by walls and driven spheres"},
                                       Column{"energy_bonds", "J", "in bonds"},
                                       Column{"work_bond_dashpots", "J", "taken by dashpots of bonds"},
                                       Column{"work_fracture", "J", "taken by bonds that broke"},
                                       Column{"energy_residual", "J", "change of the sum of all"},
                                       Column{"contacts", "-", "that touch"},
                                       Column{"bonds_broken", "-", "so far"},
                                       Column{"bodies_broken", "-", "bonded bodies in more than one piece"},
                                       Column{"speed_max", "m/s", "of any sphere"}};
inline constexpr std::array gauge = {Column{"NAME.position", "m", "of the group's centre of mass", 3},
                                     Column{"NAME.velocity", "m/s", "of the group's centre of mass", 3},
                                     Column{"NAME.force", "N", "on the group without gravity", 3}};
inline constexpr std::array wall = {Column{"NAME.force", "N", "on the wall", 3},
                                    Column{"NAME.moment", "N m", "on the wall, about its pivot", 3}};
inline constexpr std::array particles = {Column{"velocity", "m/s", ""},
                                         Column{"spin", "rad/s", ""},
                                         Column{"radius", "m", ""},
                                         Column{"group", "-", "number in the case"},
                                         Column{"material", "-", "number in the case"},
                                         Column{"body", "-", "its clump, or behind all clumps its bonded body, or -1"},
                                         Column{"broken", "-", "share of its bonds that broke"}};

}  // namespace spheres

namespace fem {

inline constexpr std::array motion = {Column{"displacement_max", "m", "of any node, since the beginning"},
                                      Column{"speed_max", "m/s", "of any node"},
                                      Column{"acceleration_max", "m/s2", "of any node"}};
inline constexpr std::array energies = {Column{"energy_work", "J", "all that was done on the body"},
                                        Column{"energy_kinetic", "J", ""},
                                        Column{"energy_elastic", "J", ""},
                                        Column{"energy_damping", "J", "taken by Rayleigh's damping"},
                                        Column{"energy_radiation", "J", "taken by viscous boundaries"},
                                        Column{"energy_plastic", "J", "taken by flow"},
                                        Column{"energy_friction", "J", "taken by joints"},
                                        Column{"energy_residual", "J", "work that is found nowhere"}};
inline constexpr std::array work = {
    Column{"work_gravity", "J", "of the work: gravity"}, Column{"work_loads", "J", "pressures and forces"},
    Column{"work_boundary", "J", "moved supports"}, Column{"work_waves", "J", "waves that come in through viscous boundaries"}};
inline constexpr std::array boundary = {Column{"force.NAME", "N", "of a boundary on the body", 3}};
inline constexpr std::array joint_set = {Column{"joint.NAME.open_share", "-", "share of the set's area that is open"},
                                         Column{"joint.NAME.slip_share", "-", "share that slides"},
                                         Column{"joint.NAME.slip_max", "m", "largest slip"}};
inline constexpr std::array newton = {Column{"iterations", "-", "of Newton so far"},
                                      Column{"cuts", "-", "steps that were halved"}};
inline constexpr std::array nodes = {Column{"displacement", "m", "since the beginning"}, Column{"velocity", "m/s", ""},
                                     Column{"acceleration", "m/s2", ""}};
inline constexpr std::array elements = {Column{"normal_stress", "Pa", "xx, yy, zz; tension is positive"},
                                        Column{"shear_stress", "Pa", "in the plane xy; in space xy, yz, zx"},
                                        Column{"pressure", "Pa", "minus the mean of the normal stresses"},
                                        Column{"plastic_slip", "-", "plastic shear strain"},
                                        Column{"region", "-", "physical group in the mesh"}};

}  // namespace fem

namespace hybrid {

inline constexpr std::array history = {
    Column{"surface.displacement", "m", "mean of the surface's nodes", 3},
    Column{"surface.force", "N", "of the bodies on the surface: mean of the last window", 3},
    Column{"surface.last_force", "N", "of the bodies on the surface: at the window's end", 3},
    Column{"impulse_given", "N s", "by the bodies so far", 3},
    Column{"impulse_under_way", "N s", "of that, what the continuum has not got yet", 3},
    Column{"work_on_nodes", "J", "over the surface"},
    Column{"work_on_bodies", "J", "over the surface"},
    Column{"energy_made", "J", "their sum, which nobody has lost"},
    Column{"energy_residual_continuum", "J", "of its ledger"},
    Column{"energy_residual_bodies", "J", "of their ledger"},
    Column{"passes", "-", "through windows so far"},
    Column{"disagreement", "-", "what was left between the force tried and found, over the larger one"}};

}  // namespace hybrid

inline constexpr std::array timing = {Column{"part", "", "of a step, or of the run"}, Column{"seconds", "s", ""},
                                      Column{"share", "-", "of the run"}};

}  // namespace sazare::runs::columns
