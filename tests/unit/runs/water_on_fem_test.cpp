#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

/// Water on the faces of a case of method fem, and in its joints.
namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder, test::words_of;

/// A caisson of 4 x 4 m in the middle of ground 12 m wide and 2 m deep, at x = 4 m and y = 0.
constexpr const char* geometry = R"(
Point(1) = {0, -2, 0}; Point(2) = {4, -2, 0}; Point(3) = {8, -2, 0}; Point(4) = {12, -2, 0};
Point(5) = {0, 0, 0}; Point(6) = {4, 0, 0}; Point(7) = {8, 0, 0}; Point(8) = {12, 0, 0};
Point(9) = {4, 4, 0}; Point(10) = {8, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 8}; Line(5) = {8, 7}; Line(6) = {7, 6}; Line(7) = {6, 5};
Line(8) = {5, 1}; Line(9) = {2, 6}; Line(10) = {3, 7}; Line(11) = {7, 10}; Line(12) = {10, 9}; Line(13) = {9, 6};
Curve Loop(1) = {1, 9, 7, 8}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 10, 6, -9}; Plane Surface(2) = {2};
Curve Loop(3) = {3, 4, 5, -10}; Plane Surface(3) = {3};
Curve Loop(4) = {-6, 11, 12, 13}; Plane Surface(4) = {4};
Transfinite Curve{1, 2, 3, 5, 6, 7, 12, 11, 13} = 5;
Transfinite Curve{4, 8, 9, 10} = 3;
Transfinite Surface{1:4};
Recombine Surface{1:4};
Physical Surface("ground") = {1, 2, 3};
Physical Surface("caisson") = {4};
Physical Curve("base") = {1, 2, 3};
Physical Curve("sides") = {4, 8};
Physical Curve("sea") = {13};
Physical Curve("land") = {11};
Physical Curve("top") = {12};
Physical Curve("sole") = {6};
Physical Curve("inside") = {9};
Physical Curve("bed_left") = {7};
Physical Curve("bed_right") = {5};
)";

constexpr const char* body = R"([case]
title = "Caisson"
method = "fem"

[mesh]
file = "caisson.geo"

[[materials]]
name = "ground"
regions = ["ground"]
density = 1900
youngs_modulus = 2e8
poisson_ratio = 0.3

[[materials]]
name = "caisson"
regions = ["caisson"]
density = 2400
youngs_modulus = 1e10
poisson_ratio = 0.2

[[joints]]
name = "foot"
between = ["caisson", "ground"]
joint_normal_stiffness = 1e9
joint_shear_stiffness = 1e9
friction_angle = 30

[[boundaries]]
group = "base"
kind = "fixed"

[[gauges]]
name = "top"
point = [4, 4, 0]

[gravity]
acceleration = [0, -9.81, 0]
settle = true

[time]
end = 1.0
step = 0.05
analysis = "static"
)";

class Folder {
public:
  Folder() { std::ofstream(folder_ / "caisson.geo") << geometry; }

  cases::CaseFile read(const std::string& waters, std::vector<std::string> settings = {}) const {
    std::ofstream(folder_ / "case.toml") << body << waters;
    return registry::read_case(folder_ / "case.toml", settings);
  }
  nlohmann::json run(const cases::CaseFile& file) const {
    fs::remove_all(folder_ / "run");
    registry::run_case(file, {folder_ / "run", Begin::fresh, true, nullptr});
    return read_manifest(folder_ / "run");
  }
  std::string history() const { return read_text(folder_ / "run/history.csv"); }
  std::string gauges() const { return read_text(folder_ / "run/gauges.csv"); }
  std::string refused(const std::string& waters, const std::vector<std::string>& settings = {}) const {
    return words_of<UserError>([&] { registry::check_case(read(waters, settings)); });
  }
  fs::path operator/(const std::string& name) const { return folder_ / name; }

private:
  TemporaryFolder folder_;
};

/// A number of the last row.
Real last_of(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::string titles, line, last, word;
  std::getline(lines, titles);
  while (std::getline(lines, line)) last = line;
  std::istringstream names(titles), values(last);
  std::string value;
  while (std::getline(names, word, ',') && std::getline(values, value, ','))
    if (word == name) return std::stod(value);
  ADD_FAILURE() << "no column " << name << " in " << titles;
  return 0;
}

std::string water(const std::string& name, const std::string& keys) {
  return "\n[[water_pressures]]\nname = \"" + name + "\"\n" + keys;
}

const std::string sea = water("sea", "group = \"sea\"\nlevel = 3\n"), land = water("land", "group = \"land\"\nlevel = 1\n"),
                  uplift = water("uplift", "joint = \"foot\"\nlevel = 3\nfar_level = 1\n");

