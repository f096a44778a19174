#include "sazare/laws/sphere_bond.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace sazare::laws {
namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();
constexpr Real length = 0.02, radius = 0.004, modulus = 2e9, poisson = 0.25;
const BondStiffness<Real> beam = beam_stiffness(length, radius, modulus, poisson);

Turn<Real> about(const Vector3& axis, Real angle) {
  const Vector3 part = std::sin(0.5 * angle) * axis.normalized();
  return {std::cos(0.5 * angle), part.x(), part.y(), part.z()};
}

/// first * second: the second turn comes first.
Turn<Real> after(const Turn<Real>& first, const Turn<Real>& second) {
  return turn_between<Real>({second.w, -second.x, -second.y, -second.z}, first);
}

BondPose<Real> at_start() { return {{length, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0}}; }

/// Far from the start: strains of tenths, and turned as a whole.
BondPose<Real> far_off() {
  BondPose<Real> pose = at_start();
  const Turn<Real> whole = about({1, 2, -0.5}, 2.2);
  pose.apart = turned<Real>(whole, {1.1 * length, 0.2 * length, -0.15 * length});
  pose.first = after(whole, about({0.3, -1, 0.4}, 0.3));
  pose.second = after(whole, about({1, 0.2, 0.7}, 0.4));
  return pose;
}

BondForce<Real> sound(const BondPose<Real>& pose) { return bond_force<Real>(beam, pose, 1); }
Real energy(const BondPose<Real>& pose) {
  const BondForce<Real> force = sound(pose);
  return force.energy + force.compression;
}

Real norm(const Vector3& vector) { return vector.norm(); }

TEST(sphere_bond, force_and_moments_are_slopes_of_the_energy) {
  const BondPose<Real> pose = far_off();
  const BondForce<Real> force = sound(pose);
  const Real small = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const auto slope = [&](const auto& moved) { return -(energy(moved(small)) - energy(moved(-small))) / (2 * small); };
    const Vector3 unit = Vector3::Unit(axis);
    const Real pushed = slope([&](Real by) {
      BondPose<Real> other = pose;
      other.apart = other.apart + by * length * unit;
      return other;
    });
    EXPECT_NEAR(pushed, length * force.force[axis], 1e-8 * length * norm(force.force)) << axis;
    const Real turned_first = slope([&](Real by) {
      BondPose<Real> other = pose;
      other.first = after(about(unit, by), pose.first);
      return other;
    });
    EXPECT_NEAR(turned_first, force.first_moment[axis], 1e-7 * norm(force.first_moment)) << axis;
    const Real turned_second = slope([&](Real by) {
      BondPose<Real> other = pose;
      other.second = after(about(unit, by), pose.second);
      return other;
    });
    EXPECT_NEAR(turned_second, force.second_moment[axis], 1e-7 * norm(force.second_moment)) << axis;
  }
}

TEST(sphere_bond, rigid_motions_do_nothing) {
  const Real scale = beam.stretch * length;
  for (const Real angle : {0.1, 1.5, 3.1, 5.0}) {
    const Turn<Real> whole = about({0.2, -0.9, 0.5}, angle);
    const BondPose<Real> pose{turned<Real>(whole, {length, 0, 0}), whole, whole, {1, 0, 0}};
    const BondForce<Real> force = sound(pose);
    EXPECT_LT(norm(force.force), 1e-14 * scale);
    EXPECT_LT(norm(force.first_moment), 1e-14 * scale * length);
    EXPECT_LT(norm(force.second_moment), 1e-14 * scale * length);
    EXPECT_LT(energy(pose), 1e-28 * scale * length);
  }
}

TEST(sphere_bond, keeps_angular_momentum) {
  const BondPose<Real> pose = far_off();
  const BondForce<Real> force = sound(pose);
  const Vector3 total = force.first_moment + force.second_moment + cross(pose.apart, force.force);
  EXPECT_LT(norm(total), 1e-14 * norm(force.first_moment));
}

TEST(sphere_bond, is_the_same_from_either_end) {
  const BondPose<Real> pose = far_off();
  const BondPose<Real> back{zero_vector<Real>() - pose.apart, pose.second, pose.first, zero_vector<Real>() - pose.direction};
  const BondForce<Real> one = sound(pose), other = sound(back);
  EXPECT_LT(norm(one.force + other.force), 1e-14 * norm(one.force));
  EXPECT_LT(norm(one.first_moment - other.second_moment), 1e-14 * norm(one.first_moment));
  EXPECT_NEAR(one.energy, other.energy, 1e-14 * one.energy);
}

