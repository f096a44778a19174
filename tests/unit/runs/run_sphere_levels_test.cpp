#include <gtest/gtest.h>

#include "sazare/registry/registry.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "tests/unit/runs/sphere_cases.hpp"

namespace sazare::runs {
namespace {

using namespace sphere_cases;
using test::read_manifest, test::TemporaryFolder, test::words_of;

SphereSteps steps_of(const std::string& rest, const std::vector<std::string>& settings = {}) {
  const TemporaryFolder folder;
  return build_spheres(case_of(folder, rest, settings)).steps;
}

TEST(run_sphere_levels, are_taken_where_few_need_the_smallest_step) {
  const SphereSteps leveled = steps_of(mixed), uniform = steps_of(mixed, {"time.levels=\"uniform\""});
  ASSERT_EQ(leveled.level.size(), 109U);
  EXPECT_EQ(leveled.count, (std::vector<std::int64_t>{101, 0, 0, 8}));
  EXPECT_EQ(leveled.limit, uniform.limit);
  EXPECT_LE(leveled.smallest(), 0.2 * leveled.limit);
  EXPECT_GT(leveled.smallest(), 0.15 * leveled.limit);
  EXPECT_NEAR(0.01 / leveled.step, std::round(0.01 / leveled.step), 1e-9);  // a history interval is whole base steps
  EXPECT_LT(leveled.share_of_uniform, 0.4);
  EXPECT_TRUE(uniform.level.empty());
  EXPECT_LE(uniform.step, 0.2 * uniform.limit);
}

TEST(run_sphere_levels, are_not_taken_unasked_where_they_save_little_or_a_step_is_given) {
  EXPECT_TRUE(steps_of(mixed, {"spheres.1.count=400", "spheres.0.count=20"}).level.empty());
  EXPECT_FALSE(steps_of(mixed, {"spheres.1.count=400", "spheres.0.count=20", "time.levels=\"per_sphere\""}).level.empty());
  EXPECT_TRUE(steps_of(mixed, {"time.step=1e-6"}).level.empty());
  EXPECT_TRUE(steps_of(mixed, {"spheres.1.radius=0.006", "time.levels=\"per_sphere\""}).level.empty());  // all are alike
}

TEST(run_sphere_levels, of_linear_springs_go_by_mass) {
  const std::vector<std::string> linear = {"contact.model=\"linear\"", "contact.contact_stiffness=1e5",
                                           "contact.contact_shear_stiffness=8e4"};
  const SphereSteps steps = steps_of(mixed, linear);
  ASSERT_FALSE(steps.level.empty());
  EXPECT_GE(steps.count.size(), 5U);  // the steps differ by sqrt(8^3), 22.6
  const Real lightest = 2500 * 4.18879020478639 * std::pow(0.00075, 3);
  EXPECT_NEAR(steps.limit, 2 * std::sqrt(lightest / (40 * 8e4)), 1e-12);  // turning among twelve
}

TEST(run_sphere_levels, give_what_one_step_for_all_gives_for_less) {
  const TemporaryFolder folder;
  const std::vector<std::string> settings = {"time.end=0.1", "time.stability_fraction=0.15", "time.history_interval=0.005",
                                             "time.snapshot_interval=0.1"};
  const auto with = [&](const std::string& levels) {
    auto all = settings;
    all.push_back("time.levels=\"" + levels + "\"");
    carry_out(case_of(folder, mixed, all), folder / levels);
    return read_manifest(folder / levels)["results"];
  };
  const nlohmann::json leveled = with("per_sphere"), uniform = with("uniform");
  EXPECT_EQ(leveled["levels"], 4);
  EXPECT_FALSE(uniform.contains("levels"));
  EXPECT_LT(leveled["particle_steps"].get<double>(), 0.7 * uniform["particle_steps"].get<double>());
  EXPECT_LT(leveled["pair_evaluations"].get<double>(), 0.7 * leveled["uniform_evaluations"].get<double>());
  EXPECT_LT(std::abs(leveled["energy_residual"].get<double>()), 2e-2 * leveled["energy_lost"].get<double>());
  // The ball falls alike until it meets the bed. How high it comes to lie there depends on how the stones have rolled to rest, which any
  // change of the step changes: with one step for all it ends at 23 mm at 0.15 of the limit and at 32 mm at 0.10.
  const auto one = rows_of(folder / "per_sphere/gauges.csv"), other = rows_of(folder / "uniform/gauges.csv");
  const std::size_t before = 10;  // rows of 5 ms: the bed is met after 0.05 s
  EXPECT_NEAR(one[before].at("ball.position_z"), other[before].at("ball.position_z"), 1e-6);
  constexpr Real stone = 0.012;
  EXPECT_NEAR(one.back().at("ball.position_z"), other.back().at("ball.position_z"), stone);
}

/// Tetrapods and a few chips of a quarter of their size that fall together, rigid or bonded.
std::string with_chips(const std::string& bodies) {
  return bodies + R"([[shapes]]
name = "chip"
height = 0.005
leg_spheres = 2
)" + (bodies.find("[[bonds]]") == std::string::npos ? "" : "bonds = \"concrete\"\n") +
         R"([[spheres]]
name = "chips"
material = "glass"
source = "random"
shape = "chip"
random_rotation = true
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.15]
count = 2
velocity = [0.0, 0.0, -1.0]
)";
}

