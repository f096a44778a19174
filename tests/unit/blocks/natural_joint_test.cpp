/// Natural joints between blocks: direct shear, forces from the energy, paths, opening and closing, and joints that part.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "sazare/methods/blocks/run/block_fragments.hpp"
#include "sazare/methods/blocks/run/natural_joints.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "tests/support/bonded_pair.hpp"

namespace sazare::methods::blocks {
namespace {

using laws::BartonBandis;
using sazare::test::BondedPair;
using terms::EnergyKind;

constexpr Real degree = std::numbers::pi / 180;

/// JRC 10, JCS 100 MPa, 30 deg, as long as the face, closing by 0.188 mm.
BartonBandis::Own own_numbers() { return {10.0, 100e6, 30.0, 0.1, std::nullopt, 0.3e-3}; }

cases::Joint natural_joint() {
  cases::Joint joint = test::concrete_joint("left", "right");
  joint.law = laws::JointLawName::barton_bandis;
  joint.cohesion = joint.friction_coefficient = joint.tensile_strength = joint.fracture_energy = 0;
  const auto own = own_numbers();
  std::ranges::copy(own, joint.law_parameters.end() - own.size());
  return joint;
}

Real compression_under(Real pressure) {
  const auto kind = std::get<JointParameters<BartonBandis, Real>>(runs::make_joint_kind(natural_joint()));
  return laws::compression_under(kind.tension, pressure);
}

/// Slides along the face under a constant pressure; returns the largest shear stress.
Real slide(BondedPair& pair, Real pressure, Real from, Real to, int steps) {
  Real largest = 0;
  for (int step = 1; step <= steps; ++step) {
    const Real dilation = pair.joints().record(0).vertex[0].peak;
    pair.place(dilation - compression_under(pressure), from + (to - from) * step / steps);
    largest = std::max(largest, pair.stress().y());
    pair.probe().post_step();
  }
  return largest;
}

TEST(natural_joint, has_the_parameters_of_its_law_in_their_places) {
  const cases::Joint joint = natural_joint();
  EXPECT_TRUE(joint.is_natural());
  EXPECT_EQ(joint.law_parameter("jrc"), 10.0);
  EXPECT_EQ(joint.law_parameter("joint_aperture"), 0.3e-3);
  EXPECT_FALSE(joint.law_parameter("shear_fracture_energy"));
}

TEST(natural_joint, closes_with_its_springs_and_bears_no_tension) {
  BondedPair pair(natural_joint());
  pair.place(1e-5);
  EXPECT_EQ(pair.stress().norm(), 0);
  for (const Real pressure : {1e5, 1e6, 1e7}) {
    pair.place(-compression_under(pressure));
    EXPECT_NEAR(pair.stress().x(), -pressure, 1e-6 * pressure);
  }
  pair.place(1e-5);
  EXPECT_EQ(pair.stress().norm(), 0);
  EXPECT_EQ(pair.joints().state(0), JointState::intact);
  pair.place(-compression_under(1e6));
  EXPECT_NEAR(pair.stress().x(), -1e6, 1);
}

/// tau = s tan(30 deg + 10 log10(100 MPa/s)) at a slip of 0.928 mm.
TEST(natural_joint, direct_shear_has_the_peak_of_barton_and_dilates) {
  for (const Real pressure : {1e6, 5e6}) {
    BondedPair pair(natural_joint());
    const Real full = 10 * std::log10(100e6 / pressure) * degree, peak_slip = 0.1 / 500 * std::cbrt(100.0);
    const Real largest = slide(pair, pressure, 0, 2 * peak_slip, 4000);
    EXPECT_NEAR(largest, pressure * std::tan(30 * degree + full), 2e-3 * largest);
    EXPECT_NEAR(pair.stress().y(), pressure * std::tan(30 * degree + 0.85 * full), 1e-2 * largest);
    EXPECT_EQ(pair.joints().state(0), JointState::softening) << "it has slipped";
    EXPECT_EQ(pair.joints().broken_count(), 0);
    // From 0.3 of the peak slip on: 0.375 in the mean up to 0.6, 0.875 up to 1, 0.925 beyond.
    const Real beyond = pair.joints().slip_paths()[0][1] / peak_slip - 1;
    EXPECT_NEAR(beyond, 1 - pair.stress().y() / 90e9 / peak_slip, 1e-3) << "the springs take the rest of the way";
    const Real dilation =
        peak_slip * (0.3 * std::tan(0.1875 * full) + 0.4 * std::tan(0.4375 * full) + beyond * std::tan(0.4625 * full));
    EXPECT_NEAR(pair.joints().record(0).vertex[1].peak, dilation, 1e-2 * dilation);
  }
}

/// 1/(1/V_m + K_ni/s) is 0.0448 mm under 1 MPa; at twice the slip of the peak 0.85 of JRC is left.
TEST(natural_joint, snapshots_tell_of_path_roughness_closure_and_dilation) {
  EXPECT_FALSE(runs::natural_joints(BondedPair().joints()).are_there());
  BondedPair pair(natural_joint());
  const Real peak_slip = 0.1 / 500 * std::cbrt(100.0);
  slide(pair, 1e6, 0, 2 * peak_slip, 4000);
  const runs::NaturalJoints seen = runs::natural_joints(pair.joints());
  EXPECT_NEAR(seen.path[0], 2 * peak_slip, 0.02 * peak_slip);
  EXPECT_NEAR(seen.mobilised_jrc[0], 8.5, 0.02);
  EXPECT_NEAR(seen.closure[0], 0.0448e-3, 5e-7);
  EXPECT_EQ(seen.dilation[0], std::max({pair.joints().record(0).vertex[0].peak, pair.joints().record(0).vertex[1].peak,
                                        pair.joints().record(0).vertex[2].peak}));
  EXPECT_GT(seen.dilation[0], 1e-4);
}

TEST(natural_joint, forces_derive_from_the_energy) {
  BondedPair pair(natural_joint());
  slide(pair, 2e6, 0, 5e-4, 200);
  const Real dilation = pair.joints().record(0).vertex[0].peak;
  ASSERT_GT(dilation, 1e-6);
  pair.place(dilation - compression_under(3e6), 5e-4 - 2e-6, 1e-6);
  const auto forces = pair.forces();
  for (Index body = 0; body < 2; ++body)
    for (int freedom = 0; freedom < 6; ++freedom)
      EXPECT_NEAR(test::component(forces[static_cast<std::size_t>(body)], freedom),
                  test::energy_slope(pair.probe(), pair.bodies(), body, freedom, freedom < 3 ? 1e-8 : 1e-7),
                  1e-5 * forces[1].linear.norm())
          << body << " " << freedom;
}

/// Turned as one, the two blocks keep pressure, shear stress and memory.
TEST(natural_joint, memory_turns_with_the_joint) {
  BondedPair pair(natural_joint());
  slide(pair, 2e6, 0, 5e-4, 200);
  pair.forces();  // until it has settled to the strength of its path
  const auto before = pair.forces()[1];
  const Real path = pair.joints().slip_paths()[0][0], dilation = pair.joints().record(0).vertex[0].peak;
  const Matrix3 turn = Eigen::AngleAxis<Real>(1.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (auto& motion : pair.bodies().motion) {
    motion.position = turn * motion.position;
    motion.rotation = turn * motion.rotation;
  }
  const auto after = pair.forces()[1];
  EXPECT_LT((after.linear - turn * before.linear).norm(), 1e-6 * before.linear.norm());
  EXPECT_NEAR(pair.joints().slip_paths()[0][0], path, 1e-9 * path);
  EXPECT_NEAR(pair.joints().record(0).vertex[0].peak, dilation, 1e-9 * dilation);
}

/// The work along a path with opening, slip and turns, by the trapezium rule, is stored or dissipated; the error is that of the
/// rule.
TEST(natural_joint, any_path_balances) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> number(-1, 1);
  BondedPair pair(natural_joint());
  auto& motion = pair.bodies().motion[1];
  Real work = 0, dissipated = 0, largest = 0, opening = 0;
  state::Impulse<3> before{};
  for (int leg = 0; leg < 12; ++leg) {
    const Real to = leg % 4 == 3 ? 5e-5 : -2e-4 * std::abs(number(random));
    const Vector3 way(to - opening, 1e-3 * number(random), 1e-3 * number(random));
    opening = to;
    const Vector3 turn = 5e-4 * Vector3(number(random), number(random), number(random));
    constexpr int steps = 2000;
    for (int step = 0; step < steps; ++step) {
      motion.position += way / steps;
      motion.rotation = Eigen::AngleAxis<Real>(turn.norm() / steps, turn.normalized()).toRotationMatrix() * motion.rotation;
      const auto now = pair.forces()[1];
      work -= 0.5 * ((before.linear + now.linear).dot(way) + (before.angular + now.angular).dot(turn)) / steps;
      before = now;
      largest = std::max(largest, std::abs(work));
    }
    const Real lost = pair.probe().energy_balance()[EnergyKind::slip];
    EXPECT_GT(lost, dissipated) << leg;
    dissipated = lost;
  }
  const auto balance = pair.probe().energy_balance();
  EXPECT_GT(balance[EnergyKind::slip], 0.1 * largest);
  EXPECT_EQ(balance[EnergyKind::fracture], 0);
  EXPECT_NEAR(work, balance[EnergyKind::elastic] + dissipated, 1e-4 * largest);
}

TEST(natural_joint, opened_by_a_tenth_of_its_size_it_is_left_to_contact) {
  BondedPair pair(natural_joint());
  const Real size = std::sqrt(pair.area());
  pair.place(0.09 * size);
  pair.forces();
  EXPECT_TRUE(pair.probe().post_step().ended_links.empty());
  pair.place(0.11 * size);
  pair.forces();
  EXPECT_EQ(pair.probe().post_step().ended_links, std::vector<Index>{0});
  EXPECT_EQ(pair.joints().state(0), JointState::broken);
  EXPECT_EQ(pair.probe().energy_balance()[EnergyKind::release], 0);
}

/// An open joint has no dashpots, which would hold its sides together.
TEST(natural_joint, dashpots_act_only_where_it_is_closed) {
  BondedPair pair(natural_joint());
  pair.bodies().motion[1].velocity = Vector3(1, 0, 0);
  pair.place(1e-5);
  EXPECT_EQ(pair.forces()[1].linear.norm(), 0);
  pair.place(-1e-5);
  EXPECT_LT(pair.forces()[1].linear.x(), 0.5 * -22.6e6 * pair.area() + 450e9 * 1e-5 * pair.area());
}

/// Sliding at 0.5 m/s the dashpot alone would bear 5 MPa; friction bounds it together with the springs.
TEST(natural_joint, dashpots_never_lift_the_shear_stress_above_the_strength) {
  auto plane = natural_joint();
  const auto own = BartonBandis::Own{0.0, 100e6, 30.0, 0.1};
  std::ranges::copy(own, plane.law_parameters.end() - own.size());
  BondedPair pair(plane);
  pair.place(-1e-5, 1e-3);
  const Real strength = pair.stress().y(), pressure = -pair.stress().x();
  EXPECT_NEAR(strength, pressure * std::tan(30 * degree), 1e-9 * strength);
  for (const Real speed : {0.5, -0.6}) {
    pair.bodies().motion[1].velocity = Vector3(0, speed, 0);
    EXPECT_NEAR(pair.stress().y(), std::copysign(strength, speed), 1e-9 * strength) << "it slides";
  }
  pair.bodies().motion[1].velocity = Vector3(0, -0.01, 0);
  EXPECT_NEAR(pair.stress().y(), strength - 0.01 * 10.1e6, 1e-6 * strength) << "it is let back, which the dashpot resists";
}

/// The same as it is run, with rigid and with deformable elements.
TEST(natural_joint, a_sliding_block_is_held_by_friction_alone) {
  for (const bool deformable : {false, true}) {
    auto blocks = test::two_block_case(true);
    blocks.joints[0] = natural_joint();
    blocks.joints[0].normal_damping = 0;
    const auto own = BartonBandis::Own{0.0, 100e6, 30.0, 0.1};
    std::ranges::copy(own, blocks.joints[0].law_parameters.end() - own.size());
    if (deformable) {
      for (cases::Material& material : blocks.materials) {
        material.youngs_modulus = 30e9;
        material.poisson_ratio = 0.2;
        material.deformable = true;
      }
    }
    blocks.constraints.push_back({{"left", "right"}, {false, false, false}, {true, true, true}});
    test::move(blocks, "left", {1, -2, 0});
    test::move(blocks, "right", {-1, 2, 0});
    blocks.time.base_step = 1e-7;
    auto model = runs::build_blocks(blocks, test::two_blocks());
    model.simulation->start();
    int sliding = 0;
    while (model.simulation->now().seconds() < 5e-5) {
      model.simulation->advance();
      const Vector3 force = model.joints->force(0);
      const Real along = std::hypot(force.y(), force.z()), most = std::tan(30 * degree) * std::abs(force.x());
      ASSERT_LE(along, most * (1 + 1e-5)) << deformable << " " << model.simulation->now().seconds();
      if (along > 0.99 * most && most > 0) ++sliding;
    }
    EXPECT_GT(sliding, 20);
    const auto balance = model.simulation->energy_balance();
    EXPECT_GT(balance[EnergyKind::slip], 0);
    EXPECT_LT(std::abs(balance.residual()), 1e-3 * balance[EnergyKind::slip]);
  }
}

/// Each joint begins with the compression that bears the initial stress.
TEST(natural_joint, initial_stress_is_borne_from_the_beginning) {
  auto blocks = test::two_block_case(true);
  blocks.joints[0] = natural_joint();
  blocks.initial_stress.normal = Vector3(-4e6, -1e6, -1e6);
  blocks.initial_stress.shear = Vector3(1e6, 0, 0);
  auto model = runs::build_blocks(blocks, test::two_blocks());
  test::ForceProbe<3> probe(*model.joints, const_cast<state::Bodies<3>&>(model.simulation->bodies()));
  const Vector3 stress = -probe.forces({0})[1].linear / (vertex_count * Real{model.joints->record(0).vertex_area});
  EXPECT_NEAR(std::abs(stress.x()), 4e6, 1);
  EXPECT_NEAR(std::abs(stress.y()), 1e6, 1);
  EXPECT_EQ(model.joints->state(0), JointState::intact);
  EXPECT_EQ(runs::find_fragments(2, *model.joints).count, 2) << "a natural joint parts fragments";
}

/// An initial stress between the residual strength, 2.31 MPa, and that at the peak, 3.86 MPa, makes the joint slip at once; what
/// that takes of the energy of the start is told.
TEST(natural_joint, begins_with_its_residual_friction) {
  auto blocks = test::two_block_case(true);
  blocks.joints[0] = natural_joint();
  blocks.joints[0].normal_damping = blocks.joints[0].shear_damping = 0;
  blocks.initial_stress.normal = Vector3(-4e6, -1e6, -1e6);
  blocks.initial_stress.shear = Vector3(2e6, 0, 0);
  EXPECT_EQ(runs::build_blocks(blocks, test::two_blocks()).fit.overstressed.front().faces, 0);
  blocks.initial_stress.shear = Vector3(3e6, 0, 0);
  blocks.time.base_step = 1e-8;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  EXPECT_EQ(model.fit.overstressed.front().faces, 1);
  EXPECT_NEAR(model.fit.overstressed.front().worst, 3 / (4 * std::tan(30 * degree)), 1e-3);
  model.simulation->start();
  for (int step = 0; step < 100; ++step) model.simulation->advance();
  const auto balance = model.simulation->energy_balance();
  EXPECT_GT(balance[EnergyKind::slip], 0);
  EXPECT_LT(std::abs(balance.residual()), 1e-3 * balance[EnergyKind::slip]);
}

/// Joints of a bar, moved at random: evaluated together or one by one they have the same bits, so threads and ranks do not
/// matter.
TEST(natural_joint, has_the_same_bits_whoever_is_evaluated_beside_it) {
  auto blocks = test::bar_case();
  const std::string material = blocks.materials[0].name;
  blocks.joints[0] = natural_joint();
  blocks.joints[0].between = {material, material};
  const auto mesh = test::cube_bar(5, 0.1, 2);
  auto together = runs::build_blocks(blocks, mesh), alone = runs::build_blocks(blocks, mesh);
  auto& first = const_cast<state::Bodies<3>&>(together.simulation->bodies());
  auto& second = const_cast<state::Bodies<3>&>(alone.simulation->bodies());
  test::ForceProbe<3> all(*together.joints, first), one(*alone.joints, second);
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> by(-4e-4, 4e-4);
  for (int round = 0; round < 20; ++round) {
    for (std::size_t body = 0; body < first.motion.size(); ++body)
      for (int axis = 0; axis < 3; ++axis) second.motion[body].position[axis] = first.motion[body].position[axis] += by(random);
    all.forces();
    for (Index joint = 0; joint < alone.joints->count(); ++joint) one.forces({joint});
  }
  int slipped = 0;
  for (Index joint = 0; joint < alone.joints->count(); ++joint) {
    if (alone.joints->state(joint) == JointState::softening) ++slipped;
    EXPECT_EQ(together.joints->state(joint), alone.joints->state(joint));
    EXPECT_EQ(together.joints->slip_paths()[static_cast<std::size_t>(joint)],
              alone.joints->slip_paths()[static_cast<std::size_t>(joint)]);
    EXPECT_EQ(together.joints->losses(joint).slip_work, alone.joints->losses(joint).slip_work);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      EXPECT_EQ(together.joints->record(joint).vertex[v].corner, alone.joints->record(joint).vertex[v].corner);
      EXPECT_EQ(together.joints->record(joint).vertex[v].peak, alone.joints->record(joint).vertex[v].peak);
    }
  }
  EXPECT_GT(slipped, lane_count);
}

/// Two blocks run into each other and slide along their joint, and part again; returns the residual of the balance over what slip
/// has taken. Without an aperture dilation in one step is much of the compression of the springs.
Real residual_of_run(Real step, bool closes) {
  auto blocks = test::two_block_case(true);
  blocks.joints[0] = natural_joint();
  blocks.joints[0].normal_damping = blocks.joints[0].shear_damping = 0;
  if (!closes) *(blocks.joints[0].law_parameters.end() - own_numbers().size() + BartonBandis::joint_aperture) = std::nullopt;
  blocks.constraints.push_back({{"left", "right"}, {false, false, false}, {true, true, true}});
  test::move(blocks, "left", {2, -4, 0});
  test::move(blocks, "right", {-2, 4, 0.5});
  blocks.time.base_step = step;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  while (model.simulation->now().seconds() < 4e-4) model.simulation->advance();
  const auto balance = model.simulation->energy_balance();
  EXPECT_GT(balance[EnergyKind::slip], 0);
  return std::abs(balance.residual() / balance[EnergyKind::slip]);
}

TEST(natural_joint, a_run_closes_its_energy_balance_to_second_order) {
  EXPECT_LT(residual_of_run(2e-8, true), 1e-5);
  const Real coarse = residual_of_run(2e-8, false), fine = residual_of_run(5e-9, false);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, coarse / 8) << "a quarter of the step, a sixteenth of the residual";
}

}  // namespace
}  // namespace sazare::methods::blocks
