#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/strength_reduction.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder, test::words_of;

/// A study of one case, of which `settings` are lines of [factor].
cases::Study study_of(const TemporaryFolder& folder, const fs::path& file, const std::string& settings,
                      const std::string& parameters = "") {
  std::ofstream(folder / "study.toml")
      << "[study]\ntitle = \"s\"\nfind = \"factor_of_safety\"\n[[families]]\nname = \"a\"\ncase = \""
      << fs::absolute(file).string() << "\"\n"
      << parameters << "[factor]\n"
      << settings;
  return cases::read_study(folder / "study.toml");
}

StudyOutcome run(const cases::Study& study, const fs::path& folder, Begin begin = Begin::fresh) {
  return registry::run_study(study, {folder, begin, true, 1, nullptr});
}

/// One column of study.csv, by its number from the end.
std::vector<double> column(const fs::path& folder, std::size_t from_end) {
  std::istringstream lines(read_text(folder / "study.csv"));
  std::vector<double> found;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, ',');) fields.push_back(field);
    found.push_back(std::stod(fields.at(fields.size() - from_end)));
  }
  return found;
}

/// A block of elastic elements that rests on a joint, under gravity that is turned by 20 degrees.
fs::path block_on_a_joint(const TemporaryFolder& folder, const std::string& strength) {
  std::ofstream(folder / "block.geo") << R"(
Point(1) = {0, 0, 0, 0.5}; Point(2) = {2, 0, 0, 0.5}; Point(3) = {2, 0.5, 0, 0.5}; Point(4) = {0, 0.5, 0, 0.5};
Point(5) = {2, 1, 0, 0.5}; Point(6) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Surface("base") = {1}; Physical Surface("block") = {2};
Physical Curve("bottom") = {1};
)";
  std::ofstream(folder / "block.toml") << R"([case]
title = "block"
method = "fem"
[mesh]
file = "block.geo"
dimension = 2
[[materials]]
name = "rock"
regions = ["base", "block"]
density = 2000.0
youngs_modulus = 1e9
poisson_ratio = 0.2
[[joints]]
name = "joint"
between = ["base", "block"]
joint_normal_stiffness = 1e9
joint_shear_stiffness = 1e9
)" << strength << R"([[boundaries]]
group = "bottom"
kind = "fixed"
[gravity]
acceleration = [3.3552, -9.2184, 0.0]
[time]
analysis = "static"
end = 1.0
step = 1.0
)";
  return folder / "block.toml";
}

TEST(strength_reduction, divides_cohesion_and_the_tangent_of_the_friction_angle) {
  const ReducedStrength reduced = ReducedStrength{10e3, 45, 40, 4e3}.over(2);
  EXPECT_DOUBLE_EQ(reduced.cohesion, 5e3);
  EXPECT_NEAR(reduced.friction_angle, std::atan(0.5) * 180 / std::numbers::pi, 1e-12);
  EXPECT_DOUBLE_EQ(reduced.dilation_angle, reduced.friction_angle);
  EXPECT_DOUBLE_EQ(*reduced.tensile_strength, 2e3);
  EXPECT_DOUBLE_EQ((ReducedStrength{1, 30, 10, {}}.over(1.2).dilation_angle), 10);
}

/// A block on a plane of 20 degrees: tan(friction)/tan(20) without cohesion, and c A/(W sin(20)) without friction.
TEST(strength_reduction, finds_the_factor_of_a_block_on_a_joint) {
  for (const auto& [strength, exact] : {std::pair{"friction_angle = 30.0\n", std::tan(std::numbers::pi / 6) / 0.36397},
                                        {"cohesion = 5e3\nfriction_angle = 0.0\n", 5e3 / (2000 * 0.5 * 3.3552)}}) {
    const TemporaryFolder folder;
    const cases::Study study = study_of(folder, block_on_a_joint(folder, strength), "ratio = 1.005\ndisplacement_ratio = 100\n");
    EXPECT_EQ(run(study, folder / "out").done, 1);
    EXPECT_NEAR(column(folder / "out", 5).at(0), exact, 0.02 * exact) << strength;
    EXPECT_NEAR(read_manifest(folder / "out")["results"]["smallest_factor"].get<double>(), exact, 0.02 * exact);
    EXPECT_NE(read_text(folder / "out/trials/00000.csv").find("there is no equilibrium"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "out/trials/00000_slip.csv"));
  }
}