TEST(run_sphere_levels, are_those_of_whole_clumps) {
  const TemporaryFolder folder;
  const SpheresModel model = build_spheres(case_of(folder, with_chips(tetrapods), {"time.levels=\"per_sphere\""}));
  ASSERT_EQ(model.steps.level.size(), model.stepper->spheres().size());
  for (std::size_t c = 0; c < model.stepper->clumps().clumps.size(); ++c) {
    const auto members = model.stepper->clumps().members_of(c);
    for (const auto& member : members)
      EXPECT_EQ(model.steps.level[static_cast<std::size_t>(member.sphere)],
                model.steps.level[static_cast<std::size_t>(members.front().sphere)]);
  }
  EXPECT_EQ(model.steps.level, model.stepper->levels().by_number());
}

TEST(run_sphere_levels, carry_clumps_and_bonded_bodies_as_one_step_for_all_does) {
  for (const std::string bodies : {tetrapods, brittle}) {
    const TemporaryFolder folder;
    const auto with = [&](const std::string& levels) {
      carry_out(case_of(folder, with_chips(bodies), {"time.end=0.1", "time.levels=\"" + levels + "\""}), folder / levels);
      return read_manifest(folder / levels)["results"];
    };
    const nlohmann::json leveled = with("per_sphere"), uniform = with("uniform");
    EXPECT_GE(leveled["levels"].get<int>(), 3);
    EXPECT_LT(leveled["particle_steps"].get<double>(), 0.8 * uniform["particle_steps"].get<double>());
    EXPECT_GT(leveled["energy_lost"].get<double>(), 0);
    EXPECT_LT(std::abs(leveled["energy_residual"].get<double>()), 2e-2 * leveled["energy_work"].get<double>());
    EXPECT_NEAR(leveled["energy_lost"].get<double>(), uniform["energy_lost"].get<double>(),
                0.1 * uniform["energy_lost"].get<double>());
    const auto one = rows_of(folder / "per_sphere/gauges.csv"), other = rows_of(folder / "uniform/gauges.csv");
    // Impacts one by one differ; where the bodies as a whole are does not, but for a tenth of their height.
    EXPECT_NEAR(one.back().at("armour.position_z"), other.back().at("armour.position_z"), 2e-3);
    EXPECT_LT(other.back().at("armour.position_z"), 0.5 * other.front().at("armour.position_z"));
  }
}

TEST(run_sphere_levels, are_told_by_check) {
  const TemporaryFolder folder;
  const std::string text = registry::check_case(case_of(folder, mixed));
  EXPECT_NE(text.find("levels      0: 101 spheres, "), std::string::npos) << text;
  EXPECT_NE(text.find("            3: 8 spheres, "), std::string::npos) << text;
  EXPECT_NE(text.find("of those that a uniform step needs"), std::string::npos) << text;
}

TEST(run_sphere_levels, stop_where_spheres_may_have_met_unseen) {
  const char* burst = R"([[spheres]]
name = "stone"
material = "glass"
centre = [0.04, 0.04, 0.01]
radius = 0.008
[[spheres]]
name = "one"
material = "glass"
centre = [0.0493, 0.04, 0.01]
radius = 0.001
[[spheres]]
name = "other"
material = "glass"
centre = [0.0503, 0.04, 0.01]
radius = 0.001
[[spheres]]
name = "stones"
material = "glass"
source = "lattice"
radius = 0.008
lower = [0.0, 0.0, 0.03]
upper = [0.08, 0.08, 0.08]
)";
  const TemporaryFolder folder;
  const auto file = case_of(folder, burst, {"contact.overlap_limit=1.0", "contact.margin=0.005", "time.levels=\"per_sphere\""});
  const std::string words = words_of<PhysicsError>([&] { carry_out(file, folder / "run"); });
  EXPECT_NE(words.find("two spheres came so fast before t = "), std::string::npos) << words;
  EXPECT_NE(words.find("set contact.margin larger, or time.levels = \"uniform\""), std::string::npos) << words;
}

TEST(run_sphere_levels, are_not_for_coupled_spheres) {
  const TemporaryFolder folder;
  const auto asked = case_of(folder, mixed, {"time.levels=\"per_sphere\""});
  const std::string words = words_of<UserError>([&] { build_spheres(asked, 1e-3); });
  EXPECT_NE(words.find("spheres that are coupled take one step for all"), std::string::npos) << words;
  EXPECT_TRUE(build_spheres(case_of(folder, mixed), 1e-3).steps.level.empty());
}

}  // namespace
}  // namespace sazare::runs
