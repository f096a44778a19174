#include "sazare/laws/face_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sazare::laws {
namespace {

using Points = std::vector<ContactPoint>;

constexpr ContactSprings springs{1000, 400, 30, 20};
constexpr ContactSprings without_dashpots{1000, 400, 0, 0};
constexpr Real much = 1e9;  // a friction that holds anything

/// A step of a contact whose shear spring has borne so much before.
FaceContactForce step(const ContactSprings& of, Real friction, const Points& points, Real before = 0, Real elapsed = 1,
                  Real share = 1) {
  return advance_contact(before, of, friction, points, share, elapsed);
}

TEST(face_contact, forces_across_a_face_are_the_slopes_of_the_energy) {
  const Points points = {{0.02, 0, 0}, {0.03, 0, 0}};
  for (const Real share : {1.0, 0.4})
    for (std::size_t i = 0; i < 2; ++i) {
      const auto energy = [&](Real by) {
        Points moved = points;
        moved[i].depth += by;
        return step(without_dashpots, much, moved, 5, 1, share).energy;
      };
      const Real slope = (energy(1e-4) - energy(-1e-4)) / 2e-4;  // exact but for rounding: the energy is quadratic
      EXPECT_NEAR(step(without_dashpots, much, points, 5, 1, share).point[i].normal, slope, 1e-9 * slope);
    }
}

TEST(face_contact, the_force_along_a_face_is_the_slope_of_the_energy_while_it_holds) {
  const auto slid = [&](Real by) { return step(without_dashpots, much, {{0.02, 0, by}, {0.03, 0, by}}, 5); };
  const Real slope = (slid(1e-4).energy - slid(-1e-4).energy) / 2e-4;
  const FaceContactForce held = slid(0);
  EXPECT_NEAR(held.point[0].shear + held.point[1].shear, slope, 1e-9 * slope);
  EXPECT_NEAR(slope, 5, 1e-8);
  EXPECT_EQ(held.friction_loss, 0);
}

TEST(face_contact, without_overlap_nothing_acts_and_nothing_is_stored) {
  const FaceContactForce force = step(springs, 0.5, {{0, 0, 3}}, 0);
  EXPECT_EQ(force.point[0].normal, 0);
  EXPECT_EQ(force.point[0].shear, 0);
  EXPECT_EQ(force.energy, 0);
  Real spring = 7;
  const FaceContactForce released = advance_contact(spring, springs, 0.5, Points{{0, -1, 0}}, 1, 1);
  EXPECT_EQ(spring, 0) << "nothing presses, so nothing holds";
  EXPECT_EQ(released.point[0].normal, 0) << "a dashpot does not pull";
  EXPECT_DOUBLE_EQ(released.friction_loss, 0.5 * 7 * 7 / 400);
}

TEST(face_contact, it_slips_at_friction_times_pressure_and_loses_what_the_slip_takes) {
  const Points points = {{0.02, 0, 0.1}, {0.03, 0, 0.1}};
  Real spring = 20;
  const FaceContactForce force = advance_contact(spring, springs, 0.5, points, 1, 1);
  EXPECT_DOUBLE_EQ(spring, 0.5 * 50);
  EXPECT_DOUBLE_EQ(force.point[0].shear + force.point[1].shear, 25);
  EXPECT_DOUBLE_EQ(force.point[0].shear, 25 * 20.0 / 50);
  EXPECT_EQ(force.point[0].shear_dashpot, 0) << "no dashpot while it slips";
  // The work of the mean force over the sliding of 0.1 m less what the spring has gained.
  EXPECT_NEAR(force.friction_loss, 0.5 * (20 + 25) * 0.1 - 0.5 * (25 * 25 - 20 * 20) / 400.0, 1e-12);
}

TEST(face_contact, sliding_the_other_way_gives_the_opposite_force) {
  for (const Real speed : {1e-3, 10.0}) {
    const FaceContactForce one = step(springs, 0.5, {{0.02, 0.1, speed}, {0.03, 0.2, speed}}, 0),
                       other = step(springs, 0.5, {{0.02, 0.1, -speed}, {0.03, 0.2, -speed}}, 0);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(one.point[i].shear, -other.point[i].shear);
      EXPECT_EQ(one.point[i].normal, other.point[i].normal);
    }
    EXPECT_EQ(one.energy, other.energy);
    EXPECT_EQ(one.friction_loss, other.friction_loss);
  }
}

TEST(face_contact, it_does_not_matter_which_point_comes_first) {
  const ContactPoint a{0.02, 0.1, 0.01}, b{0.03, -0.2, 0.02};
  const FaceContactForce one = step(springs, 0.5, {a, b}, 3), other = step(springs, 0.5, {b, a}, 3);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_DOUBLE_EQ(one.point[i].normal, other.point[1 - i].normal);
    EXPECT_DOUBLE_EQ(one.point[i].shear, other.point[1 - i].shear);
  }
  EXPECT_DOUBLE_EQ(one.energy, other.energy);
}

TEST(face_contact, dashpots_add_to_the_springs_and_never_pull) {
  const PointForce closing = step(springs, 0.5, {{0.02, 0.1, 0}}).point[0];
  EXPECT_DOUBLE_EQ(closing.normal, 20 + 3);
  EXPECT_DOUBLE_EQ(closing.normal_dashpot, 3);
  EXPECT_DOUBLE_EQ(step(springs, 0.5, {{0.02, -0.1, 0}}).point[0].normal, 20 - 3);
  EXPECT_EQ(step(springs, 0.5, {{0.02, -10, 0}}).point[0].normal, 0);
  const PointForce sliding = step(springs, 0.5, {{0.02, 0, 0.01}}).point[0];
  EXPECT_DOUBLE_EQ(sliding.shear, 400 * 0.01 + 20 * 0.01);
  EXPECT_DOUBLE_EQ(sliding.shear_dashpot, 20 * 0.01);
}

TEST(face_contact, springs_follow_from_the_sizes_of_both) {
  const FaceContact law{1e6, 4e5, 0.5, 0.5, 2};
  const ContactSprings pair = contact_springs(law, 0.3, 0.5, 2, 0.1);
  EXPECT_DOUBLE_EQ(pair.normal, 1e6 * (2 * 0.3 * 2) / 0.8 / 2);
  EXPECT_DOUBLE_EQ(pair.shear, 4e5 * (2 * 0.3 * 2) / 0.8);
  const Real critical = 2 * std::sqrt(2 * pair.normal * 10);
  EXPECT_DOUBLE_EQ(2 * pair.normal_damping, 0.5 * critical);
  EXPECT_DOUBLE_EQ(pair.shear_damping, 0.5 * critical * std::sqrt(0.4));
  const ContactSprings wall = contact_springs(law, 0, 0.5, 2, 0.1), other = contact_springs(law, 0.5, 0, 2, 0.1);
  EXPECT_DOUBLE_EQ(wall.normal, 1e6 * 2 * 2 / 2) << "2 k_n l on a wall, whatever the size";
  EXPECT_EQ(wall.normal, other.normal);
  EXPECT_EQ(contact_springs(law, 0, 0.5, 1, 0.1).normal, 2 * wall.normal) << "a circle has all of it at one point";
  EXPECT_EQ(contact_springs(law, 0.5, 0.5, 2, 0).normal_damping, 0);
}

}  // namespace
}  // namespace sazare::laws
