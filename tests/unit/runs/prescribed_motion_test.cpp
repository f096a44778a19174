#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

/// What is moved by a history follows it in every method, whichever of displacement, velocity and acceleration gives it, and
/// stays where it is at the end of the history.
namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder;

/// x(t) = distance (s - sin(2 pi s) / (2 pi)), s = t / duration: at rest, without acceleration, at both ends. Runs last twice
/// that.
struct Way {
  Real distance = 0.1;  ///< [m]
  Real duration = 0.5;  ///< [s]
};

/// Rock is too stiff to be followed for long.
Way way_of(const std::string& method) { return method == "blocks" ? Way{1e-4, 5e-3} : Way{}; }

/// As displacements the way is measured from elsewhere.
Real motion_at(const Way& way, const std::string& quantity, Real time) {
  const Real omega = 2 * std::numbers::pi / way.duration, speed = way.distance / way.duration;
  if (quantity == "displacement [m]") return 0.3 * way.distance + speed * (time - std::sin(omega * time) / omega);
  if (quantity == "velocity [m/s]") return speed * (1 - std::cos(omega * time));
  return speed * omega * std::sin(omega * time);
}

void write_record(const fs::path& file, const Way& way, const std::string& quantity) {
  std::ofstream out(file);
  out.precision(15);
  out << "time [s]," << quantity << "\n";
  for (int i = 0; i <= 500; ++i) out << i * way.duration / 500 << "," << motion_at(way, quantity, i * way.duration / 500) << "\n";
}

/// What moves is moved by the motion "base"; the gauge "top" is a body on it.
const std::map<std::string, std::string>& bodies_on_a_base() {
  static const std::map<std::string, std::string> cases = {{"spheres", R"(
[[materials]]
name = "stone"
density = 2500.0
youngs_modulus = 1e7
poisson_ratio = 0.3
[contact]
restitution = 0.3
friction_coefficient = 0.5
[[spheres]]
name = "ball"
material = "stone"
source = "one"
centre = [0.0, 0.0, 0.05]
radius = 0.05
[[walls]]
name = "floor"
material = "stone"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
motion_z = "base"
[gravity]
acceleration = [0.0, 0.0, -9.81]
[[gauges]]
name = "top"
group = "ball"
)"},
                                                           {"mps", R"(
[particles]
spacing = 0.25
dimension = 2
[[regions]]
name = "column"
lower = [0.0, 0.0, 0.0]
upper = [1.0, 2.0, 0.0]
[[materials]]
name = "soil"
regions = ["column"]
density = 1500.0
s_wave_velocity = 100.0
p_wave_velocity = 200.0
damping_ratio = 0.1
[damping]
f1 = 5.0
f2 = 50.0
[[boundaries]]
side = "bottom"
kind = "prescribed"
motion_y = "base"
[[gauges]]
name = "top"
point = [0.5, 2.0, 0.0]
)"},
                                                           {"rectangles", R"(
[[blocks]]
name = "block"
material = "stone"
lower = [-0.5, 0.0, 0.0]
upper = [0.5, 1.0, 0.0]
[[materials]]
name = "stone"
density = 2500.0
face_normal_stiffness = 1e8
face_shear_stiffness = 1e8
[contact]
face_normal_stiffness = 1e8
face_shear_stiffness = 1e8
damping_ratio = 1.0
friction_angle = 30.0
[[walls]]
name = "table"
from = [-5.0, 0.0, 0.0]
to = [5.0, 0.0, 0.0]
motion_y = "base"
[gravity]
acceleration = [0.0, -9.81, 0.0]
[[gauges]]
name = "top"
point = [0.0, 0.5, 0.0]
)"},
                                                           {"fem", R"(
[mesh]
file = "column.geo"
dimension = 2
[[materials]]
name = "concrete"
regions = ["column"]
density = 2400.0
youngs_modulus = 1e7
poisson_ratio = 0.2
damping_ratio = 0.1
[damping]
f1 = 5.0
f2 = 50.0
[[boundaries]]
group = "foot"
kind = "prescribed"
motion_y = "base"
axes = ["x"]
[[gauges]]
name = "top"
point = [0.5, 2.0, 0.0]
)"},
                                                           {"blocks", R"(
[mesh]
file = "block.msh"
[[materials]]
name = "rock"
regions = ["rock"]
density = 2390.0
[[joints]]
name = "rock"
between = ["rock", "rock"]
joint_normal_stiffness = 450e9
joint_shear_stiffness = 90e9
joint_normal_damping = 2.26e6
joint_shear_damping = 1.01e6
cohesion = 6.66e6
friction_coefficient = 0.58
tensile_strength = 6.66e6
fracture_energy = 99.67
[contact]
contact_stiffness = 1.5e9
contact_damping = 3.08e5
friction_coefficient = 0.58
[[boundaries]]
surface = "hole"
kind = "prescribed"
motion_y = "base"
[[gauges]]
name = "top"
point = [0.2, 0.15, 0.2]
)"}};
  return cases;
}

/// A square column of 1 m by 2 m.
constexpr const char* column_geo = R"(
Point(1) = {0, 0, 0, 0.25}; Point(2) = {1, 0, 0, 0.25}; Point(3) = {1, 2, 0, 0.25}; Point(4) = {0, 2, 0, 0.25};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("foot") = {1}; Physical Surface("column") = {1};
)";

