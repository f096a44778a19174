#include "sazare/laws/face_link.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sazare::laws {
namespace {

FaceSprings springs() {
  FaceSprings face{0.5, 0.4, 0.5, 1000, 300, 7, 5, 1e9, 1e9, 0.5, spring_places(SpringPlaces::centres, 4)};
  return face;
}

/// Places and angles of two elements.
using Pose = std::array<Real, 6>;

template <FaceFormula formula>
FaceMotion<Real> motion_of(const Pose& q, const Pose& rate = {}) {
  FacePair<Real> pair;
  pair.apart = {q[3] - q[0], q[4] - q[1]};
  pair.approach = {rate[0] - rate[3], rate[1] - rate[4]};
  pair.spin_sum = rate[2] + rate[5];
  pair.spin_difference = rate[2] - rate[5];
  pair.turn = q[2] - q[5];
  pair.first_axis = {std::cos(q[2]), std::sin(q[2])};
  pair.second_axis = {std::cos(q[5]), std::sin(q[5])};
  return face_motion<formula>(pair, springs());
}

const Pose start = {0.1, -0.2, 0.3, 0.9, 0.13, 0.21};

/// Energy of the normal springs and, of formula exact, of the shear springs.
template <FaceFormula formula>
Real energy(const Pose& q) {
  const FaceSprings face = springs();
  const auto motion = motion_of<formula>(q);
  Real sum = 0;
  for (const Real xi : face.places) {
    const Real closing = motion.closing + motion.slope * xi;
    sum += 0.5 * face.normal * closing * closing;
  }
  if (formula == FaceFormula::exact) sum += 0.5 * face.count() * face.shear * motion.shear * motion.shear;
  return sum;
}

/// Forces and moments on both elements, by freedom.
template <FaceFormula formula>
Pose forces(const Pose& q) {
  const FaceSprings face = springs();
  const auto motion = motion_of<formula>(q);
  Real normal = 0, tilt = 0;
  for (const Real xi : face.places) {
    const Real force = face.normal * (motion.closing + motion.slope * xi);
    normal += force;
    tilt += xi * force;
  }
  const Real shear = formula == FaceFormula::exact ? face.count() * face.shear * motion.shear : 0;
  const auto force = face_force(motion, normal, tilt, shear);
  return {-force.force[0], -force.force[1], force.first_moment, force.force[0], force.force[1], force.second_moment};
}

template <FaceFormula formula>
void expect_derivative_of_energy() {
  const Pose found = forces<formula>(start);
  for (std::size_t i = 0; i < 6; ++i) {
    Pose more = start, less = start;
    more[i] += 1e-6;
    less[i] -= 1e-6;
    EXPECT_NEAR(found[i], -(energy<formula>(more) - energy<formula>(less)) / 2e-6, 1e-5 * std::abs(found[i]) + 1e-4) << i;
  }
}

TEST(face_link, forces_are_the_derivatives_of_the_energy) {
  expect_derivative_of_energy<FaceFormula::exact>();
  expect_derivative_of_energy<FaceFormula::small>();
}

/// The rates say how the displacements change.
template <FaceFormula formula>
void expect_rates() {
  const Pose rate = {0.3, -0.2, 0.5, -0.1, 0.4, -0.7};
  Pose more = start, less = start;
  for (std::size_t i = 0; i < 6; ++i) {
    more[i] += 1e-6 * rate[i];
    less[i] -= 1e-6 * rate[i];
  }
  const auto now = motion_of<formula>(start, rate), after = motion_of<formula>(more), before = motion_of<formula>(less);
  EXPECT_NEAR(now.closing_rate, (after.closing - before.closing) / 2e-6, 1e-7);
  EXPECT_NEAR(now.slope_rate, (after.slope - before.slope) / 2e-6, 1e-7);
  if (formula == FaceFormula::exact) {
    EXPECT_NEAR(now.shear_rate, (after.shear - before.shear) / 2e-6, 1e-7);
  }
}

TEST(face_link, rates_are_the_derivatives_of_the_displacements) {
  expect_rates<FaceFormula::exact>();
  expect_rates<FaceFormula::small>();
}

template <FaceFormula formula>
void expect_balance() {
  const FaceMotion<Real> motion = motion_of<formula>(start);
  const auto force = face_force(motion, 3.0, 0.7, -1.9);
  const Real x = start[3] - start[0], y = start[4] - start[1];
  EXPECT_NEAR(force.first_moment + force.second_moment + x * force.force[1] - y * force.force[0], 0, 1e-14);
}

TEST(face_link, keeps_angular_momentum) {
  expect_balance<FaceFormula::exact>();
  expect_balance<FaceFormula::small>();
  expect_balance<FaceFormula::older>();
}

/// Both elements turned about the origin.
Pose turned(const Pose& q, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  return {c * q[0] - s * q[1], s * q[0] + c * q[1], q[2] + angle, c * q[3] - s * q[4], s * q[3] + c * q[4], q[5] + angle};
}

TEST(face_link, does_not_feel_a_common_rotation) {
  for (const Real angle : {0.5, 2.0, -3.0}) {
    EXPECT_NEAR(energy<FaceFormula::exact>(turned(start, angle)), energy<FaceFormula::exact>(start), 1e-11);
    EXPECT_NEAR(energy<FaceFormula::small>(turned(start, angle)), energy<FaceFormula::small>(start), 1e-11);
  }
}

TEST(face_link, both_formulas_agree_to_first_order) {
  const Pose rest = {0, 0, 0, 0.9, 0, 0}, way = {0.3, -0.5, 0.7, 0.2, 0.6, 0.4};
  const auto difference = [&](Real size) {
    Pose q = rest;
    for (std::size_t i = 0; i < 6; ++i) q[i] += size * way[i];
    const auto exact = motion_of<FaceFormula::exact>(q), small = motion_of<FaceFormula::small>(q);
    return std::hypot(exact.closing - small.closing, exact.slope - small.slope);
  };
  EXPECT_NEAR(std::log2(difference(1e-3) / difference(5e-4)), 2, 0.05);
}

TEST(face_link, places_are_those_of_13_1_and_13_2) {
  EXPECT_EQ(spring_places(SpringPlaces::centres, 1), (std::vector<Real>{0}));
  EXPECT_EQ(spring_places(SpringPlaces::centres, 4), (std::vector<Real>{-0.75, -0.25, 0.25, 0.75}));
  EXPECT_EQ(spring_places(SpringPlaces::ends, 2), (std::vector<Real>{-1, 1}));
}

/// A spring alone, closing by so much and sheared by so much more.
SpringForce advance(SpringState& spring, const FaceSprings& face, Real closing, Real sheared) {
  FaceMotion<Real> motion;
  motion.closing = closing;
  motion.shear_rate = sheared;
  return advance_spring(spring, face, FaceFormula::small, motion, 0, 1);
}

FaceSprings weak() {
  FaceSprings face{0.5, 0.5, 0.5, 100, 50, 0, 0, 2, 3, 0.5, {0}};
  return face;
}

TEST(face_spring, breaks_at_its_tension_limit_and_joins_without_strength) {
  SpringState spring;
  EXPECT_DOUBLE_EQ(advance(spring, weak(), -0.019, 0).normal, -1.9);
  const SpringForce broken = advance(spring, weak(), -0.021, 0);
  EXPECT_EQ(broken.normal, 0);
  EXPECT_NEAR(broken.fracture_loss, 0.5 * 100 * 0.021 * 0.021, 1e-15);
  EXPECT_FALSE(spring.joined);
  EXPECT_EQ(advance(spring, weak(), -1e-9, 1).normal, 0);
  EXPECT_FALSE(spring.joined);
  EXPECT_DOUBLE_EQ(advance(spring, weak(), 0.01, 0).normal, 1);
  EXPECT_TRUE(spring.joined);
  EXPECT_DOUBLE_EQ(advance(spring, weak(), 0.01, 1).shear, 0.5);  // friction only
  EXPECT_EQ(advance(spring, weak(), -1e-9, 0).normal, 0);
  EXPECT_FALSE(spring.joined);
}

TEST(face_spring, bears_no_shear_where_it_is_pulled_beyond_what_cohesion_holds) {
  const auto strength = spring_strength(weak());
  EXPECT_EQ(shear_limit(strength, Real{2}), 4);
  EXPECT_EQ(shear_limit(strength, Real{-8}), 0);
  EXPECT_EQ(shear_limit(spring_strength(weak(), false), Real{-1}), 0) << "what has broken holds by friction alone";
}

TEST(face_spring, a_face_yields_as_soon_as_one_of_its_springs_does) {
  FaceSprings face = weak();
  face.places = spring_places(SpringPlaces::centres, 4);
  int yielding = 0;
  for (const Real closing : {-0.015, 0.0, 0.03})
    for (const Real slope : {-0.02, 0.0, 0.01})
      for (const Real sheared : {-0.09, 0.01, 0.07}) {
        FaceMotion<Real> motion;
        motion.closing = closing;
        motion.slope = slope;
        motion.shear_rate = sheared;
        bool one_does = false;
        for (const Real xi : face.places) {
          SpringState spring;
          const SpringForce force = advance_spring(spring, face, FaceFormula::small, motion, xi, 1);
          one_does = one_does || !spring.whole || force.friction_loss > 0;
        }
        EXPECT_EQ(yields(face, motion, sheared, face.last_place()), one_does) << closing << " " << slope << " " << sheared;
        yielding += one_does ? 1 : 0;
      }
  EXPECT_GT(yielding, 5);
  EXPECT_LT(yielding, 22);
}

TEST(face_spring, slips_at_cohesion_plus_friction) {
  SpringState spring;
  const SpringForce slid = advance(spring, weak(), 0.02, 0.1);
  EXPECT_DOUBLE_EQ(slid.shear, 3 + 0.5 * 2);
  EXPECT_NEAR(slid.friction_loss, 0.5 * (0 + 4) * (5 - 4) / 50.0, 1e-15);
  EXPECT_DOUBLE_EQ(advance(spring, weak(), 0.02, 0).shear, 4);  // what it bears stays
  EXPECT_DOUBLE_EQ(advance(spring, weak(), 0.02, -0.01).shear, 3.5);
}

}  // namespace
}  // namespace sazare::laws
