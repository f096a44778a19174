#include "sazare/laws/cyclic_contraction.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace sazare::laws {
namespace {

using Cycles = CycleMemory<6>;
using Strain = Cycles::Strain;

Strain shear(Real amount) {
  Strain strain = Strain::Zero();
  strain[3] = amount;
  return strain;
}

/// The strain of a tensor in turned axes.
Strain turned(const Strain& strain, const Matrix3& axes) {
  Matrix3 tensor;
  tensor << strain[0], strain[3] / 2, strain[5] / 2, strain[3] / 2, strain[1], strain[4] / 2, strain[5] / 2, strain[4] / 2, strain[2];
  const Matrix3 other = axes * tensor * axes.transpose();
  Strain result;
  result << other(0, 0), other(1, 1), other(2, 2), 2 * other(0, 1), 2 * other(1, 2), 2 * other(2, 0);
  return result;
}

Real contraction(const std::vector<Strain>& path, const CyclicContraction& law) {
  std::vector<Real> memory(Cycles::numbers, 0);
  Real sum = 0;
  for (const Strain& strain : path) {
    Cycles cycles(memory);
    cycles.follow(strain, law);
    cycles.write(memory);
    sum += cycles.pending();
    EXPECT_DOUBLE_EQ(sum, cycles.lost());
  }
  return sum;
}

/// Simple shear to and fro in so many steps.
std::vector<Strain> cycles(Real amplitude, int count, int steps) {
  std::vector<Strain> path;
  for (int n = 0; n <= count * steps; ++n) path.push_back(shear(amplitude * std::sin(2 * std::numbers::pi * n / steps)));
  return path;
}

const CyclicContraction loose(CyclicContraction::rate_of(6), CyclicContraction::decay_of(CyclicContraction::rate_of(6)), 0);

TEST(cyclic_contraction, has_the_constants_of_its_blow_count) {
  EXPECT_NEAR(loose.rate(), 0.9265, 1e-4);  // 8.7 / 6^1.25
  EXPECT_NEAR(loose.decay(), 0.4317, 1e-4);
}

TEST(cyclic_contraction, follows_the_half_cycles_of_simple_shear) {
  const Real amplitude = 3e-3;
  Real expected = loose.half_cycle(amplitude / 2, 0);  // from the beginning to the first reversal
  for (int half = 0; half < 19; ++half) expected += loose.half_cycle(amplitude, expected);
  // The last way, from the last reversal to rest, has not turned.
  EXPECT_NEAR(contraction(cycles(amplitude, 10, 400), loose), expected, 1e-3 * expected);
}

TEST(cyclic_contraction, comes_of_reversals_alone) {
  std::vector<Strain> path;
  for (int n = 0; n < 100; ++n) path.push_back(shear(1e-4 * n));
  EXPECT_EQ(contraction(path, loose), 0);
  for (Strain& strain : path) strain << 1e-3, 1e-3, 1e-3, 0, 0, 0;
  EXPECT_EQ(contraction(path, loose), 0);
}

TEST(cyclic_contraction, is_none_below_the_threshold) {
  const CyclicContraction law(loose.rate(), loose.decay(), 1e-4);
  EXPECT_EQ(contraction(cycles(0.99e-4, 5, 40), law), 0);
  EXPECT_GT(contraction(cycles(1.01e-4, 5, 40), law), 0);
}

TEST(cyclic_contraction, does_not_depend_on_axes_and_on_the_mean_strain) {
  const Matrix3 axes = (Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized())).toRotationMatrix();
  auto path = cycles(2e-3, 4, 50);
  const Real plain = contraction(path, loose);
  for (std::size_t n = 0; n < path.size(); ++n) {
    path[n].head<3>().array() += 1e-4 * static_cast<Real>(n);
    path[n] = turned(path[n], axes);
  }
  EXPECT_NEAR(contraction(path, loose), plain, 1e-12 * plain);
}

TEST(cyclic_contraction, hardly_changes_with_ripples_on_a_cycle) {
  auto path = cycles(2e-3, 1, 400);
  const Real plain = contraction(path, loose);
  for (std::size_t n = 0; n < path.size(); ++n) path[n][3] += 2e-5 * std::sin(0.8 * static_cast<Real>(n));
  EXPECT_NEAR(contraction(path, loose), plain, 0.05 * plain);
}

TEST(cyclic_contraction, comes_of_shear_that_turns_around) {
  std::vector<Strain> path;
  for (int n = 0; n <= 400; ++n) {
    Strain strain = Strain::Zero();
    strain[3] = 2e-3 * std::cos(2 * std::numbers::pi * n / 100);
    strain[4] = 2e-3 * std::sin(2 * std::numbers::pi * n / 100);
    path.push_back(strain);
  }
  const Real straight = contraction(cycles(2e-3, 4, 100), loose);  // half a circle is as long a way as half a cycle
  EXPECT_NEAR(contraction(path, loose), straight, 0.15 * straight);
}

/// Martin, Finn and Seed (1975): four constants fitted to their tests of a sand of 45 % relative density, strains in percent. The
/// rate is that of their first cycle; what comes of it in twenty cycles is found.
TEST(cyclic_contraction, follows_the_tests_of_martin_finn_and_seed) {
  const CyclicContraction law(0.80, CyclicContraction::decay_of(0.80), 0);
  for (const Real percent : {0.1, 0.2, 0.3}) {
    Real measured = 0, ours = 0;
    for (int cycle = 0; cycle < 20; ++cycle) {
      measured += 0.80 * (percent - 0.79 * measured) + 0.45 * measured * measured / (percent + 0.73 * measured);
      for (int half = 0; half < 2; ++half) ours += law.half_cycle(percent / 100, ours);
      EXPECT_NEAR(100 * ours, measured, 0.1 * measured) << percent << ' ' << cycle;
    }
  }
}

}  // namespace
}  // namespace sazare::laws