TEST(water_on_fem, presses_by_its_level_and_lifts_by_the_levels_of_both_ends) {
  const Folder folder;
  const auto results = folder.run(folder.read(sea + land + uplift))["results"];
  const std::string history = folder.history();
  constexpr Real weight = 9810;
  EXPECT_NEAR(last_of(history, "sea.water_force_x [N]"), weight * 4.5, 1e-9 * weight);
  EXPECT_NEAR(last_of(history, "land.water_force_x [N]"), -weight * 0.5, 1e-9 * weight);
  EXPECT_NEAR(last_of(history, "uplift.water_force_y [N]"), weight * 4 * 2, 1e-9 * weight);
  EXPECT_NEAR(last_of(history, "base.force_x [N]"), -weight * 4, 1e-6 * weight);
  EXPECT_NEAR(last_of(history, "base.force_y [N]"), 9.81 * (1900 * 24 + 2400 * 16), 1e-5 * weight);
  // All was there when the body settled: nothing has moved since.
  EXPECT_LT(results["peak_displacement"].get<double>(), 1e-9);
}

TEST(water_on_fem, has_its_level_at_the_end_from_which_the_direction_points) {
  const Folder folder;
  const auto swing = [&](const std::string& direction) {
    const auto results = folder.run(folder.read(uplift + "ramp = 1\n" + direction))["results"];
    EXPECT_LT(std::abs(results["energy_residual"].get<double>()), 1e-6 * std::abs(results["energy_work"].get<double>()));
    EXPECT_GT(last_of(folder.history(), "energy_work_water [J]"), 0);
    return last_of(folder.gauges(), "top.displacement_x [m]");
  };
  const Real one = swing(""), other = swing("direction = [-2, 0, 0]\n");
  EXPECT_GT(one, 0);  // higher pressure on the left turns the caisson to the right
  EXPECT_LT(other, 0);
  EXPECT_NE(one, -other);  // the gauge is on one side
}

/// The sea pushes with 9810 h^2/2 N/m, friction holds W tan 30 less uplift.
TEST(water_on_fem, pushes_a_caisson_off_its_foot_when_its_effective_weight_is_too_small) {
  const Folder folder;
  const auto settings = [](Real mass_density) {
    return std::vector<std::string>{"materials.1.density=" + std::to_string(mass_density), "solver.max_cuts=3"};
  };
  const std::string full =
      water("sea", "group = \"sea\"\nlevel = 4\n") + water("uplift", "joint = \"foot\"\nlevel = 4\nfar_level = 0\n");
  // W = (push / tan 30 + uplift): push 78480, uplift 78480 N/m.
  const Real density = (78480 * std::sqrt(3.0) + 78480) / (9.81 * 16);
  EXPECT_EQ(folder.run(folder.read(full, settings(1.01 * density)))["status"], "done");
  const std::string words = words_of<PhysicsError>([&] { folder.run(folder.read(full, settings(0.99 * density))); });
  EXPECT_NE(words.find("of gravity and of the pressure of water"), std::string::npos) << words;
  // Without uplift it stands.
  EXPECT_EQ(folder.run(folder.read(water("sea", "group = \"sea\"\nlevel = 4\n"), settings(0.99 * density)))["status"], "done");
}

TEST(water_on_fem, in_many_parts_gives_the_bits_of_one_run) {
  const Folder folder;
  const auto file = folder.read(water("sea", "group = \"sea\"\nlevel = 3\nadded_mass = \"westergaard\"\nramp = 0.5\n") + uplift +
                                    "\n[[boundaries]]\ngroup = \"sides\"\nkind = \"viscous\"\n",
                                {"time.analysis=dynamic", "time.step=5e-4"});
  test::run_in_parts(file, folder / "parts", test::run_whole(file, folder / "whole"));
  EXPECT_GT(last_of(read_text(folder / "whole/history.csv"), "energy_kinetic_water [J]"), 0);
  test::expect_same_runs(folder / "whole", folder / "parts");
}

