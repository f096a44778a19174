#include <gtest/gtest.h>

#include "tests/support/bonded_pair.hpp"

namespace sazare::methods::blocks {
namespace {

using sazare::test::BondedPair;
using terms::EnergyKind;

constexpr Real elastic_opening = 6.66e6 / 450e9, failure_opening = 2 * 99.67 / 6.66e6;

/// Pulls straight to an opening in steps; work done on the joint [J] by the trapezoidal rule.
Real pull(BondedPair& pair, Real from, Real to, int steps) {
  Real work = 0, before = 0;
  for (int step = 0; step <= steps; ++step) {
    pair.place(from + (to - from) * step / steps);
    const Real force = pair.stress().x() * pair.area();
    if (step > 0) work += 0.5 * (before + force) * (to - from) / steps;
    before = force;
  }
  return work;
}

TEST(joint_failure, pulled_apart_it_takes_the_fracture_energy_times_the_area) {
  BondedPair pair;
  const Real work = pull(pair, 0, 1.001 * failure_opening, 20000);
  EXPECT_EQ(pair.joints().state(0), JointState::broken);
  EXPECT_NEAR(work, 99.67 * pair.area(), 1e-3 * 99.67 * pair.area());
  const auto balance = pair.probe().energy_balance();
  EXPECT_NEAR(balance[EnergyKind::fracture], 99.67 * pair.area(), 1e-9);
  EXPECT_NEAR(balance[EnergyKind::release], 0, 1e-9);
  EXPECT_EQ(balance[EnergyKind::elastic], 0);
}

TEST(joint_failure, is_told_once_and_gives_no_force_from_then_on) {
  BondedPair pair;
  EXPECT_TRUE(pair.joints().bonded(0, 1));
  EXPECT_TRUE(pair.joints().bonded(1, 0));
  pair.place(1.01 * failure_opening);
  const auto forces = pair.forces();
  EXPECT_EQ(forces[1].linear.norm(), 0);
  const auto changes = pair.probe().post_step();
  EXPECT_EQ(changes.ended_links, std::vector<Index>{0});
  EXPECT_EQ(changes.softer, (std::vector<Index>{0, 1}));
  EXPECT_EQ(pair.joints().broken_count(), 1);
  EXPECT_EQ(pair.joints().take_broken(), std::vector<Index>{0});
  EXPECT_TRUE(pair.joints().take_broken().empty());
  EXPECT_FALSE(pair.joints().bonded(0, 1));
  EXPECT_EQ(pair.joints().rates(0).stiffness, 0);
  EXPECT_TRUE(pair.joints().first_links().empty());
  EXPECT_TRUE(pair.probe().post_step().ended_links.empty());
}

TEST(joint_failure, one_failed_vertex_releases_the_whole_face) {
  // Turned about an edge of the face only the third vertex opens: the axis is y at z = -0.1 / sqrt(12).
  BondedPair pair;
  const Real height = 0.1 * std::sqrt(3.0) / 2;
  const Vector3 hinge(0, 0, -0.1 / std::sqrt(12.0));
  const auto open = [&](Real opening) {
    const Matrix3 turn = Eigen::AngleAxis<Real>(opening / height, Vector3::UnitY()).toRotationMatrix();
    auto& motion = pair.bodies().motion[1];
    motion.position = hinge + turn * (pair.start() - hinge);
    motion.rotation = turn * state::start_rotation(pair.bodies(), 1);
  };
  open(0.99 * failure_opening);
  EXPECT_GT(pair.forces()[1].linear.norm(), 0);
  EXPECT_EQ(pair.joints().state(0), JointState::softening);
  open(1.01 * failure_opening);
  EXPECT_EQ(pair.forces()[1].linear.norm(), 0);
  EXPECT_EQ(pair.joints().state(0), JointState::broken);
  // Fracture took a third of the face's share; nothing was stored in the other two.
  EXPECT_NEAR(pair.probe().energy_balance()[EnergyKind::fracture], 99.67 * pair.area() / 3, 1e-3 * 99.67 * pair.area());
}

TEST(joint_failure, what_a_broken_face_still_stored_counts_as_released) {
  BondedPair pair;
  const Real slip = 5e-5;  // within the Coulomb line at this opening? 90e9 x 5e-5 = 4.5e6 Pa, less than 6.66e6
  pair.place(0, slip);
  pair.forces();
  const Real stored = pair.probe().energy_balance()[EnergyKind::elastic];
  pair.place(1.01 * failure_opening, slip);
  pair.forces();
  const auto balance = pair.probe().energy_balance();
  EXPECT_NEAR(stored, 0.5 * 90e9 * slip * slip * pair.area(), 1e-6 * stored);
  EXPECT_NEAR(balance[EnergyKind::release], stored, 1e-6 * stored);
}

TEST(joint_failure, unloading_goes_to_the_origin_and_reloading_back) {
  BondedPair pair;
  const Real peak = 0.7 * failure_opening;
  pull(pair, 0, peak, 50);
  const Real at_peak = pair.stress().x();
  EXPECT_NEAR(at_peak, 6.66e6 * (failure_opening - peak) / (failure_opening - elastic_opening), 1e-6 * 6.66e6);
  const Real fracture = pair.probe().energy_balance()[EnergyKind::fracture];
  for (const Real share : {0.75, 0.5, 0.25, 0.0, 0.5, 1.0}) {
    pair.place(share * peak);
    EXPECT_NEAR(pair.stress().x(), share * at_peak, 1e-6 * 6.66e6) << share;
  }
  EXPECT_EQ(pair.probe().energy_balance()[EnergyKind::fracture], fracture) << "a closed cycle takes nothing more";
  pair.place(-1e-6);
  EXPECT_NEAR(pair.stress().x(), -450e9 * 1e-6, 1);  // full stiffness in compression
}

TEST(joint_failure, shear_alone_never_breaks_a_face) {
  BondedPair pair;
  for (int step = 1; step <= 100; ++step) {
    pair.place(0, 1e-4 * step);
    pair.forces();
  }
  EXPECT_EQ(pair.joints().state(0), JointState::intact);
  EXPECT_TRUE(pair.probe().post_step().ended_links.empty());
}

}  // namespace
}  // namespace sazare::methods::blocks
