/// Joints of a law that softens by slip: forces from the energy, the balance of any path, and faces that shear, open and slide off.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/bonded_pair.hpp"

namespace sazare::methods::blocks {
namespace {

using sazare::test::BondedPair;
using terms::EnergyKind;

constexpr Real shear_energy = 900, pressure = 5e6;

/// With friction 0.58 at the peak and 0.4 when the cohesion of 6.66 MPa is used up.
cases::Joint mixed_joint() {
  cases::Joint joint = test::concrete_joint("left", "right");
  joint.law = laws::JointLawName::mixed_mode;
  joint.law_parameters = {shear_energy, 0.4};
  return joint;
}

constexpr Real failure_slip = 2 * shear_energy / 6.66e6, overlap = -pressure / 450e9;

/// Slides along the face in steps; returns the work against the shear force [J].
Real slide(BondedPair& pair, Real opening, Real from, Real to, int steps) {
  Real work = 0, before = 0;
  for (int step = 0; step <= steps; ++step) {
    pair.place(opening, from + (to - from) * step / steps);
    const Real force = pair.stress().y() * pair.area();
    if (step > 0) work += 0.5 * (before + force) * (to - from) / steps;
    before = force;
    pair.probe().post_step();
  }
  return work;
}

TEST(slip_softening, sheared_under_pressure_a_joint_is_a_crack_with_residual_friction) {
  BondedPair pair(mixed_joint());
  const Real work = slide(pair, overlap, 0, 1.2 * failure_slip, 4000);
  EXPECT_EQ(pair.joints().state(0), JointState::sheared);
  EXPECT_EQ(pair.joints().broken_count(), 1);
  EXPECT_TRUE(pair.joints().take_broken().empty());
  EXPECT_TRUE(pair.joints().bonded(0, 1)) << "its faces still touch as they are";
  EXPECT_NEAR(pair.stress().y(), 0.4 * pressure, 1e-6 * pressure);
  EXPECT_NEAR(pair.stress().x(), -pressure, 1e-6 * pressure);
  EXPECT_TRUE(pair.joints().losses(0).is_mostly_shear());
  const auto balance = pair.probe().energy_balance();
  EXPECT_NEAR(balance[EnergyKind::fracture], shear_energy * pair.area(), 1e-6 * work);
  const Real pressing = 0.5 * pressure * -overlap * pair.area();
  EXPECT_NEAR(balance[EnergyKind::elastic] + balance[EnergyKind::slip] + balance[EnergyKind::fracture], work + pressing, 1e-4 * work);
}

TEST(slip_softening, a_sheared_joint_that_opens_is_broken_and_counted_once) {
  BondedPair pair(mixed_joint());
  slide(pair, overlap, 0, 1.2 * failure_slip, 400);
  pair.place(1e-9, 1.2 * failure_slip);
  EXPECT_EQ(pair.forces()[1].linear.norm(), 0);
  EXPECT_EQ(pair.probe().post_step().ended_links, std::vector<Index>{0});
  EXPECT_EQ(pair.joints().state(0), JointState::broken);
  EXPECT_EQ(pair.joints().broken_count(), 1);
  EXPECT_FALSE(pair.joints().bonded(0, 1));
}

TEST(slip_softening, a_sheared_joint_without_shear_stress_breaks_when_it_opens) {
  cases::Joint smooth = mixed_joint();
  smooth.friction_coefficient = 0;
  smooth.law_parameters[1] = 0;
  BondedPair pair(smooth);
  slide(pair, overlap, 0, 1.2 * failure_slip, 400);
  EXPECT_NEAR(pair.stress().y(), 0, 1e-6 * pressure);
  pair.place(1e-9, 1.2 * failure_slip);
  pair.forces();
  EXPECT_EQ(pair.joints().state(0), JointState::broken);
}

TEST(slip_softening, a_face_that_has_slid_off_is_left_to_contact) {
  BondedPair pair(mixed_joint());
  slide(pair, overlap, 0, 0.9 * std::sqrt(pair.area()), 2000);
  EXPECT_EQ(pair.joints().state(0), JointState::sheared);
  slide(pair, overlap, 0.9 * std::sqrt(pair.area()), 1.1 * std::sqrt(pair.area()), 200);
  EXPECT_EQ(pair.joints().state(0), JointState::broken);
}

TEST(slip_softening, forces_derive_from_the_energy) {
  BondedPair pair(mixed_joint());
  pair.place(1.5e-5, 5e-5);
  pair.forces();
  EXPECT_EQ(pair.joints().state(0), JointState::softening);
  slide(pair, 1.5e-5, 5e-5, 0.4 * failure_slip, 100);
  pair.place(1e-5, 0.4 * failure_slip - 1e-6);
  const auto forces = pair.forces();
  for (Index body = 0; body < 2; ++body)
    for (int freedom = 0; freedom < 6; ++freedom)
      EXPECT_NEAR(test::component(forces[static_cast<std::size_t>(body)], freedom),
                  test::energy_slope(pair.probe(), pair.bodies(), body, freedom, freedom < 3 ? 1e-9 : 1e-8),
                  1e-6 * forces[1].linear.norm())
          << body << " " << freedom;
}

/// The work along a path with opening, slip and turns, by the trapezium rule, is stored or dissipated; the error is that of the rule.
TEST(slip_softening, any_path_balances) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> number(-1, 1);
  BondedPair pair(mixed_joint());
  auto& motion = pair.bodies().motion[1];
  Real work = 0, dissipated = 0, largest = 0;
  state::Impulse<3> before{};
  for (int leg = 0; leg < 12 && pair.joints().state(0) != JointState::broken; ++leg) {
    const Vector3 way(4e-6 * number(random), 1e-4 * number(random), 1e-4 * number(random));
    const Vector3 turn = 1e-4 * Vector3(number(random), number(random), number(random));
    constexpr int steps = 2000;
    for (int step = 0; step < steps && pair.joints().state(0) != JointState::broken; ++step) {
      motion.position += way / steps;
      motion.rotation = Eigen::AngleAxis<Real>(turn.norm() / steps, turn.normalized()).toRotationMatrix() * motion.rotation;
      const auto now = pair.forces()[1];
      if (leg + step > 0)
        work -= 0.5 * ((before.linear + now.linear).dot(way) + (before.angular + now.angular).dot(turn)) / steps;
      before = now;
      const auto balance = pair.probe().energy_balance();
      const Real lost = balance[EnergyKind::slip] + balance[EnergyKind::fracture] + balance[EnergyKind::release];
      ASSERT_GE(lost, dissipated - 1e-12) << leg << " " << step;
      dissipated = lost;
      largest = std::max(largest, std::abs(work));
    }
  }
  const auto balance = pair.probe().energy_balance();
  EXPECT_GT(balance[EnergyKind::fracture], 0.1 * 99.67 * pair.area());
  EXPECT_NEAR(work, balance[EnergyKind::elastic] + dissipated, 2e-3 * largest);
}

}  // namespace
}  // namespace sazare::methods::blocks