TEST(water_on_fem, says_what_does_not_fit_the_mesh) {
  const Folder folder;
  const auto expect = [&](const std::string& waters, const std::string& words) {
    const std::string found = folder.refused(waters);
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  expect(water("w", "group = \"see\"\nlevel = 3\n"), "the mesh has no group \"see\"");
  expect(water("w", "group = \"inside\"\nlevel = 3\n"), "the group \"inside\" lies inside the body, where there is no water");
  expect(water("w", "group = \"sole\"\nlevel = 3\n"), "faces of the group \"sole\" lie in the joint \"foot\"");
  expect(water("w", "group = \"sole\"\nlevel = 3\n"), "write joint = \"foot\" instead of the group");
  expect(water("w", "group = \"sea\"\nlevel = 3\nfar_level = 1\n"), "the group \"sea\" is no base: faces of it do not look down");
  expect(water("w", "group = \"top\"\nlevel = 6\nfar_level = 1\n"), "the group \"top\" is no base");
  expect(water("w", "group = \"base\"\nlevel = 6\nfar_level = 1\nadded_mass = \"westergaard\"\n"), "not with far_level");
  expect(water("w", "group = \"top\"\nlevel = 6\nadded_mass = \"westergaard\"\n"), "are less than 30 degrees from horizontal");
  expect(water("w", "group = \"sea\"\nlevel = 3\nadded_mass = \"westergaard\"\nbed = 1\n"), "reaches down to 0 m, below the bed");
}

TEST(water_on_fem, warns_of_water_that_wets_nothing_at_its_line) {
  const Folder folder;
  const auto dry = water("w", "group = \"sea\"\nlevel = -1\n");
  const std::string words = registry::check_case(folder.read(dry));
  EXPECT_NE(words.find("the water does nothing: all faces of the group \"sea\" lie above its level"), std::string::npos) << words;
  EXPECT_NE(words.find("level = -1"), std::string::npos) << words;
  EXPECT_NE(folder.refused(dry, {"time.strict=true"}).find("the water does nothing"), std::string::npos);
}

TEST(water_on_fem, is_told_by_the_check) {
  const Folder folder;
  const std::string words = registry::check_case(
      folder.read(water("sea", "group = \"sea\"\nlevel = 3\nadded_mass = \"westergaard\"\n"), {"time.analysis=dynamic"}));
  EXPECT_NE(words.find("sea: 1000 kg/m3 on sea, level 3 m, Westergaard's added mass"), std::string::npos) << words;
  EXPECT_NE(words.find("sea wets 3 m, pressure (44140, 0, 0) N/m, added mass 5254 kg/m"), std::string::npos) << words;
}

TEST(water_on_fem, keeps_its_keys_when_the_resolved_case_is_read_again) {
  const Folder folder;
  const auto file =
      folder.read(water("sea", "group = \"sea\"\nlevel = 3\nadded_mass = \"westergaard\"\nbed = -1\ndensity = 1030\n") + uplift +
                      "direction = [-1, 0, 0]\nramp = 0.5\n",
                  {"time.analysis=dynamic", "time.end=0.1"});
  folder.run(file);
  const std::string once = read_text(folder / "run/case.toml");
  for (const char* const key :
       {"bed = -1", "joint = \"foot\"", "far_level = 1", "direction = [-1", "ramp = 0.5", "density = 1030"})
    EXPECT_NE(once.find(key), std::string::npos) << key << once;
  fs::create_directories(folder / "again");
  registry::run_case(registry::read_case(folder / "run/case.toml", {}), {folder / "again", Begin::fresh, true, nullptr});
  EXPECT_EQ(read_manifest(folder / "run")["state_hash"], read_manifest(folder / "again")["state_hash"]);
}

TEST(water_on_fem, warns_of_faces_that_the_water_in_the_pores_pushes_out) {
  const Folder folder;
  const std::vector<std::string> wet = {"materials.0.water_table=-0.5", "materials.0.saturated_density=2000"};
  const std::string sides = "\n[[boundaries]]\ngroup = \"sides\"\nkind = \"roller\"\naxes = [\"x\"]\n";
  const std::string free = registry::check_case(folder.read("", wet)), held = registry::check_case(folder.read(sides, wet));
  EXPECT_NE(free.find("nothing holds 2 faces of the ground below its water table against the water in the pores"),
            std::string::npos)
      << free;
  EXPECT_EQ(held.find("nothing holds"), std::string::npos) << held;
  const std::string deep =
      registry::check_case(folder.read(sides, {"materials.0.water_table=1", "materials.0.saturated_density=2000"}));
  EXPECT_NE(deep.find("nothing holds 12 faces"), std::string::npos) << deep;  // the surface, and the joint
}

/// The ground under the sea: its skeleton bears what it weighs under water, and the caisson on its foot what it weighs less
/// uplift.
TEST(water_on_fem, leaves_saturated_ground_its_effective_stress) {
  const Folder folder;
  const std::string bed =
      water("left", "group = \"bed_left\"\nlevel = 3\n") + water("right", "group = \"bed_right\"\nlevel = 3\n");
  const std::string walls = water("sea", "group = \"sea\"\nlevel = 3\n") + water("land", "group = \"land\"\nlevel = 3\n") +
                            water("uplift", "joint = \"foot\"\nlevel = 3\n");
  const std::vector<std::string> wet = {"materials.0.water_table=3", "materials.0.saturated_density=2000"};
  const auto results = folder.run(
      folder.read(bed + walls + "\n[[boundaries]]\ngroup = \"sides\"\nkind = \"roller\"\naxes = [\"x\"]\n", wet))["results"];
  EXPECT_LT(results["peak_displacement"].get<double>(), 1e-9);
  const std::string history = folder.history();
  // On 12 m of base: the ground with its water, the caisson, and the sea over 8 m of bed; what the caisson displaces it carries.
  EXPECT_NEAR(last_of(history, "base.force_y [N]"), 9.81 * (2000 * 24 + 2400 * 16 + 1000 * 3 * 8), 1e-6 * 9.81 * 1e5);
  EXPECT_NEAR(last_of(history, "base.force_x [N]"), 0, 1e-3);
}

}  // namespace
}  // namespace sazare::runs
