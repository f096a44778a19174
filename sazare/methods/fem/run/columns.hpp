#pragma once

/// What runs of method fem write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::fem {

using observe::Column;

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

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {Column{"nodes", "-", ""},
                                   Column{"elements", "-", ""},
                                   Column{"freedoms", "-", "that are not held"},
                                   Column{"iterations", "-", "of Newton"},
                                   Column{"cuts", "-", "steps that were halved"},
                                   Column{"peak_force_NAME", "N", "of a boundary, by axis"},
                                   Column{"slip_max_NAME", "m", "of a set of joints, at the end"}};

}  // namespace sazare::runs::columns::fem
