#include "sazare/geometry/closed_surface.hpp"

#include <gtest/gtest.h>

#include "cube.hpp"

namespace sazare::geometry {
namespace {

TEST(closed_surface, counts_edges_by_how_triangles_share_them) {
  std::vector<Triangle> surface = cube(1);
  EXPECT_TRUE(edges_of(surface).are_closed());
  EXPECT_EQ(edges_of(surface).turned, 0);
  EXPECT_EQ(edges_of(std::span(surface).first(11)).open, 3);
  std::swap(surface[3][0], surface[3][1]);
  EXPECT_TRUE(edges_of(surface).are_closed());
  EXPECT_EQ(edges_of(surface).turned, 3);
  surface = cube(1);
  surface.push_back(surface.front());
  EXPECT_EQ(edges_of(surface).crowded, 3);
  EXPECT_FALSE(edges_of(surface).are_closed());
}

/// A box of sides 2, 4 and 6, its corner at (1, 2, 3); either side may be out.
TEST(closed_surface, a_box_has_its_mass_properties_exactly) {
  std::vector<Triangle> surface = cube(1);
  for (Triangle& triangle : surface)
    for (Vector3& corner : triangle) corner = Vector3(1, 2, 3) + Vector3(2, 4, 6).cwiseProduct(corner);
  for (int side = 0; side < 2; ++side) {
    const UnionProperties of = properties_of_solid(surface);
    EXPECT_NEAR(of.volume, 48, 1e-12);
    EXPECT_LT((of.centre - Vector3(2, 4, 6)).norm(), 1e-12);
    const Vector3 inertia = 4 * Vector3(16 + 36, 4 + 36, 4 + 16);
    EXPECT_LT((of.inertia - Matrix3(inertia.asDiagonal())).norm(), 1e-10);
    for (Triangle& triangle : surface) std::swap(triangle[0], triangle[1]);
  }
}

}  // namespace
}  // namespace sazare::geometry
