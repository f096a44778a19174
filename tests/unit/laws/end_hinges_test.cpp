#include <gtest/gtest.h>

#include <random>

#include "sazare/laws/members/end_hinges.hpp"

namespace sazare::laws {
namespace {

constexpr Real stiffness = 1e6, limit = 1e4;
const EndHinges both{stiffness, {limit, limit}}, first{stiffness, {limit, std::numeric_limits<Real>::infinity()}};

template <int D>
using Ends = std::array<Vector<D>, 2>;

/// Slopes across a beam along x, in the plane or in space.
template <int D>
Ends<D> slopes(Real one, Real other, Real turn = 0) {
  Ends<D> ends{Vector<D>::Zero(), Vector<D>::Zero()};
  ends[0][1] = one;
  ends[1][1] = other;
  if constexpr (D == 3) ends[1] = other * Vector3(0, std::cos(turn), std::sin(turn));
  return ends;
}

template <int D>
Ends<D> none() {
  return {Vector<D>::Zero(), Vector<D>::Zero()};
}

TEST(end_hinges, bound_the_moments_of_their_ends) {
  const auto elastic = respond<2>(both, slopes<2>(1e-3, 0), none<2>());
  EXPECT_FALSE(elastic.flows);
  EXPECT_NEAR(elastic.moment[0].y(), 4e3, 1e-9);
  EXPECT_NEAR(elastic.moment[1].y(), 2e3, 1e-9);
  // The hinge turns by what the end bears too much, and the other end feels it.
  const auto one = respond<2>(first, slopes<2>(4e-3, 0), none<2>());
  EXPECT_NEAR(one.moment[0].y(), limit, 1e-8);
  EXPECT_NEAR(one.plastic[0].y(), 4e-3 - limit / (4 * stiffness), 1e-15);
  EXPECT_NEAR(one.moment[1].y(), limit / 2, 1e-8);
  const auto two = respond<2>(both, slopes<2>(1e-2, 8e-3), none<2>());
  EXPECT_NEAR(two.moment[0].y(), limit, 1e-8);
  EXPECT_NEAR(two.moment[1].y(), limit, 1e-8);
  EXPECT_NEAR(two.plastic[0].y(), 1e-2 - limit / (6 * stiffness), 1e-15);
}

template <int D>
void check_tangent(const EndHinges& law, const Ends<D>& at, bool flows) {
  const auto here = respond<D>(law, at, none<D>());
  EXPECT_EQ(here.flows, flows);
  for (int column = 0; column < 2 * D; ++column) {
    if (column % D == 0) continue;  // along the beam
    const Real step = 1e-8;
    Ends<D> more = at, less = at;
    more[static_cast<std::size_t>(column / D)][column % D] += step;
    less[static_cast<std::size_t>(column / D)][column % D] -= step;
    const auto up = respond<D>(law, more, none<D>()), down = respond<D>(law, less, none<D>());
    for (int row = 0; row < 2 * D; ++row) {
      const auto end = static_cast<std::size_t>(row / D);
      EXPECT_NEAR((up.moment[end][row % D] - down.moment[end][row % D]) / (2 * step), here.tangent(row, column),
                  1e-6 * stiffness);
    }
  }
}

TEST(end_hinges, have_a_consistent_tangent) {
  check_tangent<2>(both, slopes<2>(1e-3, 1e-3), false);
  check_tangent<2>(both, slopes<2>(4e-3, 0), true);
  check_tangent<2>(both, slopes<2>(1e-2, 8e-3), true);
  check_tangent<2>(both, slopes<2>(1e-2, -8e-3), true);
  check_tangent<3>(both, slopes<3>(1e-3, 1e-3, 1), false);
  check_tangent<3>(both, slopes<3>(4e-3, 1e-3, 1), true);
  check_tangent<3>(both, slopes<3>(1e-2, 8e-3, 1), true);
  check_tangent<3>(first, slopes<3>(1e-2, 8e-3, 2), true);
}

TEST(end_hinges, have_moments_that_are_the_slope_of_their_energy) {
  const Ends<3> plastic{Vector3(0, 1e-3, -2e-3), Vector3(0, 3e-3, 1e-3)};
  const Ends<3> at{plastic[0] + Vector3(0, 3e-4, 2e-4), plastic[1] + Vector3(0, -1e-4, 4e-4)};
  const auto here = respond<3>(both, at, plastic);
  ASSERT_FALSE(here.flows);
  for (const std::size_t end : {0U, 1U})
    for (const int axis : {1, 2}) {
      Ends<3> more = at, less = at;
      more[end][axis] += 1e-8;
      less[end][axis] -= 1e-8;
      const Real slope = (respond<3>(both, more, plastic).energy - respond<3>(both, less, plastic).energy) / 2e-8;
      EXPECT_NEAR(slope, here.moment[end][axis], 1e-4 * limit);
    }
}

/// As bars: on any way, in any direction.
TEST(end_hinges, never_gain) {
  std::mt19937 random(3);
  std::normal_distribution<Real> step(0, 2e-3);
  for (const EndHinges& law : {both, first}) {
    Ends<3> slope = none<3>(), plastic = none<3>();
    Real energy = 0, dissipated = 0;
    for (int i = 0; i < 2000; ++i) {
      const Ends<3> before = slope;
      for (Vector3& end : slope) end += Vector3(0, step(random), step(random)) - 0.05 * end;
      const auto now = respond<3>(law, slope, plastic);
      Real work = 0;
      for (const std::size_t end : {0U, 1U}) {
        EXPECT_LE(now.moment[end].norm(), law.moment[end] * (1 + 1e-12));
        work += now.moment[end].dot(slope[end] - before[end]);
        dissipated += now.moment[end].dot(now.plastic[end] - plastic[end]);
      }
      EXPECT_GE(work - (now.energy - energy), -1e-9);
      energy = now.energy;
      plastic = now.plastic;
    }
    EXPECT_GT(dissipated, 0);
  }
}

}  // namespace
}  // namespace sazare::laws
