#include "sazare/geometry/triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sazare/geometry/triangle_tree.hpp"

namespace sazare::geometry {
namespace {

const Triangle corner{Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(0, 2, 0)};

TEST(triangle, nearest_point_is_on_face_edges_and_corners) {
  EXPECT_EQ(nearest_point(corner, {0.5, 0.5, 3}), Vector3(0.5, 0.5, 0));
  EXPECT_EQ(nearest_point(corner, {1, -1, 1}), Vector3(1, 0, 0));
  EXPECT_EQ(nearest_point(corner, {-1, 1, 1}), Vector3(0, 1, 0));
  EXPECT_LT((nearest_point(corner, {2, 2, -1}) - Vector3(1, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(nearest_point(corner, {-1, -1, 0}), Vector3(0, 0, 0));
  EXPECT_EQ(nearest_point(corner, {5, -1, 0}), Vector3(2, 0, 0));
  EXPECT_EQ(nearest_point(corner, {-1, 5, 0}), Vector3(0, 2, 0));
}

TEST(triangle, is_gone_through_within_its_edges) {
  const Triangle lower = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(1, 1, 0)},
                 upper = {Vector3(0, 0, 0), Vector3(1, 1, 0), Vector3(0, 1, 0)};
  EXPECT_TRUE(leads_through(lower, {0.7, 0.2, 1}, {0.7, 0.2, -0.1}));
  EXPECT_TRUE(leads_through(lower, {0.7, 0.2, -0.1}, {0.7, 0.2, 1}));
  EXPECT_FALSE(leads_through(lower, {0.7, 0.2, 1}, {0.7, 0.2, 0.1}));
  EXPECT_FALSE(leads_through(lower, {0.2, 0.7, 1}, {0.2, 0.7, -1}));
  EXPECT_FALSE(leads_through(lower, {-3, 0.2, 1}, {0.5, 0.2, -1}));
  EXPECT_FALSE(leads_through(lower, {-1, 0.2, 0}, {2, 0.2, 0})) << "in its plane";
  for (int n = 1; n < 50; ++n) {  // no way leads between two of them
    const Vector3 on_edge(n / 50.0, n / 50.0, 0), along(0.3, -0.17, 1);
    EXPECT_TRUE(leads_through(lower, on_edge - along, on_edge + along) || leads_through(upper, on_edge - along, on_edge + along));
  }
}

TEST(triangle_tree, knows_all_that_are_near) {
  std::uint64_t state = 3;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state >> 11) / 9007199254740992.0;
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < 200; ++i) {
    const Vector3 at(random(), random(), random());
    triangles.push_back({at, at + 0.2 * Vector3(random(), random(), random()), at + 0.2 * Vector3(random(), random(), random())});
  }
  for (const Real reach : {0.02, 0.3}) {
    const TriangleTree tree(triangles, reach);
    std::size_t met = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3 place = 2 * Vector3(random(), random(), random()) - Vector3(0.5, 0.5, 0.5);
      const auto near = tree.near(place);
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        if ((nearest_point(triangles[t], place) - place).norm() > reach) continue;
        ++met;
        EXPECT_NE(std::ranges::find(near, static_cast<std::int32_t>(t)), near.end());
      }
    }
    EXPECT_GT(met, 20);
  }
}

/// One floor of two triangles that is wide against the reach, and steps of fine ones upon it: as fast and small as their number.
TEST(triangle_tree, knows_huge_triangles_among_small_ones) {
  std::vector<Triangle> triangles = {{Vector3(-1e5, -1e5, 0), Vector3(1e5, -1e5, 0), Vector3(1e5, 1e5, 0)},
                                     {Vector3(-1e5, -1e5, 0), Vector3(1e5, 1e5, 0), Vector3(-1e5, 1e5, 0)}};
  for (int i = 0; i < 20000; ++i) triangles.push_back({Vector3(i, 0, 0), Vector3(i + 1, 0, 0), Vector3(i, 1, 1)});
  const TriangleTree tree(triangles, 1e-3);
  std::size_t met = 0;
  for (int i = 0; i < 20000; ++i) met += tree.near({i + 0.25, 0.1, 0.0}).size();
  EXPECT_GE(met, 2 * 20000);
  EXPECT_LE(met, 4 * 20000);
  EXPECT_TRUE(tree.near({0, 0, 0.5}).size() <= 2);
  EXPECT_TRUE(TriangleTree({}, 1).near({0, 0, 0}).empty());
}

}  // namespace
}  // namespace sazare::geometry
