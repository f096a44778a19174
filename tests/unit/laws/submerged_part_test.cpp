/// The parts of triangles and tetrahedra below a plane.

#include "sazare/laws/water/submerged_part.hpp"

#include <gtest/gtest.h>

#include <random>

namespace sazare::laws {
namespace {

template <std::size_t N>
CutSimplex<N> cut_by(const std::array<Vector3, N>& corners, const Vector3& up, Real level) {
  CutSimplex<N> cut{corners, {}};
  for (std::size_t n = 0; n < N; ++n) cut.depth[n] = level - up.dot(corners[n]);
  return cut;
}

template <std::size_t N>
CutSimplex<N> random_cut(std::mt19937& random) {
  std::uniform_real_distribution<Real> place(-1, 1);
  const auto vector = [&] { return Vector3(place(random), place(random), place(random)); };
  std::array<Vector3, N> corners;
  for (Vector3& corner : corners) corner = vector();
  return cut_by(corners, vector().normalized(), 0.5 * place(random));
}

/// Share and moment by a fine lattice of small simplices' centres.
template <std::size_t N>
SubmergedPart counted(const CutSimplex<N>& cut, int division) {
  SubmergedPart sum;
  int all = 0;
  const auto count = [&](std::array<Real, N> weight) {
    Real depth = 0;
    Vector3 place = Vector3::Zero();
    for (std::size_t n = 0; n < N; ++n) {
      depth += weight[n] * cut.depth[n];
      place += weight[n] * cut.corner[n];
    }
    ++all;
    if (!(depth > 0)) return;
    sum.share += 1;
    sum.moment += place;
  };
  for (int i = 0; i < division; ++i)
    for (int j = 0; i + j < division; ++j)
      for (int k = 0; i + j + k < division && (N == 4 || k == 0); ++k) {
        const Real n = division - 1 + 4 * 0.25, a = (i + 0.25) / n, b = (j + 0.25) / n, c = (k + 0.25) / n;
        if constexpr (N == 4)
          count({a, b, c, 1 - a - b - c});
        else
          count({(i + 1.0 / 3) / division, (j + 1.0 / 3) / division, 1 - (i + j + 2.0 / 3) / division});
      }
  sum.share /= all;
  sum.moment /= all;
  return sum;
}

template <std::size_t N>
void expect_as_counted(int division, Real tolerance) {
  std::mt19937 random(7);
  int partly = 0;
  for (int n = 0; n < 40; ++n) {
    const CutSimplex<N> cut = random_cut<N>(random);
    const SubmergedPart part = submerged_part(cut), found = counted(cut, division);
    EXPECT_NEAR(part.share, found.share, tolerance);
    EXPECT_LT((part.moment - found.moment).norm(), tolerance);
    if (part.share > 0.05 && part.share < 0.95) ++partly;
  }
  EXPECT_GT(partly, 15);
}

TEST(submerged_part, of_tetrahedra_is_as_counted) { expect_as_counted<4>(100, 0.02); }
TEST(submerged_part, of_triangles_is_as_counted) { expect_as_counted<3>(400, 0.01); }

template <std::size_t N>
void expect_both_sides_to_make_the_whole() {
  std::mt19937 random(3);
  for (int n = 0; n < 1000; ++n) {
    CutSimplex<N> cut = random_cut<N>(random);
    const SubmergedPart below = submerged_part(cut);
    for (Real& depth : cut.depth) depth = -depth;
    const SubmergedPart above = submerged_part(cut);
    EXPECT_NEAR(below.share + above.share, 1, 1e-13);
    EXPECT_LT((below.moment + above.moment - cut.centroid()).norm(), 1e-13);
  }
}

TEST(submerged_part, and_what_is_above_make_the_whole) {
  expect_both_sides_to_make_the_whole<3>();
  expect_both_sides_to_make_the_whole<4>();
}

TEST(submerged_part, of_a_corner_is_the_cube_of_its_height) {
  const std::array<Vector3, 4> corners{Vector3(0, 0, 0), Vector3(1, 0, 1), Vector3(0, 1, 1), Vector3(-1, -1, 1)};
  const auto part = [&](Real level) { return submerged_part(cut_by(corners, Vector3::UnitZ(), level)); };
  EXPECT_EQ(part(0).share, 0);
  EXPECT_EQ(part(1.5).share, 1);
  EXPECT_NEAR(part(0.3).share, 0.027, 1e-15);
  EXPECT_NEAR(part(0.3).moment.z(), 0.027 * 0.75 * 0.3, 1e-15);
  EXPECT_NEAR(part(1).share, 1, 1e-15);
}

}  // namespace
}  // namespace sazare::laws
