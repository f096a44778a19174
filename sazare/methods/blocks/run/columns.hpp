#pragma once

/// What runs of method blocks write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::blocks {

using observe::Column;

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

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {Column{"elements", "-", ""},
                                      Column{"joints", "-", ""},
                                      Column{"broken_joints", "-", ""},
                                      Column{"fragments", "-", ""},
                                      Column{"largest_fragment_volume", "m3", ""},
                                      Column{"x50", "m", "size that half of the volume passes"},
                                      Column{"x80", "m", "size that 80 % of the volume passes"},
                                      Column{"throw_max", "m", "longest way of a fragment's centre"},
                                      Column{"peak_speed", "m/s", "largest of any element, at the rows of the history"},
                                      Column{"steps", "-", "base steps"},
                                      Column{"kicks", "-", "steps of elements, each at its level"},
                                      Column{"ticks", "-", "moments at which something was due"},
                                      Column{"smallest_step", "s", "of any element"},
                                      Column{"pair_evaluations", "-", "of joints and contacts"},
                                      Column{"uniform_evaluations", "-", "what the smallest step for all would have taken"}};

}  // namespace sazare::runs::columns::blocks
