#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder, test::words_of;

cases::CaseFile slope(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(), {"time.end=3", "time.step=0.02", "mesh.parameters={size=5, flat=30}",
                                     "gauges.1.point=[-30, 22, 0]", "gauges.5.point=[66, 40, 0]"});
  return registry::read_case("cases/slope-free-field/case.toml", settings);
}

/// The record as a wave that comes at an angle from below the valley.
std::vector<std::string> inclined(std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {R"(boundaries.0={group="base", kind="viscous"})", R"(incident_wave={kind="sv", motion="el-centro", angle=15})"});
  return more;
}

void expect_same_bits_in_parts(const std::vector<std::string>& settings) {
  const TemporaryFolder folder;
  test::run_in_parts(slope(settings), folder / "parts", test::run_whole(slope(settings), folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  EXPECT_GT(read_manifest(folder / "whole")["results"]["energy_plastic"].get<double>(), 0);
}

TEST(free_field_run, in_parts_gives_the_bits_of_one_run) { expect_same_bits_in_parts({}); }

TEST(free_field_run, of_a_wave_at_an_angle_in_parts_gives_the_bits_of_one_run) { expect_same_bits_in_parts(inclined()); }

std::string refused(const std::vector<std::string>& settings) {
  return words_of<UserError>([&] { registry::check_case(slope(settings)); });
}

TEST(free_field_run, refuses_sides_beside_which_no_column_can_stand) {
  const std::string flat = refused({"boundaries.1.group=base"});
  EXPECT_NE(flat.find("is not vertical and across x"), std::string::npos) << flat;
  const std::string floating = refused({"boundaries.0.group=hill side", "boundaries.2.group=valley side", "gravity.settle=true"});
  EXPECT_NE(floating.find("has no base: nothing carries it along x at 0 m"), std::string::npos) << floating;
}

/// Rock of 8 m below soil of 6 m; the group "left" has the faces of the rock alone.
TEST(free_field_run, refuses_a_side_that_ends_below_the_surface) {
  const TemporaryFolder folder;
  folder.write("layers.geo", R"(
Point(1) = {0, 0, 0, 2}; Point(2) = {20, 0, 0, 2}; Point(3) = {20, 8, 0, 2}; Point(4) = {0, 8, 0, 2};
Point(5) = {20, 14, 0, 2}; Point(6) = {0, 14, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1}; Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Physical Surface("ground") = {1, 2};
Physical Curve("base") = {1}; Physical Curve("left") = {4}; Physical Curve("all of it") = {4, 7};
)");
  const auto words = [&](const std::string& side) {
    const auto file = folder.write("case.toml", R"([case]
title = "side"
method = "fem"
[mesh]
file = "layers.geo"
dimension = 2
[[materials]]
name = "ground"
regions = ["ground"]
density = 2000.0
youngs_modulus = 1e8
poisson_ratio = 0.3
[[boundaries]]
group = ")" + side + R"("
kind = "free_field"
[[boundaries]]
group = "base"
kind = "fixed"
[time]
end = 1.0
step = 0.01
history_interval = 0.1
)");
    return words_of<UserError>([&] { registry::check_case(registry::read_case(file)); });
  };
  const std::string lower = words("left");
  EXPECT_NE(lower.find("the side at x = 0 m ends at an elevation of 8 m, and the mesh goes on above it"), std::string::npos)
      << lower;
  EXPECT_EQ(words("all of it"), "");
}

TEST(free_field_run, refuses_waves_that_cannot_come_in) {
  const std::string flat = refused(inclined({"incident_wave.angle=40"}));
  EXPECT_NE(flat.find("the critical angle is 32.3 deg"), std::string::npos) << flat;
  const std::string soft =
      refused(inclined({R"(materials.2={name="soil", regions=["soil"], density=1850.0, youngs_modulus=192e6, poisson_ratio=0.3, )"
                        R"(damping_ratio=0.05, backbone="hyperbolic", reference_strain=1e-3})"}));
  EXPECT_NE(soft.find("a wave at an angle runs through elastic layers only"), std::string::npos) << soft;
  const std::string held = refused(inclined({R"(boundaries.2={group="base", kind="roller", axes=["y"]})"}));
  EXPECT_NE(held.find("and the wave moves the ground there"), std::string::npos) << held;
  const std::string steep = refused(inclined({"boundaries.1.kind=viscous"}));
  EXPECT_NE(steep.find("reaches an elevation of"), std::string::npos) << steep;
}

TEST(free_field_run, refuses_members_that_reach_the_side_beside_a_wave) {
  const std::string bar = R"(kind="bar", youngs_modulus=2e11, area=0.01}])";
  const std::string reaching = R"(members=[{name="tie", from=[-30, 22, 0], to=[-20, 22, 0], )" + bar;
  EXPECT_NE(refused(inclined({reaching})).find("the member \"tie\" reaches the side at x = -30 m"), std::string::npos);
  const std::string within = R"(members=[{name="tie", from=[-20, 22, 0], to=[-10, 22, 0], )" + bar;
  EXPECT_NE(registry::check_case(slope(inclined({within}))).find("tie"), std::string::npos);
  EXPECT_NE(registry::check_case(slope({reaching})).find("tie"), std::string::npos)
      << "columns that move as one let it move with them";
}

TEST(free_field_run, tells_how_the_wave_travels) {
  const std::string told = registry::check_case(slope(inclined()));
  EXPECT_NE(told.find("valley side at x = -30 m: the wave in its layers from 0 to 22 m"), std::string::npos) << told;
  EXPECT_NE(told.find("travels along the base at 1931.85 m/s"), std::string::npos) << told;  // 500 m/s over sin 15 deg
}

TEST(free_field_run, warns_of_steps_too_long_for_the_record) {
  EXPECT_EQ(registry::check_case(slope()).find("too few to follow it"), std::string::npos);
  const std::string warned = registry::check_case(slope({"time.step=0.2", "time.history_interval=0.2"}));
  EXPECT_NE(warned.find("steps to a period, too few to follow it"), std::string::npos) << warned;
}

TEST(free_field_run, tells_of_its_columns) {
  const std::string told = registry::check_case(slope());
  EXPECT_NE(told.find("valley side at x = -30 m: a column of"), std::string::npos) << told;
  EXPECT_NE(told.find("hill side at x = 66 m: a column of"), std::string::npos);
}

}  // namespace
}  // namespace sazare::runs
