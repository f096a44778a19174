#pragma once

/// The headline figures in the manifests of runs that several methods have, `results` by name: an interface, which scripts of
/// users read. Those of a method stand in its own columns.hpp; the reference (folder_page.cpp) prints all. A figure of energy is
/// the last value of the history's column of the same name.

#include "sazare/observe/column.hpp"

namespace sazare::runs::figures {

using observe::Column;

inline constexpr std::array of_all = {
    Column{"wall_seconds", "s", "wall-clock time"}, Column{"energy_residual", "J", "residual of the energy balance"},
    Column{"ppv", "m/s", "peak particle velocity by gauge, at the rows of the history; of `blocks`, at every base step"}};

inline constexpr std::array of_steps = {
    Column{"steps", "-", ""}, Column{"step", "s", ""},
    Column{"predicted_limit", "s", "predicted stability limit of the step, of methods that have one"}};

/// Extreme values of the motion; `whose` says of what, and when it is looked at.
constexpr std::array<Column, 4> of_motion(std::string_view whose) {
  return {Column{"peak_displacement", "m", "of any element, node or particle; not of spheres"},
          Column{"peak_speed", "m/s", whose},
          Column{"peak_acceleration", "m/s2", "of any element, node or particle, where it is recorded"},
          Column{"final_displacement", "m", "largest displacement at the end, where it is recorded"}};
}

inline constexpr std::array of_particles = of_motion("largest of any particle, at the rows of the history");
inline constexpr std::array of_elements = of_motion("largest of any element's centre, at the rows of the history");
inline constexpr std::array of_spheres = of_motion("largest of any sphere's centre, at the rows of the history");
inline constexpr std::array of_nodes = of_motion("largest of any node, at the rows of the history");

}  // namespace sazare::runs::figures
