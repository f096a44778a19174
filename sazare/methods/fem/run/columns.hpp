#pragma once

/// What runs of method fem write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::fem {

using observe::Column;

inline constexpr std::array motion = {Column{"displacement_max", "m", "of any node, since the beginning"},
                                      Column{"speed_max", "m/s", "of any node"},
                                      Column{"acceleration_max", "m/s2", "of any node"}};
inline constexpr std::array energies = {
    Column{"energy_work", "J", "work done on the body"},
    Column{"energy_kinetic", "J", ""},
    Column{"energy_elastic", "J", ""},
    Column{"energy_damping", "J", "dissipated by Rayleigh damping"},
    Column{"energy_radiation", "J", "dissipated by viscous boundaries and by the dashpots of free-field sides"},
    Column{"energy_plastic", "J", "dissipated by plastic flow"},
    Column{"energy_friction", "J", "dissipated by friction of joints"},
    Column{"energy_seepage", "J", "dissipated by the flow of pore water"},
    Column{"energy_members", "J", "dissipated by members that yield"},
    Column{"energy_residual", "J", "residual of the energy balance"}};
inline constexpr std::array work = {Column{"energy_work_gravity", "J", "work of gravity"},
                                    Column{"energy_work_loads", "J", "work of loads"},
                                    Column{"energy_work_boundary", "J", "work of moving supports"},
                                    Column{"energy_work_waves", "J", "work of waves that enter through viscous boundaries"},
                                    Column{"energy_work_water", "J", "work of the pressure of still water"},
                                    Column{"energy_work_sides", "J", "work of the columns beside free-field sides"}};
inline constexpr std::array moving_water = {
    Column{"energy_kinetic_water", "J", "of the added mass of water, part of energy_kinetic; only where there is water"}};
inline constexpr std::array pore_water = {
    Column{"excess_pore_pressure_max", "Pa", "largest of any node; where drainage is undrained or flow"},
    Column{"excess_pore_pressure_min", "Pa", "smallest of any node, negative where ground sucks water"},
    Column{"pore_pressure_min", "Pa", "smallest of any node, with that at rest; water cavitates near -1e5"},
    Column{"energy_elastic_pore_water", "J", "of the water in the pores, part of energy_elastic"}};
inline constexpr std::array gauge_pressure = {
    Column{"NAME.excess_pore_pressure", "Pa", "at a gauge, above that at rest; where drainage is undrained or flow"}};
inline constexpr std::array boundary = {Column{"NAME.force", "N", "of a boundary on the body", 3}};
inline constexpr std::array water = {
    Column{"NAME.water_force", "N",
           "of still water on the body: its pressure and the inertia of its added mass; in a joint, on the first side", 3}};
inline constexpr std::array joint_set = {Column{"NAME.open_fraction", "-", "open share of the area of the joint"},
                                         Column{"NAME.sliding_fraction", "-", "sliding share of the area of the joint"},
                                         Column{"NAME.slip_max", "m", "largest slip"}};
inline constexpr std::array member = {Column{"NAME.axial_force_min", "N", "smallest along a member; tension is positive"},
                                      Column{"NAME.axial_force_max", "N", "largest along a member; tension is positive"},
                                      Column{"NAME.shear_force_max", "N", "largest along a member"},
                                      Column{"NAME.moment_max", "N m", "largest bending moment along a member"}};
inline constexpr std::array force_limit = {
    Column{"NAME.force_ratio", "-", "largest axial force over its limit; of bars and springs with one"},
    Column{"NAME.plastic_elongation", "m",
           "of the element with the largest, negative where it is shorter; of bars and springs with a limit"}};
inline constexpr std::array moment_limit = {
    Column{"NAME.moment_ratio", "-", "largest bending moment over the yield moment; of beams with one"},
    Column{"NAME.plastic_rotation", "rad", "largest of a plastic hinge; of beams with a yield moment"}};
inline constexpr std::array newton = {Column{"newton_iterations", "-", "Newton iterations so far"},
                                      Column{"step_cuts", "-", "steps that were halved"}};
inline constexpr std::array nodes = {Column{"displacement", "m", "since the beginning"}, Column{"velocity", "m/s", ""},
                                     Column{"acceleration", "m/s2", ""}};
inline constexpr std::array yielded = {
    Column{"member_plastic_elongation", "m", "size of that of the bar or spring at a node; only where one has a limit"},
    Column{"member_plastic_rotation", "rad", "of the plastic hinge at a node; only where a beam has a yield moment"}};
inline constexpr std::array elements = {
    Column{"normal_stress", "Pa", "xx, yy, zz; tension is positive; in ground with a water table effective stress"},
    Column{"shear_stress", "Pa", "xy in 2-D; xy, yz, zx in 3-D"},
    Column{"pressure", "Pa", "minus the mean of the normal stresses"},
    Column{"von_mises_stress", "Pa", ""},
    Column{"plastic_shear_strain", "-", "equivalent plastic shear strain"},
    Column{"region", "-", "physical group in the mesh, counted from 0 as the file has them"},
    Column{"density", "kg/m3", "at the beginning; of saturated ground with its water"}};

inline constexpr std::array soil = {
    Column{"shear_strain_max", "-", "largest shear strain so far, of soil with a backbone; only where there is any"}};

inline constexpr std::array pores = {Column{"pore_pressure", "Pa", "of the water in saturated ground; only where there is any"}};
inline constexpr std::array excess = {
    Column{"excess_pore_pressure", "Pa", "above that at rest; where drainage is undrained or flow"},
    Column{"pore_pressure_ratio", "-",
           "excess pore pressure over the vertical effective stress at the beginning, 1 in liquefied ground; with settle"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {
    Column{"nodes", "-", ""},
    Column{"elements", "-", ""},
    Column{"degrees_of_freedom", "-", "free degrees of freedom"},
    Column{"newton_iterations", "-", "Newton iterations"},
    Column{"step_cuts", "-", "steps that were halved"},
    Column{"energy_round_off", "J", "energy that round-off may have made up: works below it say nothing"},
    Column{"peak_force_NAME", "N", "of a boundary on the body, by axis"},
    Column{"peak_excess_pore_pressure", "Pa", "where drainage is undrained or flow"},
    Column{"least_pore_pressure", "Pa", "smallest of any node, with that at rest"},
    Column{"peak_pore_pressure_ratio", "-", "largest of any element in a snapshot"},
    Column{"slip_max_NAME", "m", "of a joint, at the end"},
    Column{"yield_time_NAME", "s", "first time at which a member has yielded; not there before"},
    Column{"plastic_elongation_NAME", "m", "of a bar or spring with a limit, at the end"},
    Column{"plastic_rotation_NAME", "rad", "of a beam with a yield moment, at the end"}};

}  // namespace sazare::runs::columns::fem
