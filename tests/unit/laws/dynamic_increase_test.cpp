#include "sazare/laws/dynamic_increase.hpp"

#include <gtest/gtest.h>

namespace sazare::laws {
namespace {

/// A rate law with all that it may take; each takes its own.
DynamicIncrease with(RateLawName law, Real compressive_strength, Real scale, Real exponent, Real slope) {
  DynamicIncrease made{law, {}};
  for (std::size_t n = 0; n < made.parameters.size(); ++n) {
    const std::string_view name = parameters_of_laws<RateLaws>[n].name;
    if (name == "static_compressive_strength") made.parameters[n] = compressive_strength;
    if (name == "rate_scale") made.parameters[n] = scale;
    if (name == "rate_exponent") made.parameters[n] = exponent;
    if (name == "rate_slope") made.parameters[n] = slope;
  }
  return made;
}

constexpr std::array all_laws{RateLawName::none, RateLawName::fib_2010, RateLawName::malvar_ross, RateLawName::cowper_symonds,
                              RateLawName::logarithmic};

TEST(dynamic_increase, has_the_factors_of_the_model_code) {
  const DynamicIncrease fib{RateLawName::fib_2010, {}};
  EXPECT_DOUBLE_EQ(fib.factor(1e-6), 1);
  EXPECT_NEAR(fib.factor(1), std::exp(0.018 * std::log(1e6)), 1e-12);
  EXPECT_NEAR(fib.factor(100), 0.0062 * 464.15888, 1e-6);
  EXPECT_NEAR(fib.factor(10) / fib.factor(10 + 1e-9), 1, 1e-3) << "the printed branches meet within their digits";
  EXPECT_EQ(fib.factor(1e4), fib.factor(300)) << "nothing was measured beyond";
}

TEST(dynamic_increase, has_the_factors_of_malvar_and_ross) {
  const DynamicIncrease concrete = with(RateLawName::malvar_ross, 30e6, 0, 0, 0);  // d = 1/25
  EXPECT_NEAR(concrete.factor(1), std::pow(10, 0.24), 1e-12);
  EXPECT_NEAR(concrete.factor(100), std::pow(10, 6 * 0.04 - 2) * std::pow(10, 8.0 / 3), 1e-9);
  EXPECT_NEAR(concrete.factor(1 + 1e-9), concrete.factor(1), 1e-6);
  EXPECT_GT(concrete.factor(0.1), with(RateLawName::malvar_ross, 60e6, 0, 0, 0).factor(0.1)) << "stronger concrete gains less";
}

TEST(dynamic_increase, has_the_factors_of_a_power_and_of_a_logarithm) {
  EXPECT_NEAR(with(RateLawName::cowper_symonds, 0, 16, 4, 0).factor(16), 2, 1e-12);
  EXPECT_NEAR(with(RateLawName::cowper_symonds, 0, 16, 4, 0).factor(1), 1.5, 1e-12);
  EXPECT_NEAR(with(RateLawName::logarithmic, 0, 1e-3, 0, 0.1).factor(1), 1.3, 1e-12);
  EXPECT_EQ(with(RateLawName::logarithmic, 0, 1e-3, 0, 0.1).factor(1e-4), 1);
}

TEST(dynamic_increase, is_none_at_rest_and_never_falls_with_the_rate) {
  for (const RateLawName law : all_laws) {
    const DynamicIncrease increase = with(law, 30e6, 1, 3, 0.2);
    EXPECT_EQ(increase.factor(0), 1);
    EXPECT_EQ(increase.factor(-1), 1);
    Real before = 1;
    for (Real rate = 1e-8; rate < 1e4; rate *= 1.5) {
      const Real factor = increase.factor(rate);
      EXPECT_GE(factor, before * (1 - 1e-3)) << static_cast<int>(law) << " at " << rate;  // the model code's branches: 7e-4
      before = factor;
    }
  }
}

}  // namespace
}  // namespace sazare::laws
