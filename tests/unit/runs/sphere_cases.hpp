#pragma once

/// Cases of method spheres for the tests.

#include <atomic>
#include <map>
#include <sstream>

#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs::sphere_cases {

/// All but the spheres.
inline const char* head = R"([case]
title = "grains"
method = "spheres"
[[materials]]
name = "glass"
density = 2500.0
youngs_modulus = 1e7
poisson_ratio = 0.2
[contact]
restitution = 0.6
friction_coefficient = 0.4
rolling_friction = 0.05
[gravity]
acceleration = [0.0, 0.0, -9.81]
[time]
end = 0.2
history_interval = 0.01
snapshot_interval = 0.1
[[walls]]
name = "floor"
material = "glass"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 2.0]
[domain]
periodic = ["x", "y"]
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.0]
)";

/// Few small spheres among large ones, which rest at the start, and a ball above: sizes of 1 to 8, four levels.
inline const char* mixed = R"([[spheres]]
name = "stones"
material = "glass"
source = "random"
radius = 0.006
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.06]
count = 100
rain = true
[[spheres]]
name = "sand"
material = "glass"
source = "random"
radius = 0.00075
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.06]
count = 8
rain = true
[[spheres]]
name = "ball"
material = "glass"
centre = [0.04, 0.04, 0.1]
radius = 0.006
velocity = [0.0, 0.0, -1.0]
[[gauges]]
name = "ball"
group = "ball"
)";

inline const char* tetrapods = R"([[shapes]]
name = "tetrapod"
height = 0.02
leg_spheres = 2
[[spheres]]
name = "armour"
material = "glass"
source = "random"
shape = "tetrapod"
random_rotation = true
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.15]
count = 20
velocity = [0.0, 0.0, -1.0]
[[gauges]]
name = "armour"
group = "armour"
)";

/// Tetrapods that break as they fall.
inline const char* brittle = R"([[shapes]]
name = "tetrapod"
height = 0.02
leg_spheres = 2
bonds = "concrete"
[[bonds]]
name = "concrete"
youngs_modulus = 1e7
poisson_ratio = 0.2
damping_ratio = 0.05
tensile_strength = 3e5
cohesion = 6e5
fracture_energy = 40.0
[[spheres]]
name = "armour"
material = "glass"
source = "random"
shape = "tetrapod"
random_rotation = true
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.15]
count = 20
velocity = [0.0, 0.0, -1.0]
[[gauges]]
name = "armour"
group = "armour"
)";

inline cases::CaseFile case_of(const test::TemporaryFolder& folder, const std::string& rest,
                               const std::vector<std::string>& settings = {}) {
  return registry::read_case(folder.write("case.toml", head + rest), settings);
}

inline RunOutcome carry_out(const cases::CaseFile& file, const std::filesystem::path& folder, Begin begin = Begin::fresh,
                            const StopRequest& stop = {}) {
  return registry::run_case(file, {folder, begin, true, stop});
}

/// The rows of a table, by the names of its columns without their units.
inline std::vector<std::map<std::string, Real>> rows_of(const std::filesystem::path& file) {
  std::istringstream lines(test::read_text(file));
  std::string names, values, name, value;
  std::getline(lines, names);
  std::vector<std::map<std::string, Real>> rows;
  while (std::getline(lines, values)) {
    std::istringstream columns(names), numbers(values);
    rows.emplace_back();
    while (std::getline(columns, name, ',') && std::getline(numbers, value, ','))
      rows.back()[name.substr(0, name.find(" ["))] = std::stod(value);
  }
  return rows;
}

}  // namespace sazare::runs::sphere_cases
