/// Words at the end of a run that a user sees who makes no report.

#include "sazare/runs/summary.hpp"

#include <gtest/gtest.h>

namespace sazare::runs {
namespace {

observe::Manifest with_balance(Real work, Real residual) {
  observe::Manifest manifest;
  manifest.results = {{"energy_work", work}, {"energy_residual", residual}};
  return manifest;
}

TEST(summary, warns_of_energy_that_is_not_accounted_for) {
  EXPECT_NE(balance_warning(with_balance(-200, 10)).find("warning: the energy balance misses 5 % of the work"),
            std::string::npos);
  EXPECT_EQ(balance_warning(with_balance(200, -1)), "");
  EXPECT_EQ(balance_warning(with_balance(0, 0)), "");
  observe::Manifest jumped = with_balance(0, -240);
  jumped.results.emplace_back("energy_kinetic", 200.0);
  EXPECT_NE(balance_warning(jumped).find("an energy of 240 J, though no work was done"), std::string::npos);
  jumped.results[1].second = 1e-9;
  EXPECT_EQ(balance_warning(jumped), "");
  EXPECT_EQ(balance_warning({}), "");
}

/// A body at rest works by round-off alone.
TEST(summary, does_not_weigh_the_energies_of_what_does_not_move) {
  observe::Manifest manifest = with_balance(-1.8e-9, 1e-10);
  EXPECT_NE(balance_warning(manifest), "");
  manifest.results.emplace_back("peak_displacement", 1e-15);
  EXPECT_EQ(balance_warning(manifest), "");
  manifest.results.back().second = 1e-9;
  EXPECT_NE(balance_warning(manifest), "");
}

/// Nor what moves as a whole, without a strain.
TEST(summary, does_not_weigh_what_round_off_works) {
  observe::Manifest manifest = with_balance(-1.8e-9, 1.8e-9);
  manifest.results.emplace_back("peak_displacement", 0.1);
  EXPECT_NE(balance_warning(manifest), "");
  EXPECT_NE(balance_text(manifest).find("of the work"), std::string::npos);
  manifest.results.emplace_back("energy_round_off", 1e-8);
  EXPECT_EQ(balance_warning(manifest), "");
  EXPECT_EQ(balance_text(manifest).find("of the work"), std::string::npos);
  manifest.results[1].second = 1e-6;
  EXPECT_NE(balance_warning(manifest), "") << "a residual that round-off does not explain";
  manifest.results[0].second = 1e-3;
  manifest.results[1].second = 1e-4;
  EXPECT_NE(balance_warning(manifest), "");
}

/// Nor what is left of the forces of a body that has settled before the run.
TEST(summary, does_not_weigh_what_is_left_of_settling) {
  observe::Manifest manifest = with_balance(0, -48e-9);
  manifest.results.emplace_back("energy_elastic", 24e-9);
  manifest.results.emplace_back("throw_max", 8e-10);
  EXPECT_NE(balance_warning(manifest), "") << "it has not settled";
  manifest.results.emplace_back("settlement", 1e-5);
  EXPECT_EQ(balance_warning(manifest), "");
  manifest.results[3].second = 1e-7;
  EXPECT_NE(balance_warning(manifest), "") << "it has moved since";
}

/// Nor those of ground that rests under its stress, whose displacements a run does not tell.
TEST(summary, does_not_weigh_the_energies_of_ground_at_rest) {
  observe::Manifest manifest = with_balance(0, 6e-13);
  manifest.results.emplace_back("energy_elastic", -6e-13);
  EXPECT_NE(balance_warning(manifest), "");
  manifest.results.emplace_back("peak_speed", 2e-8);
  EXPECT_EQ(balance_warning(manifest), "");
  manifest.results.back().second = 1e-3;
  EXPECT_NE(balance_warning(manifest), "");
}

/// A body that was stressed or in motion at the beginning gives energy without any work.
TEST(summary, measures_the_energy_that_is_missing_by_what_was_set_free_as_well) {
  observe::Manifest manifest = with_balance(10, 2);
  manifest.results.emplace_back("energy_elastic", -700.0);
  manifest.results.emplace_back("energy_kinetic", 500.0);
  EXPECT_EQ(balance_warning(manifest), "");
  EXPECT_NE(balance_text(manifest).find("2.8e-03 of the work and the energy set free"), std::string::npos);
  manifest.results[1].second = 71.0;
  EXPECT_NE(balance_warning(manifest).find("misses 10 % of the work and the energy set free"), std::string::npos);
  manifest.results[0].second = 0.0;
  EXPECT_NE(balance_warning(manifest).find("misses 10 %"), std::string::npos);
}

}  // namespace
}  // namespace sazare::runs
