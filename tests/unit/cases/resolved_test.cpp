#include <gtest/gtest.h>

#include <array>

#include "case_folder.hpp"
#include "sazare/cases/format/schema.hpp"
#include "sazare/methods/blocks/case/format.hpp"

namespace sazare::cases {
namespace {

/// Blocks in water, by a theory of waves and by a table, which together give every key of water; an initial stress is refused
/// beside it, so that the full case has none.
std::array<std::string, 2> wet_cases() {
  const std::string water = smallest_case() + R"(
[gravity]
acceleration = [0, 0, -9.81]

[water]
level = 1.5
density = 1025
drag_coefficient = 1.2
current = [0.1, 0.2, 0]
wave_direction = 30
)";
  return {water + R"(waves = "stokes2"
bed = -5
wave_height = 0.4
wave_period = 4
wave_crest = 2
wave_ramp = 8
)",
          water + "waves = \"table\"\nwave_file = \"waves.csv\"\n"};
}

/// The smallest case with its stiffness by Young's modulus.
std::string elastic_case() {
  std::string text = replaced(smallest_case(), "density = 2700", "density = 2700\nyoungs_modulus = 36e9\npoisson_ratio = 0.2");
  for (const std::string key : {"joint_normal_stiffness", "joint_shear_stiffness"}) {
    const auto begin = text.find(key + " = ");
    text.erase(begin, text.find('\n', begin) + 1 - begin);
  }
  return text;
}

/// Each rate law with what it takes; a rate law needs Young's modulus, beside which the full case could not give stiffnesses.
std::array<std::string, 3> rate_cases() {
  const auto with = [](const std::string& law) {
    return replaced(elastic_case(), "cohesion = ", "rate_energy_exponent = 0.5\nrate_law = " + law + "\ncohesion = ");
  };
  return {with("\"malvar_ross\"\nstatic_compressive_strength = 30e6"),
          with("\"cowper_symonds\"\nrate_scale = 10\nrate_exponent = 3"),
          with("\"logarithmic\"\nrate_scale = 1e-3\nrate_slope = 0.1")};
}

/// The smallest case with a natural joint whose closure is estimated, and with one whose closure was measured.
std::array<std::string, 2> natural_cases() {
  const auto with = [](const std::string& own) {
    std::string text = replaced(smallest_case(), "cohesion = 6.66e6\n", "law = \"barton_bandis\"\njrc = 10\njcs = 100e6\n" + own);
    text = replaced(text, "friction_coefficient = 0.58\ntensile", "residual_friction_angle = 28\njoint_length = 2\ntensile");
    return replaced(text, "tensile_strength = 6.66e6\nfracture_energy = 99.67\n", "");
  };
  return {with("laboratory_length = 0.1\njoint_aperture = 0.2e-3\ndamage_coefficient = 1.5\n"),
          with("initial_normal_stiffness = 20e9\nmaximum_closure = 0.15e-3\n")};
}

/// Every number of a case is written in as many digits as it needs, so equal texts mean equal cases.
void expect_round_trip(const CaseFolder& folder, const std::string& text) {
  const BlocksCase first = folder.read(text).as<cases::BlocksCase>();
  const std::string resolved = write_resolved(first);
  const BlocksCase second = folder.read(resolved).as<cases::BlocksCase>();
  EXPECT_EQ(write_resolved(second), resolved);
  EXPECT_EQ(second.title, first.title);
  EXPECT_EQ(second.mesh.file, first.mesh.file);
  EXPECT_EQ(second.mesh.parameters, first.mesh.parameters);
  ASSERT_EQ(second.joints.size(), first.joints.size());
  for (std::size_t i = 0; i < first.joints.size(); ++i)
    EXPECT_EQ(second.joints[i].friction_coefficient, first.joints[i].friction_coefficient);
  EXPECT_EQ(second.time.history_interval, first.time.history_interval);
  EXPECT_EQ(second.time.snapshot_interval, first.time.snapshot_interval);
  EXPECT_EQ(second.time.base_step, first.time.base_step);
}

TEST(Resolved, ReadsBackToTheSameCase) {
  const CaseFolder folder;
  expect_round_trip(folder, smallest_case());
  expect_round_trip(folder, full_case());
  expect_round_trip(folder, replaced(smallest_case(), "end = 5e-4", "end = 0.0007300000000000001"));
}

TEST(Resolved, NamesFilesRelativeToItsFolder) {
  const CaseFolder folder;
  const BlocksCase blocks = folder.read(full_case()).as<cases::BlocksCase>();
  const std::string text = write_resolved(blocks, folder.path() / "results");
  EXPECT_NE(text.find("file = \"../block.geo\""), std::string::npos) << text;
  EXPECT_NE(text.find("table = \"../pressure.csv\""), std::string::npos);
}

/// Keys that stand for others, which the full case gives: a friction angle is written as its coefficient, and elasticity and damping
/// are given by the stiffnesses and dashpots of joints, and k0 by stresses that grow with depth.
bool is_other_way(std::string_view key) {
  return key == "friction_angle" || key == "youngs_modulus" || key == "poisson_ratio" || key == "damping_ratio" || key == "k0" ||
         key == "bulk_damping_ratio";
}

/// What a run writes in its folder is read again by `--resume`, so that it must be a case for the other way as well.
TEST(Resolved, ReadsBackWithElasticityAndDampingByTheOtherWay) {
  const CaseFolder folder;
  const std::string text = elastic_case();
  expect_round_trip(folder, replaced(text, "cohesion = ", "damping_ratio = 0.02\ncohesion = "));
  expect_round_trip(folder,
                    replaced(text, "poisson_ratio = 0.2", "poisson_ratio = 0.48\ndeformable = true\nbulk_damping_ratio = 0.1"));
  expect_round_trip(folder, text + "\n[gravity]\nacceleration = [0, 0, -9.81]\n\n[initial_stress]\nk0 = 0.5\ndatum = 3\n");
}

TEST(Resolved, ReadsBackWithWater) {
  const CaseFolder folder;
  for (const std::string& text : wet_cases()) expect_round_trip(folder, text);
}

TEST(Resolved, ReadsBackWithRateLaws) {
  const CaseFolder folder;
  for (const std::string& text : rate_cases()) expect_round_trip(folder, text);
}

TEST(Resolved, ReadsBackWithNaturalJoints) {
  const CaseFolder folder;
  for (const std::string& text : natural_cases()) expect_round_trip(folder, text);
}

TEST(Resolved, HoldsEveryKey) {
  const CaseFolder folder;
  std::string text = "\n" + write_resolved(folder.read(full_case()).as<cases::BlocksCase>());
  for (const std::string& wet : wet_cases()) text += write_resolved(folder.read(wet).as<cases::BlocksCase>());
  for (const std::string& of_rate : rate_cases()) text += write_resolved(folder.read(of_rate).as<cases::BlocksCase>());
  for (const std::string& natural : natural_cases()) text += write_resolved(folder.read(natural).as<cases::BlocksCase>());
  for (const Table& table : blocks_schema()) {
    for (const Key& key : table.keys) {
      if (is_other_way(key.name)) continue;
      EXPECT_NE(text.find("\n" + std::string(key.name) + " = "), std::string::npos) << table.name << "." << key.name;
    }
  }
}

TEST(Resolved, ShowsUnits) {
  const CaseFolder folder;
  const std::string text = write_resolved(folder.read(smallest_case()).as<cases::BlocksCase>());
  EXPECT_NE(text.find("density = 2700.0  # kg/m3\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace sazare::cases
