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
inline constexpr std::array energy_balance = {
    Column{"energy_work_gravity", "J", "work of gravity"},
    Column{"energy_work_viscous", "J", "work of viscous boundaries, their incident waves and free-field sides"},
    Column{"energy_work_boundary", "J", "work of moving supports"},
    Column{"energy_work_applied", "J", "work of forces given in Python"},
    Column{"energy_damping", "J", "dissipated by Rayleigh damping"},
    Column{"energy_residual", "J", "residual of the energy balance"}};
inline constexpr std::array failure = {Column{"energy_plastic", "J", "dissipated by plastic flow"},
                                       Column{"energy_fracture", "J", "elastic energy lost when links break"},
                                       Column{"energy_contact", "J", "dissipated by contacts and by the damping of broken ground"}, Column{"broken_links", "-", "so far"},
                                       Column{"contacts", "-", "now"}};
inline constexpr std::array surface = {Column{"energy_work_surface", "J", "work of the coupling surface on the ground"},
                                       Column{"energy_surface_contact", "J", "dissipated by friction and dashpots on it"},
                                       Column{"surface_contacts", "-", "particles that touch it now"}};
inline constexpr std::array particles = {
    Column{"displacement", "m", "since the beginning"},
    Column{"velocity", "m/s", ""},
    Column{"acceleration", "m/s2", ""},
    Column{"region", "-", "number in the case"},
    Column{"material", "-", "number in the case"},
    Column{"spacing", "m", ""},
    Column{"support", "-", "0 free, 1 held, 2 moved by a prescribed motion, 3 on a viscous boundary, 4 on a free-field side"}};
inline constexpr std::array tensors = {
    Column{"normal_stress", "Pa", "xx, yy, zz; tension is positive; of each particle's own law"},
    Column{"shear_stress", "Pa", "xy in 2-D; xy, yz, zx in 3-D"},
    Column{"pressure", "Pa", "minus the mean of the normal stresses"},
    Column{"von_mises_stress", "Pa", ""},
    Column{"normal_strain", "-", "xx, yy, zz, since the unstressed state; extension is positive; 0 where the ground is broken"},
    Column{"shear_strain", "-", "engineering; xy in 2-D; xy, yz, zx in 3-D; 0 where the ground is broken"},
    Column{"equivalent_shear_strain", "-", "engineering; that of the simple shear which has as large a deviator"}};
inline constexpr std::array failed_particles = {Column{"plastic_shear_strain", "-", "equivalent plastic shear strain"},
                                                Column{"broken_fraction", "-", "share of its links that are broken"}};
inline constexpr std::array degraded_particles = {
    Column{"shear_strain_max", "-", "largest shear strain so far, of soil with a backbone; only where there is any"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {
    Column{"particles", "-", ""},
    Column{"particle_steps", "-", ""},
    Column{"largest_frequency", "rad/s", "from which the stability limit is predicted"},
    Column{"settlement", "m", "largest displacement to equilibrium under gravity, where found"},
    Column{"broken_links", "-", "of ground with a strength"},
    Column{"unbroken_shear_strain", "-",
           "largest plastic shear strain of ground that has not broken; above 0.3 it is not to be relied on"},
    Column{"energy_work_surface", "J", "work of the coupling surface on the ground, of a side of a hybrid case"},
    Column{"energy_surface_contact", "J", "dissipated by friction and dashpots on it"},
    Column{"drift_velocity_NAME", "m/s", "at the end of a motion given by accelerations"},
    Column{"drift_displacement_NAME", "m", "at the end of a motion given by accelerations"}};

}  // namespace sazare::runs::columns::mps