/// The column of a table of histories that has this name.
std::vector<Real> column(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  std::string line, word;
  std::getline(lines, line);
  std::istringstream titles(line);
  std::size_t place = 0;
  while (std::getline(titles, word, ',') && word != name) ++place;
  EXPECT_EQ(word, name);
  std::vector<Real> values;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    for (std::size_t i = 0; i <= place; ++i) std::getline(row, word, ',');
    values.push_back(std::stod(word));
  }
  return values;
}

/// The way that a gauge goes, by its velocities.
std::vector<Real> way_by(const std::vector<Real>& velocity, Real interval) {
  std::vector<Real> way = {0};
  for (std::size_t row = 1; row < velocity.size(); ++row)
    way.push_back(way.back() + 0.5 * interval * (velocity[row - 1] + velocity[row]));
  return way;
}

/// Displacement of the body along the motion, in a hundred rows; `method` "spheres" gives places, "blocks" velocities.
std::vector<Real> followed(const std::string& method, const std::string& quantity) {
  const TemporaryFolder folder;
  const Way of_base = way_of(method);
  const Real interval = of_base.duration / 50;
  write_record(folder / "base.csv", of_base, quantity);
  fs::copy_file("tests/regression/block/block.msh", folder / "block.msh");
  std::ofstream(folder / "column.geo") << column_geo;
  const std::string text = "[case]\ntitle = \"on a base\"\nmethod = \"" + method + "\"\n" + bodies_on_a_base().at(method) +
                           "[[motions]]\nname = \"base\"\ntype = \"record\"\nfile = \"base.csv\"\n[time]\nend = " +
                           fmt::format("{}\nhistory_interval = {}\n", 2 * of_base.duration, interval) +
                           (method == "fem"      ? "step = 1e-3\n"
                            : method == "blocks" ? "base_step = 1e-6\nsnapshot_interval = 1e-2\n"
                                                 : "");
  const cases::CaseFile file = registry::read_case_text(text, folder / "case.toml");
  EXPECT_NE(
      file.warnings.find(fmt::format("the record ends at {} s, before the run at {} s", of_base.duration, 2 * of_base.duration)),
      std::string::npos)
      << file.warnings;
  EXPECT_EQ(file.warnings.find("begins at a displacement of") != std::string::npos, quantity == "displacement [m]");
  test::run_quietly(file, folder / "run");
  const std::string gauges = read_text(folder / "run/gauges.csv");
  std::vector<Real> way = method == "blocks"    ? way_by(column(gauges, "top.velocity_y [m/s]"), interval)
                          : method == "spheres" ? column(gauges, "top.position_z [m]")
                                                : column(gauges, "top.displacement_y [m]");
  const Real first = way.front();
  for (Real& place : way) place -= first;
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_LT(std::abs(results["energy_residual"].get<Real>()), 0.01) << method << ", " << quantity;  // of some joules
  return way;
}

class PrescribedMotion : public testing::TestWithParam<const char*> {};

TEST_P(PrescribedMotion, is_followed_and_holds_whichever_way_it_is_given) {
  const std::string method = GetParam();
  const Real distance = way_of(method).distance;
  const std::vector<Real> by_displacement = followed(method, "displacement [m]"),
                          by_velocity = followed(method, "velocity [m/s]"),
                          by_acceleration = followed(method, "acceleration [m/s2]");
  ASSERT_EQ(by_velocity.size(), 101U);
  EXPECT_NEAR(by_velocity.back(), distance, 5e-3 * distance);  // less what it sinks into its contacts under its weight
  for (std::size_t i = 0; i < by_velocity.size(); ++i) {
    EXPECT_NEAR(by_displacement[i], by_velocity[i], 1e-3 * distance) << method << ", row " << i;
    EXPECT_NEAR(by_acceleration[i], by_velocity[i], 1e-3 * distance) << method << ", row " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(every_method, PrescribedMotion, testing::Values("spheres", "mps", "rectangles", "fem", "blocks"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace sazare::runs