TEST(strength_reduction, says_on_which_side_the_bounds_do_not_bracket) {
  const TemporaryFolder folder;
  const fs::path file = block_on_a_joint(folder, "friction_angle = 30.0\n");
  const auto words = [&](const std::string& bounds) {
    return words_of<UserError>([&] { run(study_of(folder, file, bounds), folder / "out", Begin::overwrite); });
  };
  const std::string low = words("lower = 2.0\nupper = 3.0\n"), high = words("lower = 1.0\nupper = 1.2\n");
  EXPECT_NE(low.find("study.toml:8:9: error: case 0 of the study"), std::string::npos) << low;
  EXPECT_NE(low.find("the factor of safety lies below: give a smaller lower"), std::string::npos) << low;
  EXPECT_NE(high.find("study.toml:9:9: error: case 0 of the study"), std::string::npos) << high;
  EXPECT_NE(high.find("still stands with its strength over the upper bound of 1.2"), std::string::npos) << high;
}

TEST(strength_reduction, of_several_cases_goes_on_where_the_bounds_do_not_bracket_one) {
  const TemporaryFolder folder;
  const cases::Study study = study_of(folder, block_on_a_joint(folder, "friction_angle = 30.0\n"), "lower = 1.0\nupper = 1.4\n",
                                      "[[parameters]]\nname = \"friction\"\nkeys = [\"joints.0.friction_angle\"]\n"
                                      "values = [15, 24, 30]\n");
  EXPECT_EQ(run(study, folder / "out").done, 3);
  const std::vector<double> lower = column(folder / "out", 7), upper = column(folder / "out", 6),
                            factor = column(folder / "out", 5);
  EXPECT_EQ(lower.at(0), 0);
  EXPECT_EQ(upper.at(0), 1);
  EXPECT_NEAR(factor.at(1), std::tan(24 * std::numbers::pi / 180) / 0.36397, 0.02);
  EXPECT_EQ(lower.at(2), 1.4);
  EXPECT_TRUE(std::isinf(upper.at(2)));
  for (const std::size_t i : {0, 2}) EXPECT_TRUE(std::isnan(factor.at(i)));
  const nlohmann::json results = read_manifest(folder / "out")["results"];
  EXPECT_EQ(results["smallest_factor"], results["largest_factor"]);
  // Rows that are read again count as they did.
  std::ofstream(folder / "out/manifest.json") << R"({"status": "stopped"})";
  EXPECT_NE(run(study, folder / "out", Begin::resume).summary.find("2 of 3 cases have a factor below lower or above upper"),
            std::string::npos);
}

/// Particles of a slope, coarse.
TEST(strength_reduction, bisects_ground_of_particles_and_goes_on_where_it_stopped) {
  const TemporaryFolder folder;
  const cases::Study study =
      study_of(folder, "cases/slope-factor-of-safety/particles.toml", "lower = 1.0\nupper = 3.0\nratio = 1.05\n",
               "[[parameters]]\nname = \"cohesion\"\nkeys = [\"materials.0.cohesion\"]\nvalues = [10e3, 15e3]\n"
               "[[parameters]]\nname = \"spacing\"\nkeys = [\"particles.spacing\"]\nvalues = [1.0]\n");
  EXPECT_EQ(run(study, folder / "whole").done, 2);
  const std::vector<double> factors = column(folder / "whole", 5);
  EXPECT_GT(factors.at(0), 1.3);
  EXPECT_LT(factors.at(0), 2.0);
  EXPECT_GT(factors.at(1), 1.1 * factors.at(0));
  const std::string text = read_text(folder / "whole/study.csv");

  fs::copy(folder / "whole", folder / "part", fs::copy_options::recursive);
  std::ofstream(folder / "part/study.csv") << text.substr(0, text.find('\n', text.find('\n') + 1) + 1);
  std::ofstream(folder / "part/manifest.json") << R"({"status": "stopped"})";
  EXPECT_EQ(run(study, folder / "part", Begin::resume).done, 2);
  EXPECT_EQ(test::without_last_column(read_text(folder / "part/study.csv")), test::without_last_column(text));
}

TEST(strength_reduction, refuses_cases_that_have_no_factor) {
  const TemporaryFolder folder;
  const auto words = [&](const fs::path& file, const std::string& parameters = "") {
    return words_of<UserError>([&] { run(study_of(folder, file, "", parameters), folder / "out", Begin::overwrite); });
  };
  const std::string none = words("cases/column-ricker/case.toml");
  EXPECT_NE(none.find("without gravity no ground slides"), std::string::npos) << none;
  std::ofstream(folder / "elastic.toml") << read_text("cases/column-ricker/case.toml")
                                         << "[gravity]\nacceleration = [0.0, -9.81, 0.0]\nsettle = true\n";
  const std::string elastic = words(folder / "elastic.toml");
  EXPECT_NE(elastic.find("no material has a strength, so there is nothing to divide"), std::string::npos) << elastic;
  const std::string other = words("cases/crater-test/case.toml");
  EXPECT_NE(other.find("study.toml:6:8: error: a factor of safety cannot be sought in cases of method blocks"), std::string::npos)
      << other;
  EXPECT_NE(other.find("it can in those of: mps, fem"), std::string::npos) << other;
}

}  // namespace
}  // namespace sazare::runs
