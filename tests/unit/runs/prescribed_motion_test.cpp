#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

/// What is moved by a history follows it in every method, whichever of displacement, velocity and acceleration gives it, and stays
/// where it is at the end of the history.
namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder;

constexpr Real distance = 0.1, duration = 0.5;

/// x(t) = distance (s - sin(2 pi s) / (2 pi)), s = t / duration: at rest, without acceleration, at both ends. As displacements it is
/// measured from elsewhere.
Real motion_at(const std::string& quantity, Real time) {
  const Real omega = 2 * std::numbers::pi / duration, speed = distance / duration;
  if (quantity == "displacement [m]") return 0.03 + speed * (time - std::sin(omega * time) / omega);
  if (quantity == "velocity [m/s]") return speed * (1 - std::cos(omega * time));
  return speed * omega * std::sin(omega * time);
}

void write_record(const fs::path& file, const std::string& quantity) {
  std::ofstream out(file);
  out.precision(15);
  out << "time [s]," << quantity << "\n";
  for (int i = 0; i <= 500; ++i) out << i * duration / 500 << "," << motion_at(quantity, i * duration / 500) << "\n";
}

/// What moves is moved by the motion "base"; the gauge "top" is a body on it.
const std::map<std::string, std::string>& bodies_on_a_base() {
  static const std::map<std::string, std::string> cases = {
      {"spheres", R"(
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

/// Displacement of the body along the motion, a row every hundredth of a second; `method` "spheres" gives places.
std::vector<Real> followed(const std::string& method, const std::string& quantity) {
  const TemporaryFolder folder;
  write_record(folder / "base.csv", quantity);
  std::ofstream(folder / "column.geo") << column_geo;
  const std::string text = "[case]\ntitle = \"on a base\"\nmethod = \"" + method + "\"\n" + bodies_on_a_base().at(method) +
                           "[[motions]]\nname = \"base\"\ntype = \"record\"\nfile = \"base.csv\"\n[time]\nend = 1.0\n"
                           "history_interval = 0.01\n" + (method == "fem" ? "step = 1e-3\n" : "");
  const cases::CaseFile file = registry::read_case_text(text, folder / "case.toml");
  EXPECT_NE(file.warnings.find("the record ends at 0.5 s, before the run at 1 s"), std::string::npos) << file.warnings;
  EXPECT_EQ(file.warnings.find("begins at a displacement of 0.03 m") != std::string::npos, quantity == "displacement [m]");
  test::run_quietly(file, folder / "run");
  const std::string gauges = read_text(folder / "run/gauges.csv");
  std::vector<Real> way = column(gauges, method == "spheres" ? "top.position_z [m]" : "top.displacement_y [m]");
  const Real first = way.front();
  for (Real& place : way) place -= first;
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_LT(std::abs(results["energy_residual"].get<Real>()), 0.01) << method << ", " << quantity;  // of some joules
  return way;
}

class PrescribedMotion : public testing::TestWithParam<const char*> {};

TEST_P(PrescribedMotion, is_followed_and_holds_whichever_way_it_is_given) {
  const std::string method = GetParam();
  const std::vector<Real> by_displacement = followed(method, "displacement [m]"), by_velocity = followed(method, "velocity [m/s]"),
                          by_acceleration = followed(method, "acceleration [m/s2]");
  ASSERT_EQ(by_velocity.size(), 101U);
  EXPECT_NEAR(by_velocity.back(), distance, 5e-3 * distance);  // less what it sinks into its contacts under its weight
  for (std::size_t i = 0; i < by_velocity.size(); ++i) {
    EXPECT_NEAR(by_displacement[i], by_velocity[i], 1e-3 * distance) << method << ", row " << i;
    EXPECT_NEAR(by_acceleration[i], by_velocity[i], 1e-3 * distance) << method << ", row " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(every_method, PrescribedMotion, testing::Values("spheres", "mps", "rectangles", "fem"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace sazare::runs
