#include <gtest/gtest.h>

#include "sazare/levels/terms/gravity.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::terms {
namespace {

state::Bodies<3> two_masses() {
  state::Bodies<3> bodies;
  state::add_body(bodies, 2.0, Vector3(0, 0, 10), Vector3(1, 1, 1), Quaternion::Identity(), 0.5);
  state::add_body(bodies, 5.0, Vector3(1, 0, 20), Vector3(1, 1, 1), Quaternion::Identity(), 0.5);
  return bodies;
}

TEST(gravity, pulls_every_body_by_its_mass_and_turns_none) {
  auto bodies = two_masses();
  Gravity<3> gravity({0, 0, -9.81}, bodies);
  test::ForceProbe<3> probe(gravity, bodies);
  const auto forces = probe.forces();
  EXPECT_EQ(forces[0].linear, Vector3(0, 0, 2 * -9.81));
  EXPECT_EQ(forces[1].linear, Vector3(0, 0, 5 * -9.81));
  EXPECT_TRUE(forces[0].angular.isZero(0));
}

TEST(gravity, its_work_is_weight_times_height) {
  auto bodies = two_masses();
  Gravity<3> gravity({0, 0, -9.81}, bodies);
  test::ForceProbe<3> probe(gravity, bodies);
  bodies.motion[0].position.z() -= 3;
  bodies.motion[1].position.z() += 1;
  EXPECT_NEAR(probe.energy_balance()[EnergyKind::work], 9.81 * (2 * 3 - 5 * 1), 1e-12);
}

TEST(gravity, joins_no_bodies_and_asks_for_no_step) {
  auto bodies = two_masses();
  const Gravity<3> gravity({0, 0, -9.81}, bodies);
  EXPECT_FALSE(gravity.joins_bodies());
  EXPECT_EQ(gravity.first_links().size(), 2u);
  EXPECT_EQ(gravity.rates(0).stiffness, 0);
}

}  // namespace
}  // namespace sazare::terms
