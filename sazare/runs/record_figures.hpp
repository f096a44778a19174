#pragma once

/// The headline figures in the manifests of runs, `results` by name: an interface, which scripts of users read. The reference
/// (folder_page.cpp) prints them; figures of energies are those of the history's column of the same name, at the end.

#include "sazare/observe/column.hpp"

namespace sazare::runs::figures {

using observe::Column;

inline constexpr std::array of_all = {Column{"wall_seconds", "s", "of the clock on the wall"},
                                      Column{"energy_residual", "J", "what no cause accounts for"},
                                      Column{"ppv", "m/s", "largest speed by gauge, at the rows of the history"}};

inline constexpr std::array of_steps = {Column{"steps", "-", ""}, Column{"step", "s", ""},
                                        Column{"predicted_limit", "s", "largest stable step, predicted; not of fem"}};

inline constexpr std::array of_motion = {Column{"peak_displacement", "m", "of any element, node or particle; not of spheres"},
                                         Column{"peak_speed", "m/s", "of any"},
                                         Column{"peak_acceleration", "m/s2", "of mps and fem"},
                                         Column{"final_displacement", "m", "largest at the end, of mps and fem"}};

inline constexpr std::array blocks = {Column{"elements", "-", ""},
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

inline constexpr std::array mps = {Column{"particles", "-", ""},
                                   Column{"particle_steps", "-", ""},
                                   Column{"largest_frequency", "rad/s", "by which the limit is predicted"},
                                   Column{"settlement", "m", "largest on the way to rest under gravity, where asked for"},
                                   Column{"links_broken", "-", "of ground that fails"},
                                   Column{"drift_velocity_NAME", "m/s", "at the end of a motion given by accelerations"},
                                   Column{"drift_displacement_NAME", "m", "at the end of a motion given by accelerations"}};

inline constexpr std::array rectangles = {Column{"elements", "-", ""}, Column{"element_steps", "-", ""},
                                          Column{"broken_springs", "-", ""}, Column{"open_links", "-", ""},
                                          Column{"peak_force_NAME", "N", "of a wall or roller"}};

inline constexpr std::array spheres = {
    Column{"particles", "-", ""},
    Column{"particle_steps", "-", ""},
    Column{"levels", "-", "of the steps, where there are any; the same for the next three"},
    Column{"smallest_step", "s", "of any sphere"},
    Column{"pair_evaluations", "-", "of contacts"},
    Column{"uniform_evaluations", "-", "what the smallest step for all would have taken"},
    Column{"contacts", "-", "at the end"},
    Column{"clumps", "-", ""},
    Column{"shape_fill_NAME", "-",
           "volume that the spheres of a shape from a mesh fill, over that of its surface, whose mass it has"},
    Column{"bonds", "-", ""},
    Column{"bonds_broken", "-", ""},
    Column{"bodies", "-", "that are bonded, where there are any"},
    Column{"bodies_broken", "-", "of them, in more than one piece"},
    Column{"fragments", "-", "pieces of them"},
    Column{"searches", "-", "for neighbours"},
    Column{"energy_kinetic", "J", "translation and rotation"},
    Column{"energy_lost", "J", "taken by dashpots, friction and fracture"},
    Column{"energy_work", "J", "largest of what was lost, held in motion, or brought in by walls"}};

inline constexpr std::array fem = {Column{"nodes", "-", ""},
                                   Column{"elements", "-", ""},
                                   Column{"freedoms", "-", "that are not held"},
                                   Column{"iterations", "-", "of Newton"},
                                   Column{"cuts", "-", "steps that were halved"},
                                   Column{"peak_force_NAME", "N", "of a boundary, by axis"},
                                   Column{"slip_max_NAME", "m", "of a set of joints, at the end"}};

inline constexpr std::array hybrid = {Column{"windows", "-", ""},
                                      Column{"window", "s", "its length"},
                                      Column{"passes", "-", "through windows"},
                                      Column{"steps_per_window", "-", "of the bodies"},
                                      Column{"step", "s", "of the bodies"},
                                      Column{"elements", "-", ""},
                                      Column{"freedoms", "-", ""},
                                      Column{"particles", "-", "where the bodies are spheres"},
                                      Column{"particle_steps", "-", ""},
                                      Column{"body_elements", "-", "where they are rectangles"},
                                      Column{"body_element_steps", "-", ""},
                                      Column{"blocks", "-", "where they are blocks"},
                                      Column{"block_steps", "-", ""},
                                      Column{"impulse_given", "N s", "by the bodies"},
                                      Column{"impulse_under_way", "N s", "what the continuum has not got yet"},
                                      Column{"work_on_nodes", "J", ""},
                                      Column{"energy_made", "J", "over the surface"},
                                      Column{"peak_force", "N", "of the bodies on the surface"},
                                      Column{"peak_displacement", "m", "mean of the surface's nodes"}};

/// Of a side of a hybrid case that is a program of its own.
inline constexpr std::array exchange = {
    Column{"exchange_seconds", "s", "spent in writing and reading messages, without the waits for the partner"},
    Column{"exchange_processor_seconds", "s", "of the processor, for the same"}};

}  // namespace sazare::runs::figures
