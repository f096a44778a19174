#include "sazare/methods/blocks/contact_spheres.hpp"

#include <gtest/gtest.h>

#include <random>

namespace sazare::methods::blocks {
namespace {

geometry::Tetrahedron random_tetrahedron(std::mt19937_64& random) {
  std::uniform_real_distribution<Real> uniform(-1, 1);
  geometry::Tetrahedron corners;
  do {
    for (Vector3& corner : corners) corner = {uniform(random), uniform(random), uniform(random)};
    if (geometry::volume(corners) < 0) std::swap(corners[1], corners[2]);
  } while (geometry::volume(corners) < 0.02);
  return corners;
}

/// Distance from a face's plane, positive inside.
Real depth(const geometry::Tetrahedron& corners, int face, const Vector3& point) {
  const auto on_face = static_cast<std::size_t>(geometry::tetrahedron_faces[static_cast<std::size_t>(face)][0]);
  return -geometry::outward_normal(corners, face).dot(point - corners[on_face]);
}

class ContactSpheres : public testing::Test {
protected:
  template <class Check>
  void each_sphere(Check&& check) {
    std::mt19937_64 random(2);
    for (int sample = 0; sample < 50; ++sample) {
      const auto corners = random_tetrahedron(random);
      for (int face = 0; face < 4; ++face)
        for (const int division : {3, 5, 8})
          for (const ContactSphere& sphere : contact_spheres(corners, face, division)) check(corners, face, sphere);
    }
  }
};

constexpr Real rounding = 1e-14;  // of corners within 1 m

TEST_F(ContactSpheres, are_as_many_as_the_interior_points_of_the_division) {
  std::mt19937_64 random(1);
  const auto corners = random_tetrahedron(random);
  for (int division = 3; division <= 20; ++division)
    EXPECT_EQ(contact_spheres(corners, 2, division).size(), static_cast<std::size_t>((division - 1) * (division - 2) / 2));
}

TEST_F(ContactSpheres, touch_their_face_from_inside) {
  each_sphere([](const auto& corners, int face, const ContactSphere& sphere) {
    EXPECT_GT(sphere.radius, 0);
    EXPECT_NEAR(depth(corners, face, sphere.centre), sphere.radius, rounding);
  });
}

TEST_F(ContactSpheres, cross_no_other_face_and_touch_the_nearest) {
  each_sphere([](const auto& corners, int face, const ContactSphere& sphere) {
    Real nearest = 10;
    for (int other = 0; other < 4; ++other)
      if (other != face) nearest = std::min(nearest, depth(corners, other, sphere.centre));
    EXPECT_NEAR(nearest, sphere.radius, 10 * rounding);
  });
}

TEST_F(ContactSpheres, touch_at_the_points_of_the_division) {
  const geometry::Tetrahedron corners = {Vector3(0, 0, -1), Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  const auto spheres = contact_spheres(corners, 0, 3);  // one point, the centroid of the face in z = 0
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_NEAR(spheres[0].centre.x(), 1.0 / 3, rounding);
  EXPECT_NEAR(spheres[0].centre.y(), 1.0 / 3, rounding);
  EXPECT_NEAR(spheres[0].centre.z(), -spheres[0].radius, rounding);
}

TEST_F(ContactSpheres, of_two_blocks_that_share_a_face_do_not_overlap) {
  const geometry::Tetrahedron below = {Vector3(0.2, 0.3, -1), Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  const geometry::Tetrahedron above = {Vector3(0.1, 0.5, 0.7), Vector3(0, 0, 0), Vector3(0, 1, 0), Vector3(1, 0, 0)};
  ASSERT_GT(geometry::volume(below), 0);
  ASSERT_GT(geometry::volume(above), 0);
  for (const auto& one : contact_spheres(below, 0, 6))
    for (const auto& other : contact_spheres(above, 0, 6))
      EXPECT_GT((one.centre - other.centre).norm(), one.radius + other.radius - rounding);
}

TEST_F(ContactSpheres, a_bound_holds_all_of_them) {
  std::mt19937_64 random(4);
  for (int sample = 0; sample < 20; ++sample) {
    const auto spheres = contact_spheres(random_tetrahedron(random), sample % 4, 5);
    const ContactSphere bound = bounding_sphere(spheres);
    Real farthest = 0;
    for (const auto& sphere : spheres) farthest = std::max(farthest, (sphere.centre - bound.centre).norm() + sphere.radius);
    EXPECT_NEAR(farthest, bound.radius, rounding);
  }
}

}  // namespace
}  // namespace sazare::methods::blocks
