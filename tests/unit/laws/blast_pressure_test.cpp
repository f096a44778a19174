#include "sazare/laws/blast_pressure.hpp"

#include <gtest/gtest.h>

namespace sazare::laws {
namespace {

const BlastPressure hole{5.75e8, 1.33e-4, 2.75};

TEST(blast_pressure, passes_through_the_points_of_the_formula) {
  EXPECT_NEAR(blast_pressure(hole, 0), 0, 1e-6);  // cos(pi/2) leaves 1e-16 of the peak
  EXPECT_NEAR(blast_pressure(hole, 0.5 * hole.rise_time), 0.5 * hole.peak, 1e-12 * hole.peak);
  EXPECT_DOUBLE_EQ(blast_pressure(hole, hole.rise_time), hole.peak);
  EXPECT_NEAR(blast_pressure(hole, (1 + 2.75 / 3) * hole.rise_time), 0.8660254037844386 * hole.peak, 1e-12 * hole.peak);
  EXPECT_NEAR(blast_pressure(hole, 3.75 * hole.rise_time * (1 - 1e-15)), 0, 1e-5);
}

TEST(blast_pressure, is_nothing_before_and_after) {
  EXPECT_EQ(blast_pressure(hole, -1e-9), 0);
  EXPECT_EQ(blast_pressure(hole, 3.7501 * hole.rise_time), 0);
  EXPECT_EQ(blast_pressure(hole, 1), 0);
}

TEST(blast_pressure, rises_to_the_peak_and_falls) {
  const auto at = [](int i) { return blast_pressure(hole, 0.01 * i * hole.rise_time); };
  for (int i = 1; i <= 100; ++i) EXPECT_GT(at(i), at(i - 1)) << i;
  for (int i = 101; i <= 375; ++i) EXPECT_LT(at(i), at(i - 1)) << i;
}

TEST(blast_pressure, its_impulse_is_the_integral_of_the_formula) {
  // P_0 a (1/2 + 2 b / pi); the midpoint rule with 1e5 cells is exact to 1e-9.
  constexpr int cells = 100000;
  Real impulse = 0;
  for (int cell = 0; cell < cells; ++cell)
    impulse += 3.75 * hole.rise_time / cells * blast_pressure(hole, (cell + 0.5) * 3.75 * hole.rise_time / cells);
  const Real exact = hole.peak * hole.rise_time * (0.5 + 2 * hole.decay_ratio / std::numbers::pi);
  EXPECT_NEAR(impulse, exact, 1e-8 * exact);
}

}  // namespace
}  // namespace sazare::laws
