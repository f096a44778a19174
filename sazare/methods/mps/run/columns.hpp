#pragma once

/// What runs of method mps write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::mps {

using observe::Column;

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

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {Column{"particles", "-", ""},
                                   Column{"particle_steps", "-", ""},
                                   Column{"largest_frequency", "rad/s", "by which the limit is predicted"},
                                   Column{"settlement", "m", "largest on the way to rest under gravity, where asked for"},
                                   Column{"links_broken", "-", "of ground that fails"},
                                   Column{"drift_velocity_NAME", "m/s", "at the end of a motion given by accelerations"},
                                   Column{"drift_displacement_NAME", "m", "at the end of a motion given by accelerations"}};

}  // namespace sazare::runs::columns::mps
