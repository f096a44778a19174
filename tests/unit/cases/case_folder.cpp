#include <gtest/gtest.h>

#include "case_folder.hpp"
#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace fs = std::filesystem;

CaseFolder::CaseFolder() {
  write("slab.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  write("block.geo", "// an empty geometry\n");
  write("pressure.csv", "time [s],pressure [Pa]\r\n0,0\r\n1.33e-4, 5.75e8\r\n5e-4,0\r\n");
  write("waves.csv", "time [s],elevation [m],velocity [m/s]\r\n0,0,0\r\n1,0.2,0.1\r\n");
  write("shake.csv", "time [s],velocity [m/s]\r\n0,0\r\n1e-3,0.1\r\n2e-3,0.2\r\n");
}

CaseFile CaseFolder::read(const std::string& text, const std::vector<std::string>& overrides) const {
  return registry::read_case(write("case.toml", text), overrides);
}

std::string CaseFolder::refusal(const std::string& text, const std::vector<std::string>& overrides) const {
  try {
    read(text, overrides);
  } catch (const UserError& failure) {
    return failure.what();
  }
  ADD_FAILURE() << "the case was not refused:\n" << text;
  return "";
}

std::string smallest_case() {
  return R"([case]
title = "Small"
method = "blocks"

[mesh]
file = "slab.msh"

[[materials]]
name = "rock"
regions = ["rock"]
density = 2700

[[joints]]
name = "rock"
between = ["rock", "rock"]
joint_normal_stiffness = 450e9
joint_shear_stiffness = 90e9
cohesion = 6.66e6
friction_coefficient = 0.58
tensile_strength = 6.66e6
fracture_energy = 99.67

[contact]
contact_stiffness = 1.5e9
friction_coefficient = 0.58

[time]
end = 5e-4
)";
}

std::string full_case() {
  return R"([case]
title = "Full \"quoted\" 発破"
method = "blocks"

[mesh]
file = "block.geo"
scale = 0.001
size_factor = 0.5
parameters = { depth = 3, "edge length" = 0.1 }

[[materials]]
name = "rock"
regions = ["rock", "roof"]
density = 2700.0

[[materials]]
name = "clay"
regions = ["clay"]
density = 1800.5

[[joints]]
name = "rock"
between = ["rock", "rock"]
bonded = true
law = "mixed_mode"
joint_normal_stiffness = 450e9
joint_shear_stiffness = 90e9
joint_normal_damping = 22.6e6
joint_shear_damping = 10.1e6
cohesion = 6.66e6
friction_angle = 30
tensile_strength = 6.66e6
fracture_energy = 99.67
weibull_modulus = 12.0
scatter_seed = 7
shear_fracture_energy = 900.0
residual_friction_coefficient = 0.4

[[joints]]
name = "seam"
between = ["rock", "clay"]
joint_normal_stiffness = 1e9
joint_shear_stiffness = 1e8
cohesion = 0
friction_coefficient = 0.3
tensile_strength = 1e3
fracture_energy = 0.1

[[joints]]
name = "slit"
surface = "slit"
bonded = false

[contact]
contact_stiffness = 1.5e9
contact_damping = 3.08e6
friction_angle = 31.5
damping_cap = "critical"
edge_division = 6
contact_shape = "faces"
face_contact_stiffness = 450e9
face_contact_damping = 1e6

[[blasts]]
name = "hole 1"
surface = "hole_1"
delay = 1e-4
peak_pressure = 5.75e8
rise_time = 1.33e-4
decay_ratio = 2.75
cut_distance = 0.005

[[blasts]]
surface = "hole_2"
table = "pressure.csv"

[[blasts]]
surface = "hole_3"
function = true

[gravity]
acceleration = [0, 0.1, -9.81]

[initial_stress]
normal_stress = [-3e6, -1e6, -2e6]
shear_stress = [0, 2e5, 0]
normal_stress_per_depth = [-1e4, -1e4, -26487]
shear_stress_per_depth = [0, 0, 100]
datum = 12.5

[[boundaries]]
surface = "left"
kind = "absorbing"

[[boundaries]]
surface = "bottom"
kind = "frictionless"

[[constraints]]
regions = ["rock"]
translation = ["z", "x"]
rotation = ["y"]

[[initial_velocities]]
regions = ["roof"]
velocity = [0.1, 0, -1e-3]

[[gauges]]
name = "G1"
point = [0.3, 0.6, 0.1]

[time]
end = 5e-4
levels = "uniform"
limiter = "travel"
base_step = 1e-8
stability_fraction = 0.5
travel_length = 2e-8
neighbor_levels = 3
history_interval = 1e-6
snapshot_interval = 2.5e-5
strict = true

[output]
checkpoint_interval = 30

[[motions]]
name = "shake"
type = "sine"
quantity = "velocity"
amplitude = 0.1
frequency = 20
cycles = 2

[[motions]]
name = "wavelet"
type = "ricker"
frequency = 1000
peak_time = 1e-3

[[motions]]
name = "record"
type = "record"
file = "shake.csv"
baseline = "linear"

[[boundaries]]
surface = "top"
kind = "prescribed"
motion_x = "shake"
motion_y = "wavelet"
motion_z = "record"

[[charges]]
name = "upper deck"
surface = "hole_4"
collar = [0, 0, 1]
toe = [0, 0, -9]
diameter = 0.089
charge_diameter = 0.065
share = 0.5
top = 2.5
bottom = 5
primer = 4.5
vents = true
stemming_density = 1700
stemming_resistance = 1e5
gas_in_cracks = "flow"
crack_aperture = 2e-4
discharge_coefficient = 0.7
explosive = "ANFO"
detonation_velocity = 3900
delay = 2.5e-4
delay_scatter = 1e-5
scatter_seed = 7
cut_distance = 0.5

[[charges]]
name = "lower deck"
surface = "hole_4"
collar = [0, 0, 1]
toe = [0, 0, -9]
diameter = 0.089
gas_in_cracks = "share"
crack_pressure_share = 0.5
top = 6
explosive = "custom"
density = 1150
detonation_velocity = 5000
gas_exponent = 3

[[charges]]
surface = "hole_5"
collar = [3, 0, 1]
toe = [3, 0, -9]
diameter = 0.089
explosive = "custom"
density = 1630
detonation_velocity = 6930
explosive_energy = 4.294e6
jwl_a = 371.2e9
jwl_b = 3.231e9
jwl_r1 = 4.15
jwl_r2 = 0.95
jwl_omega = 0.3
)";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "not in the case: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

}  // namespace sazare::cases
