/// The overlap of two tetrahedra against sums over a fine grid, and its slope against differences.

#include "sazare/geometry/tetrahedron_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sazare::geometry {
namespace {

/// Two tetrahedra of any shape that overlap by much.
struct Pairs {
  std::mt19937 random{11};

  Real any(Real most) { return most * std::uniform_real_distribution<Real>(-1, 1)(random); }
  Vector3 any_vector(Real most) { return {any(most), any(most), any(most)}; }

  SolidTetrahedron solid() {
    Tetrahedron corners;
    do
      for (Vector3& corner : corners) corner = any_vector(1);
    while (!(volume(corners) > 0.1));
    return solid_tetrahedron(corners);
  }
};

Vector3 middle_of(const SolidTetrahedron& solid) { return centroid(solid.corners); }

/// One moved, and turned about its own centroid.
SolidTetrahedron shifted(const SolidTetrahedron& solid, const Vector3& move, const Vector3& turn) {
  const Vector3 centre = middle_of(solid);
  const Real angle = turn.norm();
  const Matrix3 rotation = angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
  return placed(solid, centre + move - rotation * centre, rotation);
}

Real depth_in(const SolidTetrahedron& solid, const Vector3& point) {
  Real least = solid.depth(0, point);
  for (int face = 1; face < 4; ++face) least = std::min(least, solid.depth(face, point));
  return least;
}

/// W by the middles of the cells of a grid.
Real weight_by_grid(const SolidTetrahedron& a, const SolidTetrahedron& b, int cells) {
  Real sum = 0;
  const Real edge = 2.0 / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const Vector3 point = edge * Vector3(i + 0.5, j + 0.5, k + 0.5) - Vector3::Ones();
        const Real one = depth_in(a, point), other = depth_in(b, point);
        if (one > 0 && other > 0) sum += 0.5 * (one + other);
      }
  return sum * edge * edge * edge;
}

TEST(tetrahedron_overlap, the_inscribed_sphere_touches_all_faces) {
  Pairs pairs;
  for (int round = 0; round < 20; ++round) {
    const SolidTetrahedron solid = pairs.solid();
    for (std::size_t face = 0; face < 4; ++face)
      for (std::size_t corner = 0; corner < 4; ++corner)
        if (corner != face) {
          EXPECT_NEAR(solid.normals[face].dot(solid.corners[corner] - solid.middle), solid.radius, 1e-14);
        }
  }
}

TEST(tetrahedron_overlap, weight_is_the_integral_of_the_depths) {
  Pairs pairs;
  for (int round = 0; round < 8; ++round) {
    const SolidTetrahedron a = pairs.solid(), b = pairs.solid();
    EXPECT_NEAR(overlap_weight(a, b), weight_by_grid(a, b, 90), 6e-5) << round;  // cells at the border are in or out
  }
}

TEST(tetrahedron_overlap, push_and_turning_are_the_slope_of_the_weight) {
  Pairs pairs;
  constexpr Real step = 1e-5;
  int meeting = 0;
  for (int round = 0; round < 60; ++round) {
    const SolidTetrahedron a = pairs.solid(), b = shifted(pairs.solid(), pairs.any_vector(0.6), Vector3::Zero());
    const TetrahedronOverlap found = overlap(a, b);
    meeting += !found.is_empty();
    const Vector3 about_centre = found.turning - middle_of(b).cross(found.push);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 along = step * Vector3::Unit(axis), none = Vector3::Zero();
      const auto slope = [&](const Vector3& move, const Vector3& turn) {
        return (overlap_weight(a, shifted(b, move, turn)) - overlap_weight(a, shifted(b, -move, -turn))) / (2 * step);
      };
      EXPECT_NEAR(found.push[axis], -slope(along, none), 1e-9) << round;
      EXPECT_NEAR(about_centre[axis], -slope(none, along), 1e-9) << round;
    }
  }
  EXPECT_GT(meeting, 30);
}

TEST(tetrahedron_overlap, is_the_same_from_both_sides_and_in_any_frame) {
  Pairs pairs;
  for (int round = 0; round < 20; ++round) {
    const SolidTetrahedron a = pairs.solid(), b = pairs.solid();
    const TetrahedronOverlap found = overlap(a, b), back = overlap(b, a);
    EXPECT_NEAR((found.push + back.push).norm(), 0, 1e-14);
    EXPECT_NEAR((found.turning + back.turning).norm(), 0, 1e-14);
    EXPECT_NEAR((found.normal + back.normal).norm(), 0, 1e-12);
    EXPECT_NEAR((found.place - back.place).norm(), 0, 1e-12);
    const Matrix3 turned = Quaternion(1, pairs.any(1), pairs.any(1), pairs.any(1)).normalized().toRotationMatrix();
    const Vector3 away = pairs.any_vector(3);
    const TetrahedronOverlap there = overlap(placed(a, away, turned), placed(b, away, turned));
    EXPECT_NEAR(overlap_weight(placed(a, away, turned), placed(b, away, turned)), overlap_weight(a, b), 1e-13);
    EXPECT_NEAR((there.push - turned * found.push).norm(), 0, 1e-13);
    EXPECT_NEAR((there.turning - (turned * found.turning + away.cross(turned * found.push))).norm(), 0, 1e-12);
    EXPECT_NEAR(there.area, found.area, 1e-12);
  }
}

