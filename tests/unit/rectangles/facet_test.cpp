/// The law of eccentric faces, those of irregular packings.

#include <gtest/gtest.h>

#include <cmath>

#include "sazare/laws/face_link.hpp"

namespace sazare::laws {
namespace {

constexpr Facet<Real> facet{0.5, 0.4, 0.12, -0.07, 0.3, 1000, 300, 7, 5, 1e9, 1e9, 0.5};
constexpr Real direction = 0.4;  // of n at the beginning

/// Places and turns of two elements.
using Pose = std::array<Real, 6>;

FaceMotion<Real> motion_of(const Pose& q, const Pose& rate = {}) {
  FacePair<Real> pair;
  pair.apart = {q[3] - q[0], q[4] - q[1]};
  pair.approach = {rate[0] - rate[3], rate[1] - rate[4]};
  pair.spin_sum = rate[2] + rate[5];
  pair.spin_difference = rate[2] - rate[5];
  pair.first_axis = {std::cos(q[2] + direction), std::sin(q[2] + direction)};
  pair.second_axis = {std::cos(q[5] + direction), std::sin(q[5] + direction)};
  return face_motion<FaceFormula::exact>(pair, facet);
}

/// Both elements where their faces meet: x2 - x1 = (r1 + r2) n + (e1 - e2) s.
Pose at_rest() {
  const Real c = std::cos(direction), s = std::sin(direction);
  const Real along = facet.first_reach + facet.second_reach, across = facet.first_shift - facet.second_shift;
  return {0, 0, 0, along * c + across * s, along * s - across * c, 0};
}

Pose moved() {
  const Pose way = {0.1, -0.2, 0.3, 0.05, 0.13, -0.21};
  Pose q = at_rest();
  for (std::size_t i = 0; i < 6; ++i) q[i] += way[i];
  return q;
}

/// What three springs of the face, taken as points of both elements, store: found from their places and nothing else.
Real energy(const Pose& q) {
  const Real mean = 0.5 * (q[2] + q[5]) + direction;
  const std::array<Real, 2> n = {std::cos(mean), std::sin(mean)}, s = {n[1], -n[0]};
  Real sum = 0;
  for (const Real xi : {-0.8, 0.0, 0.8}) {
    std::array<Real, 2> apart{};
    const auto add = [&](std::size_t first, Real reach, Real shift, Real sign) {
      const Real c = std::cos(q[first + 2] + direction), sn = std::sin(q[first + 2] + direction);
      const Real beside = shift + xi * facet.half_face;
      apart[0] += sign * (q[first] + reach * c + beside * sn);
      apart[1] += sign * (q[first + 1] + reach * sn - beside * c);
    };
    add(0, facet.first_reach, facet.first_shift, 1);
    add(3, -facet.second_reach, facet.second_shift, -1);
    const Real closing = n[0] * apart[0] + n[1] * apart[1], shear = s[0] * apart[0] + s[1] * apart[1];
    sum += 0.5 * (facet.normal * closing * closing + facet.shear * shear * shear);
  }
  return sum;
}

TEST(facet, is_unstrained_where_its_faces_meet) {
  const auto motion = motion_of(at_rest());
  EXPECT_NEAR(motion.closing, 0, 1e-15);
  EXPECT_NEAR(motion.slope, 0, 1e-15);
  EXPECT_NEAR(motion.shear, 0, 1e-15);
}

TEST(facet, forces_are_the_derivatives_of_the_energy_of_its_points) {
  const auto motion = motion_of(moved());
  Real normal = 0, tilt = 0;
  for (const Real xi : {-0.8, 0.0, 0.8}) {
    const Real force = facet.normal * (motion.closing + motion.slope * xi);
    normal += force;
    tilt += xi * force;
  }
  const auto force = face_force(motion, normal, tilt, 3 * facet.shear * motion.shear);
  const Pose found = {-force.force[0], -force.force[1], force.first_moment, force.force[0], force.force[1], force.second_moment};
  for (std::size_t i = 0; i < 6; ++i) {
    Pose more = moved(), less = moved();
    more[i] += 1e-6;
    less[i] -= 1e-6;
    EXPECT_NEAR(found[i], -(energy(more) - energy(less)) / 2e-6, 1e-6 * std::abs(found[i]) + 1e-5) << i;
  }
}

TEST(facet, rates_are_the_derivatives_of_the_displacements) {
  const Pose rate = {0.3, -0.2, 0.5, -0.1, 0.4, -0.7};
  Pose more = moved(), less = moved();
  for (std::size_t i = 0; i < 6; ++i) {
    more[i] += 1e-6 * rate[i];
    less[i] -= 1e-6 * rate[i];
  }
  const auto now = motion_of(moved(), rate), after = motion_of(more), before = motion_of(less);
  EXPECT_NEAR(now.closing_rate, (after.closing - before.closing) / 2e-6, 1e-8);
  EXPECT_NEAR(now.slope_rate, (after.slope - before.slope) / 2e-6, 1e-8);
  EXPECT_NEAR(now.shear_rate, (after.shear - before.shear) / 2e-6, 1e-8);
}

TEST(facet, keeps_angular_momentum) {
  const Pose q = moved();
  const auto force = face_force(motion_of(q), 3.0, 0.7, -1.9);
  EXPECT_NEAR(force.first_moment + force.second_moment + (q[3] - q[0]) * force.force[1] - (q[4] - q[1]) * force.force[0], 0,
              1e-14);
}

TEST(facet, does_not_feel_a_common_rotation) {
  const Pose q = moved();
  for (const Real angle : {0.5, 2.0, -3.0}) {
    const Real c = std::cos(angle), s = std::sin(angle);
    const Pose turned = {c * q[0] - s * q[1], s * q[0] + c * q[1], q[2] + angle,
                         c * q[3] - s * q[4], s * q[3] + c * q[4], q[5] + angle};
    const auto before = motion_of(q), after = motion_of(turned);
    EXPECT_NEAR(after.closing, before.closing, 1e-14);
    EXPECT_NEAR(after.slope, before.slope, 1e-14);
    EXPECT_NEAR(after.shear, before.shear, 1e-14);
  }
}

TEST(facet, without_eccentricity_is_the_face_of_a_lattice) {
  Facet<Real> central = facet;
  central.first_shift = central.second_shift = 0;
  FaceSprings face{0.5, 0.4, 0.3, 1000, 300, 7, 5, 1e9, 1e9, 0.5, {-0.8, 0, 0.8}};
  FacePair<Real> pair;
  pair.apart = {0.8, 0.2};
  pair.first_axis = {std::cos(0.1), std::sin(0.1)};
  pair.second_axis = {std::cos(0.3), std::sin(0.3)};
  const auto one = face_motion<FaceFormula::exact>(pair, central), other = face_motion<FaceFormula::exact>(pair, face);
  EXPECT_EQ(one.closing, other.closing);
  EXPECT_EQ(one.shear, other.shear);
  EXPECT_EQ(one.lag, other.lag);
  EXPECT_EQ(one.first_arm, other.first_arm);
}

}  // namespace
}  // namespace sazare::laws
