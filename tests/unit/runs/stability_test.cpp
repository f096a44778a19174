#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/run/run.hpp"
#include "sazare/methods/blocks/run/check/stability.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

using test::block_case, test::block_model;

std::string warning_of(std::vector<std::string> settings) {
  const cases::CaseFile file = block_case(std::move(settings));
  return check_stability(file, block_model(file));
}

TEST(Stability, LimitingElementsAreThoseWithTheSmallestSteps) {
  const BlocksModel model = block_model(block_case());
  const std::vector<LimitingElement> limiting = limiting_elements(model, 10);
  ASSERT_EQ(limiting.size(), 10u);
  EXPECT_EQ(limiting[0].stable_step, *std::ranges::min_element(model.stable_step));
  EXPECT_TRUE(std::ranges::is_sorted(limiting, {}, &LimitingElement::stable_step));
}

TEST(Stability, KnowsWhetherSpringsOrDashpotsBind) {
  const BlocksModel damped = block_model(block_case({"joints.0.joint_normal_damping=2.26e8", "joints.0.joint_shear_damping=1e8"}));
  const BlocksModel undamped = block_model(block_case({"joints.0.joint_normal_damping=0", "joints.0.joint_shear_damping=0"}));
  EXPECT_TRUE(bound_by_dashpots(damped, 0));
  EXPECT_FALSE(bound_by_dashpots(undamped, 0));
}

TEST(Stability, EveryElementIsInTheHistogram) {
  const BlocksModel model = block_model(block_case());
  model.simulation->start();
  const std::vector<Index> counts = level_histogram(model);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), model.simulation->bodies().size());
  EXPECT_GT(counts.back(), 0);
}

TEST(Stability, OfUniformStepsIsEveryJointOncePerStep) {
  const BlocksModel model = block_model(block_case({"time.limiter=none", "time.base_step=1e-8"}));
  model.simulation->start();
  EXPECT_NEAR(evaluations_per_second(model), 1e8 * model.joints->count(), 1);
}

TEST(Stability, AStableStepIsNotWarnedAbout) {
  EXPECT_EQ(warning_of({}), "");
  EXPECT_EQ(warning_of({"time.limiter=none", "time.base_step=1e-8"}), "");
}

TEST(Stability, AStepAboveIsWarnedAboutWithWhatToSet) {
  const std::string words = warning_of({"time.limiter=none", "time.base_step=2e-6"});
  EXPECT_NE(words.find("step above the stability limit: base_step = 2e-6 s is too long for "), std::string::npos) << words;
  EXPECT_NE(words.find("the smallest stability limit, "), std::string::npos) << words;
  EXPECT_NE(words.find("set limiter = \"stability\", which gives every element its own step, or base_step = "), std::string::npos)
      << words;
}

TEST(Stability, TheProposedStepIsTaken) {
  const std::string words = warning_of({"time.limiter=none", "time.base_step=2e-6"});
  const std::string before = "or base_step = ";
  const std::string proposed = words.substr(words.find(before) + before.size());
  EXPECT_EQ(warning_of({"time.limiter=none", "time.base_step=" + proposed.substr(0, proposed.find_first_of(" \n"))}), "");
}

TEST(Stability, AFractionAboveIsWarnedAbout) {
  const std::string words = warning_of({"time.stability_fraction=0.8"});
  EXPECT_NE(words.find("stability_fraction = 0.8 is above 0.5"), std::string::npos) << words;
}

TEST(Stability, AStrictCaseIsRefused) {
  const std::vector<std::string> settings = {"time.limiter=travel", "time.base_step=2e-6", "time.strict=true"};
  const std::string words = test::words_of<UserError>([&] { warning_of(settings); });
  EXPECT_NE(words.find("error: step above the stability limit"), std::string::npos) << words;
}

TEST(Stability, DampingBeyondMeasureIsRefused) {
  const std::vector<std::string> settings = {"joints.0.joint_normal_damping=1e300", "time.limiter=none", "time.base_step=1e-8"};
  const std::string words = test::words_of<UserError>([&] { warning_of(settings); });
  EXPECT_NE(words.find("error: no step is stable: the stability limit of element "), std::string::npos) << words;
}

TEST(Check, SaysWhatTheCaseWillDo) {
  const std::string text = check_blocks(block_case());
  for (const char* words : {"Small block", "base ", "initial levels", "elements that limit the step", "one piece",
                            "pair evaluations per second of simulated time",
                            "steps above the stability limit are allowed with a warning", "every 60 s of wall-clock time"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

}  // namespace
}  // namespace sazare::runs
