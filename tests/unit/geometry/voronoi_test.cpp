#include "sazare/geometry/plane/voronoi.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sazare::geometry {
namespace {

std::vector<Vector2> rectangle(Real width, Real height) { return {{0, 0}, {width, 0}, {width, height}, {0, height}}; }

TEST(polygon, measures_of_a_rectangle_anywhere) {
  std::vector<Vector2> corners = rectangle(3, 2);
  for (Vector2& corner : corners) corner += Vector2(100, -50);
  const PolygonMeasures found = measure(corners);
  EXPECT_NEAR(found.area, 6, 1e-12);
  EXPECT_NEAR(found.centroid.x(), 101.5, 1e-12);
  EXPECT_NEAR(found.centroid.y(), -49, 1e-12);
  EXPECT_NEAR(found.second_moment, 6 * (9 + 4) / 12.0, 1e-11);
}

TEST(polygon, knows_convex_ones) {
  EXPECT_TRUE(is_convex(rectangle(1, 1)));
  EXPECT_TRUE(is_convex(std::vector<Vector2>{{0, 0}, {1, 0}, {2, 0}, {0, 1}}));  // with a straight corner
  EXPECT_FALSE(is_convex(std::vector<Vector2>{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}}));
  std::vector<Vector2> star;
  for (int i = 0; i < 5; ++i) star.emplace_back(std::cos(4 * M_PI * i / 5), std::sin(4 * M_PI * i / 5));
  EXPECT_FALSE(is_convex(star));
}

TEST(polygon, holds_what_lies_inside_by_a_margin) {
  EXPECT_TRUE(holds(rectangle(2, 1), {0.1, 0.1}, 0.05));
  EXPECT_FALSE(holds(rectangle(2, 1), {0.1, 0.1}, 0.2));
  EXPECT_FALSE(holds(rectangle(2, 1), {2.1, 0.1}));
}

TEST(voronoi, nuclei_of_a_lattice_have_square_cells) {
  std::vector<Vector2> nuclei;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) nuclei.emplace_back(column + 0.5, row + 0.5);
  const auto cells = voronoi_cells(nuclei, rectangle(4, 3));
  for (std::size_t i = 0; i < nuclei.size(); ++i) {
    ASSERT_EQ(cells[i].corners.size(), 4U) << i;
    EXPECT_NEAR(measure(cells[i].corners).area, 1, 1e-12);
    EXPECT_NEAR((measure(cells[i].corners).centroid - nuclei[i]).norm(), 0, 1e-12);
  }
  EXPECT_EQ(cells[5].beyond.size(), 4U);
  for (const Index beside : {1, 4, 6, 9}) EXPECT_NE(std::ranges::find(cells[5].beyond, beside), cells[5].beyond.end());
}

class packing_of_a_triangle : public testing::Test {
protected:
  std::vector<Vector2> outline = {{0, 0}, {5, 1}, {1, 6}};
  std::vector<Vector2> nuclei = scatter_nuclei(outline, 0.2, 7);
  std::vector<VoronoiCell> cells = voronoi_cells(nuclei, outline);
};

TEST_F(packing_of_a_triangle, cells_fill_the_outline) {
  EXPECT_NEAR(static_cast<Real>(nuclei.size()), measure(outline).area / 0.04, 0.51);
  Real area = 0;
  Vector2 first = Vector2::Zero();
  for (const VoronoiCell& cell : cells) {
    const PolygonMeasures found = measure(cell.corners);
    EXPECT_TRUE(is_convex(cell.corners));
    area += found.area;
    first += found.area * found.centroid;
  }
  EXPECT_NEAR(area, measure(outline).area, 1e-10);
  EXPECT_NEAR((first / area - measure(outline).centroid).norm(), 0, 1e-10);
}

TEST_F(packing_of_a_triangle, no_other_nucleus_is_nearer_to_the_middle_of_a_side) {
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t side = 0; side < cells[i].corners.size(); ++side) {
      const Vector2 end = cells[i].corners[(side + 1) % cells[i].corners.size()], middle = 0.5 * (cells[i].corners[side] + end);
      Real nearest = std::numeric_limits<Real>::infinity();
      for (const Vector2& nucleus : nuclei) nearest = std::min(nearest, (nucleus - middle).norm());
      EXPECT_NEAR((nuclei[i] - middle).norm(), nearest, 1e-12);
      const Index beyond = cells[i].beyond[side];
      if (beyond != VoronoiCell::outside) {
        EXPECT_NEAR((nuclei[static_cast<std::size_t>(beyond)] - middle).norm(), nearest, 1e-12);
      }
    }
}

TEST_F(packing_of_a_triangle, nuclei_are_the_same_for_the_same_seed_and_stand_apart) {
  const auto again = scatter_nuclei(outline, 0.2, 7), other = scatter_nuclei(outline, 0.2, 8);
  EXPECT_EQ(nuclei, again);
  EXPECT_NE(nuclei, other);
  for (std::size_t i = 0; i < nuclei.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((nuclei[i] - nuclei[j]).norm(), 0.5 * 0.2);
}

/// The facets' directions, weighed by length times distance: no direction is preferred if the means of cos and sin of twice and
/// four times the angle vanish.
TEST(voronoi, cells_fill_a_strip_of_any_length) {
  const std::vector<Vector2> nuclei{{0.2, 0.3}, {0.7, 0.2}, {0.5, 0.8}};
  for (const bool upright : {true, false}) {
    constexpr Real length = 2147483648;
    std::vector<Vector2> turned = nuclei;
    if (!upright)
      for (Vector2& nucleus : turned) std::swap(nucleus.x(), nucleus.y());
    Real area = 0;
    for (const VoronoiCell& cell : voronoi_cells(turned, upright ? rectangle(1, length) : rectangle(length, 1)))
      area += measure(cell.corners).area;
    EXPECT_NEAR(area, length, 1e-6 * length);
  }
}

TEST(voronoi, scattered_nuclei_prefer_no_direction) {
  const auto outline = rectangle(60, 60);
  const auto nuclei = scatter_nuclei(outline, 1, 1);
  const auto cells = voronoi_cells(nuclei, outline);
  std::array<Real, 4> mean{};
  Real total = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t side = 0; side < cells[i].beyond.size(); ++side) {
      if (cells[i].beyond[side] == VoronoiCell::outside) continue;
      const Vector2 way = nuclei[static_cast<std::size_t>(cells[i].beyond[side])] - nuclei[i];
      const Real weight = (cells[i].corners[(side + 1) % cells[i].corners.size()] - cells[i].corners[side]).norm() * way.norm();
      const Real angle = std::atan2(way.y(), way.x());
      for (const std::size_t k : {0, 1}) {
        mean[2 * k] += weight * std::cos(2 * (1.0 + static_cast<Real>(k)) * angle);
        mean[2 * k + 1] += weight * std::sin(2 * (1.0 + static_cast<Real>(k)) * angle);
      }
      total += weight;
    }
  for (const Real part : mean) EXPECT_LT(std::abs(part / total), 0.03);
}

}  // namespace
}  // namespace sazare::geometry
