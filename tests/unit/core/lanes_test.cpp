#include "sazare/core/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/twin_lanes.hpp"
#include "sazare/core/vector_of.hpp"

namespace sazare {
namespace {

constexpr Real round_off = std::numeric_limits<Real>::epsilon();

/// Numbers over many orders of magnitude, each of another mantissa.
Real number(int n) { return std::ldexp(1 + std::fmod(0.618033988749895 * n, 1), n % 301 - 150); }

TEST(lanes, roots_and_inverse_ones_are_exact_to_round_off) {
  for (int n = 0; n < 30000; n += lane_count) {
    Lanes a{};
    for (int lane = 0; lane < lane_count; ++lane) a[lane] = number(n + lane);
    const Lanes roots = inverse_square_root(a);
    for (int lane = 0; lane < lane_count; ++lane) EXPECT_NEAR(roots[lane] * std::sqrt(a[lane]), 1, 2 * round_off) << a[lane];
  }
}

TEST(lanes, root_of_a_quotient_is_exact_to_round_off) {
  for (int n = 0; n < 30000; n += lane_count) {
    Lanes a{}, b{};
    for (int lane = 0; lane < lane_count; ++lane) {
      a[lane] = number(n + lane);
      b[lane] = number(7 * (n + lane) + 3);
    }
    const Lanes roots = root_of_quotient(a, b);
    for (int lane = 0; lane < lane_count; ++lane)
      EXPECT_NEAR(roots[lane] / std::sqrt(a[lane] / b[lane]), 1, 4 * round_off) << a[lane] << " over " << b[lane];
  }
}

TEST(lanes, numbers_of_single_precision_come_back_from_their_pairs) {
  Lanes first{}, second{};
  for (int lane = 0; lane < lane_count; ++lane) {
    first[lane] = static_cast<float>(0.1 * lane - 0.3);
    second[lane] = static_cast<float>(-7.7e5 * lane);
  }
  const auto back = unpack(pack(first, second));
  for (int lane = 0; lane < lane_count; ++lane) {
    EXPECT_EQ(back[0][lane], first[lane]);
    EXPECT_EQ(back[1][lane], second[lane]);
  }
}

/// A law must give the same bits wherever it runs.
TEST(vector_of, products_of_numbers_and_of_lanes_are_the_same_bit_for_bit) {
  const auto one = [](int n) { return Vector3{number(n % 7 + 140), -number(n % 5 + 149), number(n % 11 + 145)}; };
  VectorOf<TwinLanes> a, b;
  for (int lane = 0; lane < TwinLanes::count; ++lane)
    for (const auto& [to, from] : {std::pair(&a, one(lane)), std::pair(&b, one(3 * lane + 1))})
      for (int axis = 0; axis < 3; ++axis) (*to)[axis].set(lane, from[axis]);
  const TwinLanes product = dot(a, b);
  const auto across = cross(a, b), sum = add_product(product, a, b), rest = subtract_product(product, a, b);
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    const auto c = one(lane), d = one(3 * lane + 1);
    EXPECT_EQ(product[lane], dot(c, d));
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(across[axis][lane], cross(c, d)[axis]);
    EXPECT_EQ(sum[1][lane], add_product(dot(c, d), c, d)[1]);
    EXPECT_EQ(rest[2][lane], subtract_product(dot(c, d), c, d)[2]);
    EXPECT_NEAR(dot(c, cross(c, d)), 0, 8 * round_off * dot(c, c) * std::sqrt(dot(d, d)));
  }
}

TEST(twin_lanes, compute_what_numbers_do) {
  TwinLanes a, b;
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    a.set(lane, number(lane));
    b.set(lane, 0.3 * lane - 1);
  }
  const TwinLanes sum = a + b, difference = 2 - b, product = a * b, quotient = b / a, larger = maximum(a, b),
                  smaller = minimum(a, b), chosen = select(a > b, b, -1);
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    EXPECT_EQ(sum[lane], a[lane] + b[lane]);
    EXPECT_EQ(difference[lane], 2 - b[lane]);
    EXPECT_EQ(product[lane], a[lane] * b[lane]);
    EXPECT_EQ(quotient[lane], b[lane] / a[lane]);
    EXPECT_EQ(larger[lane], std::max(a[lane], b[lane]));
    EXPECT_EQ(smaller[lane], std::min(a[lane], b[lane]));
    EXPECT_EQ(chosen[lane], a[lane] > b[lane] ? b[lane] : -1);
  }
}

TEST(lanes, are_compared_together) {
  for (int lane = 0; lane < lane_count; ++lane) {
    Lanes a = broadcast(1);
    EXPECT_FALSE(any_above(a, broadcast(1)));
    EXPECT_FALSE(all_above(a, broadcast(1)));
    EXPECT_TRUE(all_above(a, broadcast(0.5)));
    a[lane] = 2;
    EXPECT_TRUE(any_above(a, broadcast(1)));
    EXPECT_FALSE(all_above(a, broadcast(1)));
    a[lane] = std::numeric_limits<Real>::quiet_NaN();  // is above nothing
    EXPECT_FALSE(any_above(a, broadcast(1)));
    EXPECT_FALSE(all_above(a, broadcast(0.5)));
  }
}

TEST(twin_lanes, one_lane_is_enough_for_any_above) {
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    TwinLanes a;
    EXPECT_FALSE(any_above(a, 0));
    a.set(lane, 1);
    EXPECT_TRUE(any_above(a, 0));
  }
}

TEST(twin_lanes, one_lane_is_enough_for_any) {
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    TwinLanes a;
    EXPECT_FALSE(any(a > 0));
    a.set(lane, 1);
    EXPECT_TRUE(any(a > 0));
    EXPECT_TRUE((a > 0)[lane]);
    EXPECT_FALSE((~(a > 0))[lane]);
  }
}

TEST(twin_lanes, roots_are_exact_to_round_off_and_that_of_nothing_is_nothing) {
  for (int n = 0; n < 3000; n += TwinLanes::count) {
    TwinLanes a;
    for (int lane = 1; lane < TwinLanes::count; ++lane) a.set(lane, number(n + lane));
    const TwinLanes roots = square_root(a);
    EXPECT_EQ(roots[0], 0);
    for (int lane = 1; lane < TwinLanes::count; ++lane) EXPECT_NEAR(roots[lane] / std::sqrt(a[lane]), 1, 2 * round_off);
  }
}

}  // namespace
}  // namespace sazare
