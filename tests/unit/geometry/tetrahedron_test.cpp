#include "sazare/geometry/tetrahedron.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sazare::geometry {
namespace {

const Tetrahedron unit = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)};
const Tetrahedron skewed = {Vector3(0.3, -0.2, 1.1), Vector3(2.0, 0.4, 0.9), Vector3(0.1, 1.7, 1.4), Vector3(0.8, 0.6, 3.2)};

TEST(tetrahedron, volume_and_centroid_of_the_unit_corner) {
  EXPECT_DOUBLE_EQ(volume(unit), 1.0 / 6);
  EXPECT_TRUE(centroid(unit).isApprox(Vector3(0.25, 0.25, 0.25)));
}

TEST(tetrahedron, swapped_corners_turn_the_volume_negative) {
  Tetrahedron swapped = skewed;
  std::swap(swapped[1], swapped[2]);
  EXPECT_GT(volume(skewed), 0);
  EXPECT_DOUBLE_EQ(volume(swapped), -volume(skewed));
}

TEST(tetrahedron, inertia_of_the_unit_corner_in_closed_form) {
  // With V = 1/6, integrals over the unit corner: x^2 -> 1/60, xy -> 1/120; about the centroid minus V/16.
  const Real square = 1.0 / 60 - 1.0 / 96;
  const Real product = 1.0 / 120 - 1.0 / 96;
  Matrix3 expected = Matrix3::Constant(-product);
  expected.diagonal().setConstant(2 * square);
  EXPECT_LT((inertia_about_centroid(unit) - expected).norm(), 1e-17);
}

TEST(tetrahedron, inertia_of_a_regular_one_is_that_of_a_sphere) {
  const Tetrahedron regular = {Vector3(1, 1, 1), Vector3(-1, 1, -1), Vector3(1, -1, -1), Vector3(-1, -1, 1)};
  // Edge s = 2 sqrt(2): V = 8/3, J = m s^2 / 20.
  ASSERT_NEAR(volume(regular), 8.0 / 3, 1e-15);
  EXPECT_LT((inertia_about_centroid(regular) - Matrix3::Identity() * (8.0 / 3) * 8 / 20).norm(), 1e-14);
}

TEST(tetrahedron, inertia_agrees_with_sampling) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> uniform(0, 1);
  constexpr int samples = 400000;
  Matrix3 sum = Matrix3::Zero();
  for (int sample = 0; sample < samples; ++sample) {
    // Spacings of three sorted uniform numbers are uniform barycentric coordinates.
    std::array<Real, 3> cuts = {uniform(random), uniform(random), uniform(random)};
    std::sort(cuts.begin(), cuts.end());
    const Vector3 point =
        skewed[0] * cuts[0] + skewed[1] * (cuts[1] - cuts[0]) + skewed[2] * (cuts[2] - cuts[1]) + skewed[3] * (1 - cuts[2]);
    const Vector3 arm = point - centroid(skewed);
    sum += arm.squaredNorm() * Matrix3::Identity() - arm * arm.transpose();
  }
  const Matrix3 sampled = sum * (volume(skewed) / samples);
  const Matrix3 exact = inertia_about_centroid(skewed);
  EXPECT_LT((sampled - exact).norm(), 5e-3 * exact.norm());
}

TEST(tetrahedron, inertia_turns_with_the_body_and_ignores_its_place) {
  const Matrix3 rotation = Quaternion(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
  Tetrahedron moved;
  for (std::size_t i = 0; i < 4; ++i) moved[i] = rotation * skewed[i] + Vector3(3, -4, 5);
  const Matrix3 expected = rotation * inertia_about_centroid(skewed) * rotation.transpose();
  EXPECT_LT((inertia_about_centroid(moved) - expected).norm(), 1e-13 * expected.norm());
}

TEST(tetrahedron, inertia_of_parts_adds_up_to_the_whole) {
  // Cut the edge 0-1 at its middle: by the parallel axis theorem both parts make the whole.
  const Vector3 middle = (skewed[0] + skewed[1]) / 2;
  const Tetrahedron first = {skewed[0], middle, skewed[2], skewed[3]};
  const Tetrahedron second = {middle, skewed[1], skewed[2], skewed[3]};
  Matrix3 sum = Matrix3::Zero();
  for (const Tetrahedron& part : {first, second}) {
    const Vector3 arm = centroid(part) - centroid(skewed);
    sum += inertia_about_centroid(part) + volume(part) * (arm.squaredNorm() * Matrix3::Identity() - arm * arm.transpose());
  }
  EXPECT_LT((sum - inertia_about_centroid(skewed)).norm(), 1e-14);
}

TEST(tetrahedron, face_normals_point_away_from_the_opposite_corner) {
  for (int face = 0; face < 4; ++face) {
    const auto on_face = static_cast<std::size_t>(tetrahedron_faces[static_cast<std::size_t>(face)][0]);
    const Vector3 to_opposite = skewed[static_cast<std::size_t>(face)] - skewed[on_face];
    EXPECT_LT(outward_normal(skewed, face).dot(to_opposite), 0) << face;
    EXPECT_GT(inward_normal(skewed, face).dot(to_opposite), 0) << face;
    EXPECT_NEAR(outward_normal(skewed, face).norm(), 1, 1e-15);
  }
}

TEST(tetrahedron, faces_close) {
  Vector3 sum = Vector3::Zero();
  for (int face = 0; face < 4; ++face) sum += face_area_vector(skewed, face);
  EXPECT_LT(sum.norm(), 1e-15);
}

TEST(tetrahedron, volume_from_its_faces) {
  for (int face = 0; face < 4; ++face) {
    const auto on_face = static_cast<std::size_t>(tetrahedron_faces[static_cast<std::size_t>(face)][1]);
    const Vector3 from_opposite = skewed[on_face] - skewed[static_cast<std::size_t>(face)];
    EXPECT_NEAR(face_area_vector(skewed, face).dot(from_opposite) / 3, volume(skewed), 1e-15);
    EXPECT_DOUBLE_EQ(face_area(skewed, face), face_area_vector(skewed, face).norm());
  }
}

}  // namespace
}  // namespace sazare::geometry