/// Stretch, shear, bending and twist of a Timoshenko beam between clamped ends.
TEST(sphere_bond, small_motions_meet_the_stiffness_of_a_beam) {
  const Real area = std::numbers::pi * radius * radius, second_moment = 0.25 * area * radius * radius,
             shear_modulus = modulus / (2 * (1 + poisson)), coefficient = 6 * (1 + poisson) / (7 + 6 * poisson);
  const Real shear = 12 * modulus * second_moment / (coefficient * shear_modulus * area * length * length), small = 1e-6;
  BondPose<Real> pose = at_start();
  pose.apart[0] += small * length;
  EXPECT_NEAR(sound(pose).force[0], -modulus * area * small, 1e-8 * modulus * area * small);
  pose = at_start();
  pose.apart[1] += small * length;
  const Real across = 12 * modulus * second_moment / (length * length * (1 + shear)) * small;
  EXPECT_NEAR(sound(pose).force[1], -across, 1e-6 * across);
  EXPECT_NEAR(sound(pose).first_moment[2], 0.5 * across * length, 1e-6 * across * length);
  pose = at_start();
  pose.second = about({0, 0, 1}, small);
  const Real far = modulus * second_moment / length * (4 + shear) / (1 + shear) * small,
             near = modulus * second_moment / length * (2 - shear) / (1 + shear) * small;
  EXPECT_NEAR(sound(pose).second_moment[2], -far, 1e-6 * far);
  EXPECT_NEAR(sound(pose).first_moment[2], -near, 1e-6 * std::abs(far));
  pose = at_start();
  pose.second = about({1, 0, 0}, small);
  const Real twist = shear_modulus * 2 * second_moment / length * small;
  EXPECT_NEAR(sound(pose).second_moment[0], -twist, 1e-6 * twist);
  EXPECT_NEAR(sound(pose).first_moment[0], twist, 1e-6 * twist);
}

TEST(sphere_bond, a_cemented_contact_has_its_stiffnesses_per_area) {
  const BondStiffness<Real> cement = cement_stiffness(length, radius, 3e12, 1e12);
  const Real area = std::numbers::pi * radius * radius, small = 1e-6 * length;
  BondPose<Real> pose = at_start();
  pose.apart[0] += small;
  EXPECT_NEAR(bond_force<Real>(cement, pose, 1).force[0], -3e12 * area * small, 1e-9 * 3e12 * area * small);
  pose = at_start();
  pose.apart[1] += small;
  EXPECT_NEAR(bond_force<Real>(cement, pose, 1).force[1], -1e12 * area * small, 1e-6 * 1e12 * area * small);
}

/// Stresses at the rim by beam theory.
TEST(sphere_bond, use_follows_tension_bending_shear_and_twist) {
  const Real area = std::numbers::pi * radius * radius, small = 1e-5;
  const BondStrength<Real> tensile{1e6, infinite, 0, 1}, cohesive{infinite, 1e6, 0, 1}, rubbing{infinite, 1e6, 0.5, 1};
  BondPose<Real> pose = at_start();
  pose.apart[0] += small * length;
  const Real tension = modulus * small;
  EXPECT_NEAR(bond_use<Real>(tensile, sound(pose), radius), tension / 1e6, 1e-8);
  pose = at_start();
  pose.second = about({0, 1, 0}, small);
  pose.first = about({0, 1, 0}, -small);  // pure bending
  EXPECT_NEAR(bond_use<Real>(tensile, sound(pose), radius), modulus * radius * 2 * small / length / 1e6, 1e-7);
  pose = at_start();
  pose.second = about({1, 0, 0}, small);
  const Real twist = modulus / (2 * (1 + poisson)) * radius * small / length;
  EXPECT_NEAR(bond_use<Real>(cohesive, sound(pose), radius), twist / 1e6, 1e-8);
  EXPECT_NEAR(bond_use<Real>(rubbing, sound(pose), radius), twist / 1e6, 1e-8);
  pose.apart[0] -= small * length;
  EXPECT_NEAR(bond_use<Real>(rubbing, sound(pose), radius), twist / (1e6 + 0.5 * tension), 1e-8);
  EXPECT_NEAR(bond_use<Real>(cohesive, sound(pose), radius), twist / 1e6, 1e-8);
  pose = at_start();
  pose.apart[1] += 1e-6 * length;
  const Real shear = -sound(pose).force[1] / area;
  EXPECT_NEAR(bond_use<Real>(cohesive, sound(pose), radius), shear / 1e6, 1e-6 * shear / 1e6);
}

