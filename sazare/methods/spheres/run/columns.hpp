#pragma once

/// What runs of method spheres write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::spheres {

using observe::Column;

inline constexpr std::array history = {Column{"energy_translation", "J", ""},
                                       Column{"energy_rotation", "J", ""},
                                       Column{"energy_elastic", "J", "stored in normal springs of contacts"},
                                       Column{"energy_tangential", "J", "stored in tangential springs of contacts"},
                                       Column{"energy_potential", "J", "potential energy in gravity"},
                                       Column{"energy_contact_dashpot", "J", "dissipated by dashpots of contacts"},
                                       Column{"energy_friction", "J", "dissipated by friction and rolling"},
                                       Column{"energy_work_walls", "J", "work of walls and driven spheres"},
                                       Column{"energy_bonds", "J", "stored in bonds"},
                                       Column{"energy_bond_dashpot", "J", "dissipated by dashpots of bonds"},
                                       Column{"energy_fracture", "J", "dissipated by bonds that broke"},
                                       Column{"energy_work_water", "J", "work of water on the bodies"},
                                       Column{"energy_work_applied", "J", "work of forces given in Python"},
                                       Column{"energy_residual", "J", "residual of the energy balance"},
                                       Column{"contacts", "-", "now"},
                                       Column{"broken_bonds", "-", "so far"},
                                       Column{"broken_bodies", "-", "bonded bodies in more than one piece"},
                                       Column{"speed_max", "m/s", "of any sphere"}};
inline constexpr std::array gauge = {Column{"NAME.position", "m", "of the group's centre of mass", 3},
                                     Column{"NAME.velocity", "m/s", "of the group's centre of mass", 3},
                                     Column{"NAME.force", "N", "on the group without gravity", 3}};
inline constexpr std::array wall = {Column{"NAME.force", "N", "on the wall", 3},
                                    Column{"NAME.moment", "N m", "on the wall, about its pivot", 3}};
inline constexpr std::array particles = {Column{"velocity", "m/s", ""},
                                         Column{"angular_velocity", "rad/s", ""},
                                         Column{"radius", "m", ""},
                                         Column{"group", "-", "number in the case"},
                                         Column{"material", "-", "number in the case"},
                                         Column{"body", "-", "its clump, or behind all clumps its bonded body, or -1"},
                                         Column{"broken_fraction", "-", "share of its bonds that are broken"}};

inline constexpr std::array surfaces = {Column{"wall", "-", "number in the case"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {
    Column{"particles", "-", ""},
    Column{"particle_steps", "-", ""},
    Column{"levels", "-", "number of time levels, where spheres have levels of their own"},
    Column{"smallest_step", "s", "of any sphere, where there are levels"},
    Column{"pair_evaluations", "-", "of contacts, where there are levels"},
    Column{"uniform_evaluations", "-", "that a uniform step, the smallest one, would have needed, where there are levels"},
    Column{"contacts", "-", "at the end"},
    Column{"clumps", "-", ""},
    Column{"shape_volume_NAME", "m3", "of a body of the shape"},
    Column{"shape_fill_NAME", "-",
           "volume that the spheres of a shape from a mesh fill, over that of its surface, whose mass it has"},
    Column{"bonds", "-", ""},
    Column{"broken_bonds", "-", ""},
    Column{"bodies", "-", "bonded bodies, where there are any"},
    Column{"broken_bodies", "-", "bonded bodies in more than one piece"},
    Column{"fragments", "-", "pieces of bonded bodies"},
    Column{"searches", "-", "searches for neighbours"},
    Column{"energy_kinetic", "J", "translation and rotation"},
    Column{"energy_lost", "J", "dissipated by dashpots, friction and fracture"},
    Column{"step_load", "-",
           "largest load on the step by the springs and dashpots of the contacts of a body; above 1 the step may be unstable"},
    Column{
        "energy_work", "J",
        "reference of the residual: the largest of the energy lost, the peak kinetic energy and the works of walls, of water and "
        "of forces given in Python"}};
inline constexpr std::array ranks = {
    Column{"time", "s", "end of the run"},
    Column{"rank", "-", ""},
    Column{"processor_time", "s", "of the rank in forces and motion"},
    Column{"exchange_time", "s", "spent in messages, waiting included"},
    Column{"spheres", "-", "of the rank at the end"},
    Column{"border_spheres", "-", "those of them that other ranks need at every step, each counted for each of these"},
    Column{"bytes_sent", "B", "to other ranks"},
    Column{"messages_sent", "-", "to other ranks; what all give to all counts as one to each"},
    Column{"motion_bytes", "B", "of these, loads and motion of spheres at the borders"},
    Column{"motion_messages", "-", "likewise"},
    Column{"search_bytes", "B", "of these, spheres and contacts that change their rank, and spheres near borders, at searches"},
    Column{"search_messages", "-", "likewise"},
    Column{"expected_motion_bytes", "B", "of `motion_bytes`, as the lists of ghosts foretell"},
    Column{"expected_motion_messages", "-", "of `motion_messages`, likewise"}};

}  // namespace sazare::runs::columns::spheres
