#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

/// Members in a case of method fem.
namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_text, test::TemporaryFolder, test::words_of;

/// Ground 12 m wide and 4 m high with lines upwards at x = 4 m and 8 m.
constexpr const char* geometry = R"(
For i In {0:3}
  Point(1 + i) = {4 * i, 0, 0}; Point(11 + i) = {4 * i, 4, 0}; Line(101 + i) = {1 + i, 11 + i};
EndFor
For i In {0:2}
  Line(1 + i) = {1 + i, 2 + i}; Line(11 + i) = {11 + i, 12 + i};
  Curve Loop(1 + i) = {1 + i, 102 + i, -(11 + i), -(101 + i)}; Plane Surface(1 + i) = {1 + i};
EndFor
Transfinite Curve{1:3, 11:13} = 3; Transfinite Curve{101:104} = 5; Transfinite Surface{:}; Recombine Surface{:};
Physical Surface("ground") = {1:3};
Physical Curve("base") = {1:3};
Physical Curve("piles") = {102, 103};
)";

constexpr const char* body = R"([case]
title = "Piles"
method = "fem"

[mesh]
file = "piles.geo"

[[materials]]
name = "mud"
regions = ["ground"]
density = 1500
youngs_modulus = 10
poisson_ratio = 0.3

[[boundaries]]
group = "base"
kind = "fixed"

[[members]]
name = "piles"
kind = "beam"
group = "piles"
youngs_modulus = 2e11
area = 2e-2
second_moment = 1e-4
density = 7850
spacing = 2

[[members]]
name = "tie"
kind = "bar"
from = [4, 4, 0]
to = [8, 4, 0]
youngs_modulus = 2e11
area = 1e-4
prestress = 1e5
spacing = 2

[time]
end = 1.0
step = 1.0
analysis = "static"
)";

class Folder {
public:
  Folder() {
    std::ofstream(folder_ / "piles.geo") << geometry;
    std::ofstream(folder_ / "case.toml") << body;
  }
  cases::CaseFile read(const std::vector<std::string>& settings = {}) const {
    return registry::read_case(folder_ / "case.toml", settings);
  }
  std::string refused(const std::vector<std::string>& settings) const {
    return words_of<UserError>([&] { registry::check_case(read(settings)); });
  }
  fs::path operator/(const std::string& name) const { return folder_ / name; }

private:
  TemporaryFolder folder_;
};

Real last_of(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::string titles, line, last, word, value;
  std::getline(lines, titles);
  while (std::getline(lines, line)) last = line;
  std::istringstream names(titles), values(last);
  while (std::getline(names, word, ',') && std::getline(values, value, ','))
    if (word == name) return std::stod(value);
  ADD_FAILURE() << "no column " << name << " in " << titles;
  return 0;
}

/// The tie draws the heads of two cantilevers together, which relieves it.
TEST(members_run, tie_with_a_prestress_bends_two_piles) {
  const Folder folder;
  registry::run_case(folder.read(), {folder / "run", Begin::fresh, true, nullptr});
  const std::string history = read_text(folder / "run/history.csv");
  const Real give = 4.0 * 4 * 4 / (3 * 2e11 * 1e-4), tie = 2e11 * 1e-4 / 4;  // of one pile, and of one tie
  const Real force = 1e5 / (1 + 2 * tie * give) / 2;                         // per metre
  EXPECT_NEAR(last_of(history, "tie.axial_force_max [N]"), force, 1e-4 * force);
  EXPECT_NEAR(last_of(history, "piles.shear_force_max [N]"), force, 1e-4 * force);
  EXPECT_NEAR(last_of(history, "piles.moment_max [N m]"), 4 * force, 1e-4 * 4 * force);
}

/// Piles that bear less than the tie would bend them by, in ground that holds their heads when both feet are hinges.
const std::vector<std::string> weak = {"members.0.yield_moment=2e4", "members.1.yield_force=2e5", "members.1.compression_force=0",
                                       "materials.0.youngs_modulus=1e5"};