/// Two that stand on each other with one face, as mirror images, and reach into each other by a depth.
std::pair<SolidTetrahedron, SolidTetrahedron> mirrored(Real depth) {
  const Vector3 a(0, 0, 0), b(1, 0.1, 0), c(0.2, 0.9, 0), low(0.4, 0.3, -0.8), high(0.4, 0.3, 0.8), up(0, 0, -depth);
  return {solid_tetrahedron({low, a, b, c}), solid_tetrahedron({high + up, a + up, c + up, b + up})};
}

TEST(tetrahedron_overlap, parallel_faces_push_with_area_times_depth) {
  for (const Real depth : {1e-8, 1e-6, 1e-4, 1e-3}) {
    const auto [below, above] = mirrored(depth);
    const Real area = face_area(below.corners, 0);
    const TetrahedronOverlap found = overlap(below, above);
    EXPECT_NEAR(overlap_weight(below, above) / (area * depth * depth / 2), 1, 12 * depth + 1e-9) << depth;
    EXPECT_NEAR(found.push.z() / (area * depth), 1, 12 * depth);
    EXPECT_LT(found.push.head<2>().norm(), 12 * depth * found.push.z());
    EXPECT_NEAR(found.area, area, 12 * depth);
    const TetrahedronOverlap by_face = overlap(below, above, 1, 1);
    EXPECT_NEAR((by_face.normal - Vector3::UnitZ()).norm(), 0, 1e-12);
    EXPECT_EQ(by_face.push, found.push);
  }
}

TEST(tetrahedron_overlap, what_is_apart_has_none_and_shows_its_gap) {
  EXPECT_LT(overlap_weight(mirrored(0).first, mirrored(0).second), 1e-30);
  const auto [below, above] = mirrored(-0.01);
  EXPECT_TRUE(overlap(below, above).is_empty());
  EXPECT_EQ(overlap_weight(below, above), 0);
  EXPECT_NEAR(gap(below, above), 0.01, 1e-15);
  EXPECT_EQ(shared_depth(below, above), 0);
}

TEST(tetrahedron_overlap, drawn_in_by_the_shared_depth_two_just_touch) {
  EXPECT_NEAR(shared_depth(mirrored(0.01).first, mirrored(0.01).second), 0.01, 1e-14);
  Pairs pairs;
  int some = 0;
  for (int round = 0; round < 60; ++round) {
    const SolidTetrahedron a = pairs.solid(), b = shifted(pairs.solid(), pairs.any_vector(1.2), Vector3::Zero());
    const Real depth = shared_depth(a, b);
    if (!(depth > 0) || depth > a.radius || depth > b.radius) continue;
    ++some;
    const auto drawn_in = [&](const SolidTetrahedron& solid, Real by) {
      return placed(solid, Vector3::Zero(), Matrix3::Identity(), by / 2);
    };
    EXPECT_LT(overlap_weight(drawn_in(a, depth * 1.0001), drawn_in(b, depth * 1.0001)), 1e-16) << round;
    EXPECT_GT(overlap_weight(drawn_in(a, depth * 0.9), drawn_in(b, depth * 0.9)), 0) << round;
  }
  EXPECT_GT(some, 10);
}

/// A wedge that is cut in two pushes as the whole does: what lies on the cut cancels.
TEST(tetrahedron_overlap, a_seam_of_the_other_side_gives_no_push_along_the_face) {
  constexpr Real depth = 1e-3;
  const Vector3 a(-2, -2, 0), b(2, -2, 0), c(0, 3, 0), low(0, 0, -3), on_edge(0, -2, 0);
  const SolidTetrahedron whole = solid_tetrahedron({low, a, b, c}), left = solid_tetrahedron({low, a, on_edge, c}),
                         right = solid_tetrahedron({low, on_edge, b, c});
  const SolidTetrahedron above =
      solid_tetrahedron({Vector3(0, 0, 1), Vector3(-0.3, -0.5, -depth), Vector3(0, 0.4, -depth), Vector3(0.5, -0.5, -depth)});
  const TetrahedronOverlap one = overlap(whole, above), first = overlap(left, above), second = overlap(right, above);
  EXPECT_NEAR((first.push + second.push - one.push).norm() / one.push.norm(), 0, 3 * depth);
  EXPECT_LT((first.push + second.push).head<2>().norm(), 3 * depth * depth);
}

}  // namespace
}  // namespace sazare::geometry
