/// What contacts of blocks remember, on bodies that turn.

#include <gtest/gtest.h>

#include <numbers>

#include "sazare/methods/blocks/contact_kernel.hpp"

namespace sazare::methods::blocks {
namespace {

/// Two blocks that turn as one, ten times round: what holds them stays as it is, seen from them.
TEST(contact_turn, blocks_that_turn_as_one_keep_their_friction) {
  constexpr int steps = 1000000;
  constexpr Real angle = 20 * std::numbers::pi / steps, seconds = 1e-3;
  for (const Vector3& axis : {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0.3, -0.5, 0.8)}) {
    const Vector3 spin = angle / seconds * axis.normalized();
    const Matrix3 turn = Eigen::AngleAxis<Real>(angle, axis.normalized()).toRotationMatrix();
    laws::SphereMemory memory{0, Vector3(3, 4, 0)};
    Vector3 normal = Vector3::UnitZ();
    for (int n = 0; n < steps; ++n) {
      normal = (turn * normal).normalized();
      turn_with_spheres<Real>(memory, normal, Vector3::Zero(), 0.01, 0.03, spin, spin, seconds);
    }
    // The turn of a step is exact to its third order.
    EXPECT_LT((memory.friction - Vector3(3, 4, 0)).norm(), steps * std::pow(angle, 3)) << axis.transpose();
    EXPECT_NEAR(memory.friction.dot(normal), 0, 1e-14);
  }
}

/// Spheres that roll around each other turn their normal as their centres go.
TEST(contact_turn, the_normal_goes_with_the_centres) {
  constexpr int steps = 100000;
  constexpr Real angle = 0.5 * std::numbers::pi / steps, seconds = 1e-3, distance = 0.04;
  laws::SphereMemory memory{0, Vector3(3, 4, 0)};
  Vector3 normal = Vector3::UnitZ();
  const Matrix3 turn = Eigen::AngleAxis<Real>(angle, Vector3::UnitY()).toRotationMatrix();
  for (int n = 0; n < steps; ++n) {
    normal = turn * normal;
    const Vector3 opening = distance * angle / seconds * Vector3::UnitY().cross(normal);  // of bodies that do not spin
    turn_with_spheres<Real>(memory, normal, opening, 0.01, 0.03, Vector3::Zero(), Vector3::Zero(), seconds);
  }
  EXPECT_LT((memory.friction - Vector3(0, 4, -3)).norm(), 1e-6);
}

}  // namespace
}  // namespace sazare::methods::blocks
