/// Classes of strength against the moments of Weibull's distribution.

#include "sazare/laws/weibull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sazare::laws {
namespace {

TEST(weibull, classes_have_the_mean_one_and_the_spread_of_the_distribution) {
  for (const Real modulus : {2.0, 5.0, 10.0, 30.0}) {
    const std::vector<Real> factors = weibull_factors(modulus, 32);
    ASSERT_EQ(factors.size(), 32U);
    EXPECT_TRUE(std::ranges::is_sorted(factors));
    Real mean = 0, square = 0;
    for (const Real factor : factors) {
      mean += factor / 32;
      square += factor * factor / 32;
    }
    const Real gamma = std::tgamma(1 + 1 / modulus), spread = std::sqrt(std::tgamma(1 + 2 / modulus) / (gamma * gamma) - 1);
    EXPECT_NEAR(mean, 1, 1e-12);
    EXPECT_NEAR(std::sqrt(square - 1), spread, 0.01 * spread) << modulus;
  }
}

TEST(weibull, the_median_is_that_of_the_distribution) {
  const std::vector<Real> factors = weibull_factors(4, 1001);
  EXPECT_NEAR(factors[500], std::pow(std::log(2), 0.25) / std::tgamma(1.25), 1e-4);
}

TEST(weibull, a_large_modulus_leaves_no_scatter) {
  for (const Real factor : weibull_factors(1e6, 32)) EXPECT_NEAR(factor, 1, 1e-5);
}

}  // namespace
}  // namespace sazare::laws