TEST(members_run, piles_yield_at_their_feet_and_relieve_the_tie) {
  const Folder folder;
  registry::run_case(folder.read(weak), {folder / "run", Begin::fresh, true, nullptr});
  const std::string history = read_text(folder / "run/history.csv");
  const Real moment = 2e4 / 2;  // per metre
  EXPECT_NEAR(last_of(history, "piles.moment_max [N m]"), moment, 1e-5 * moment);
  EXPECT_NEAR(last_of(history, "piles.moment_ratio [-]"), 1, 1e-5);
  EXPECT_GT(last_of(history, "tie.axial_force_max [N]"), moment / 4);  // the ground bears some of it
  EXPECT_LT(last_of(history, "tie.axial_force_max [N]"), 4286);        // of elastic piles
  EXPECT_NEAR(last_of(history, "tie.force_ratio [-]"), last_of(history, "tie.axial_force_max [N]") / 1e5, 1e-6);
  EXPECT_EQ(last_of(history, "tie.plastic_elongation [m]"), 0);
  const auto figures = test::read_manifest(folder / "run")["results"];
  EXPECT_EQ(figures["yield_time_piles"].get<Real>(), 1);
  EXPECT_GT(figures["plastic_rotation_piles"].get<Real>(), 0);
  EXPECT_NEAR(figures["plastic_rotation_piles"].get<Real>(), last_of(history, "piles.plastic_rotation [rad]"), 1e-9);
  EXPECT_FALSE(figures.contains("yield_time_tie"));
  EXPECT_GT(figures["energy_members"].get<Real>(), 0);
}

TEST(members_run, check_prints_their_limits) {
  const std::string text = registry::check_case(Folder().read(weak));
  EXPECT_NE(text.find("yields at 20000 N m"), std::string::npos) << text;
  EXPECT_NE(text.find("yields at 200000 N in tension, goes slack in compression"), std::string::npos) << text;
}

/// Dynamic, with a hinge that turns: in two parts as in one.
TEST(members_run, goes_on_from_a_checkpoint_with_the_same_bits) {
  const Folder folder;
  std::vector<std::string> settings = weak;
  settings.insert(settings.end(), {"time.analysis=dynamic", "time.step=0.01", "time.end=0.4"});
  const auto file = folder.read(settings);
  test::run_in_parts(file, folder / "parts", test::run_whole(file, folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  const auto whole = test::read_manifest(folder / "whole"), parts = test::read_manifest(folder / "parts");
  EXPECT_GT(whole["results"]["energy_members"].get<Real>(), 0);
  EXPECT_EQ(whole["results"]["yield_time_piles"], parts["results"]["yield_time_piles"]);
}

TEST(members_run, says_what_does_not_fit_the_mesh) {
  const Folder folder;
  EXPECT_NE(folder.refused({"members.0.group=ground"}).find("the mesh has no group \"ground\""), std::string::npos);
  EXPECT_NE(folder.refused({"members.1.to=[8, 40, 0]"}).find("the nearest node is 36 m away"), std::string::npos);
  EXPECT_NE(folder.refused({"members.1.to=[4, 4, 0]"}).find("are at one node"), std::string::npos);
}

TEST(members_run, keep_their_keys_when_the_resolved_case_is_read_again) {
  const Folder folder;
  registry::run_case(folder.read(), {folder / "run", Begin::fresh, true, nullptr});
  const std::string once = read_text(folder / "run/case.toml");
  EXPECT_NE(once.find("prestress = 1"), std::string::npos);
  registry::run_case(registry::read_case(folder / "run/case.toml", {}), {folder / "again", Begin::fresh, true, nullptr});
  EXPECT_EQ(read_text(folder / "run/gauges.csv"), read_text(folder / "again/gauges.csv"));
}

}  // namespace
}  // namespace sazare::runs
