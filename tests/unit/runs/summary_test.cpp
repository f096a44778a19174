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
  EXPECT_EQ(balance_warning({}), "");
}

}  // namespace
}  // namespace sazare::runs