/// The area under stress against opening is the fracture energy.
TEST(sphere_bond, softening_takes_the_fracture_energy) {
  const Real strength = 1e6, fracture_energy = 20, ultimate = ultimate_use(strength, modulus / length, fracture_energy);
  ASSERT_GT(ultimate, 2);
  const Real first = strength / modulus * length, last = ultimate * first;
  EXPECT_EQ(kept_stiffness<Real>(0.5, ultimate), 1);
  EXPECT_EQ(kept_stiffness<Real>(1.0, ultimate), 1);
  EXPECT_EQ(kept_stiffness<Real>(ultimate, ultimate), 0);
  EXPECT_EQ(kept_stiffness<Real>(1.0, 1.0), 0);
  EXPECT_EQ(kept_stiffness<Real>(0.999, 1.0), 1);
  Real area = 0;
  const int pieces = 100000;
  for (int k = 0; k < pieces; ++k) {
    const Real opening = (k + 0.5) * last / pieces, use = opening / first;
    const Real stress = kept_stiffness<Real>(use, ultimate) * modulus * opening / length;
    EXPECT_LE(stress, strength * (1 + 1e-12));
    area += stress * last / pieces;
  }
  EXPECT_NEAR(area, fracture_energy, 1e-6 * fracture_energy);
}

TEST(sphere_bond, damage_leaves_compression) {
  BondPose<Real> pose = at_start();
  pose.apart[0] -= 1e-5;
  EXPECT_EQ(bond_force<Real>(beam, pose, 0.25).force[0], sound(pose).force[0]);
  pose.apart[0] += 2e-5;
  EXPECT_NEAR(bond_force<Real>(beam, pose, 0.25).force[0], 0.25 * sound(pose).force[0], 1e-9);
}

TEST(sphere_bond, dashpots_take_no_notice_of_rigid_motion) {
  const BondDamping<Real> damping{3, 2, 1e-4};
  const BondPose<Real> pose = far_off();
  const Vector3 direction = sound(pose).direction, spin{3, -2, 5};
  const auto rigid = bond_drag<Real>(damping, pose.apart, direction, cross(spin, pose.apart), Vector3::Zero(), spin);
  EXPECT_LT(norm(rigid.force), 1e-15);
  EXPECT_LT(norm(rigid.moment), 1e-15);
  const Vector3 velocity{0.3, 0.1, -0.4}, first_spin{1, 2, 3}, second_spin{-2, 0, 4};
  const auto drag =
      bond_drag<Real>(damping, pose.apart, direction, velocity, second_spin - first_spin, 0.5 * (first_spin + second_spin));
  // The power taken is that of force and moments on both spheres.
  const Real power =
      dot(drag.force, velocity) + (drag.arm - drag.moment).dot(first_spin) + (drag.arm + drag.moment).dot(second_spin);
  EXPECT_NEAR(drag.power, -power, 1e-12 * drag.power);
  EXPECT_GT(drag.power, 0);
  EXPECT_LT(norm(drag.arm + drag.arm + cross(pose.apart, drag.force)), 1e-14 * norm(drag.arm));
}

TEST(sphere_bond, lanes_compute_what_one_number_does) {
  const BondPose<Real> pose = far_off();
  const auto wide = [](Real value) { return broadcast(value); };
  const auto vectors = [&](const Vector3& t) { return LaneVector{wide(t[0]), wide(t[1]), wide(t[2])}; };
  const auto turns = [&](const Turn<Real>& t) { return Turn<Lanes>{wide(t.w), wide(t.x), wide(t.y), wide(t.z)}; };
  const BondStiffness<Lanes> stiffness{wide(beam.length), wide(beam.stretch), wide(beam.shear), wide(beam.bend),
                                       wide(beam.twist)};
  const auto lanes = bond_force<Lanes>(
      stiffness, {vectors(pose.apart), turns(pose.first), turns(pose.second), vectors(pose.direction)}, wide(0.7));
  const auto one = bond_force<Real>(beam, pose, 0.7);
  EXPECT_EQ(lanes.force[1][1], one.force[1]);
  EXPECT_EQ(lanes.first_moment[2][lane_count - 1], one.first_moment[2]);
  EXPECT_EQ(lanes.energy[0], one.energy);
  const BondStrength<Lanes> strength{wide(1e6), wide(2e6), wide(0.4), wide(3)};
  EXPECT_EQ(bond_use<Lanes>(strength, lanes, wide(radius))[2], bond_use<Real>({1e6, 2e6, 0.4, 3}, one, radius));
  EXPECT_EQ(kept_stiffness<Lanes>(wide(1.7), wide(3))[1], kept_stiffness<Real>(1.7, 3));
}

}  // namespace
}  // namespace sazare::laws
