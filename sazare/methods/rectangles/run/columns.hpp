#pragma once

/// What runs of method rectangles write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::rectangles {

using observe::Column;

inline constexpr std::array history = {Column{"energy_kinetic", "J", ""},
                                       Column{"energy_elastic", "J", "stored in links and contacts"},
                                       Column{"energy_joint_dashpot", "J", "dissipated by dashpots of links"},
                                       Column{"energy_slip", "J", "dissipated by slip of links"},
                                       Column{"energy_fracture", "J", "dissipated by the breaking of links"},
                                       Column{"energy_contact_dashpot", "J", "dissipated by dashpots of contacts"},
                                       Column{"energy_friction", "J", "dissipated by friction of contacts"},
                                       Column{"energy_work", "J", "of gravity, supports, plate and forces given in Python"},
                                       Column{"energy_residual", "J", "residual of the energy balance"},
                                       Column{"broken_springs", "-", "so far"},
                                       Column{"broken_links", "-", "links whose springs are all broken"},
                                       Column{"contacts", "-", "touching pairs"},
                                       Column{"displacement_max", "m", "of any element so far"},
                                       Column{"speed_max", "m/s", "of any element so far"}};
inline constexpr std::array support = {Column{"NAME.force", "N", "of a wall or roller on the elements", 2},
                                       Column{"NAME.displacement", "m", "of the wall or roller", 2}};
inline constexpr std::array gauge_rotation = {Column{"NAME.rotation", "rad", "since the beginning"}};
inline constexpr std::array elements = {Column{"displacement", "m", ""},
                                        Column{"velocity", "m/s", ""},
                                        Column{"rotation", "rad", ""},
                                        Column{"block", "-", "number in the case, or -1"},
                                        Column{"kind", "-", "outline: 0 rectangle, 1 circle, 2 wall, 3 polygon"},
                                        Column{"broken_faces", "-", "one bit for each face whose link has a broken spring"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {Column{"elements", "-", ""}, Column{"element_steps", "-", ""},
                                          Column{"broken_springs", "-", ""}, Column{"broken_links", "-", ""},
                                          Column{"peak_force_NAME", "N", "of a wall or roller"}};

}  // namespace sazare::runs::columns::rectangles
