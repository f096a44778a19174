#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

constexpr Real modulus = 2e11, second_moment = 2e-5, length = 4, plastic_moment = 1e5, yield = 3e4;

/// Nodes on a straight line of a length, with beams that yield from one to the next.
template <int D>
BodyDescription beams(const Vector3& along, int pieces) {
  BodyDescription body;
  body.mesh.dimension = D;
  MemberSet set{.name = "beam", .kind = MemberKind::beam};
  set.youngs_modulus = modulus;
  set.area = 1e-2;
  set.second_moment = second_moment;
  set.density = 7850;
  set.yield_moment = plastic_moment;
  for (Index i = 0; i <= pieces; ++i) {
    body.mesh.nodes.push_back(along.normalized() * length * i / pieces);
    body.mesh.node_tags.push_back(i + 1);
    if (i > 0) set.lines.push_back({i - 1, i});
  }
  body.members = {set};
  return body;
}

/// A bar with a yield force beside a soft elastic spring, along the first axis from node 0 to node 1.
BodyDescription bar_and_spring(std::optional<Real> compression = {}) {
  BodyDescription body;
  body.mesh.dimension = 2;
  body.mesh.nodes = {{0, 0, 0}, {2, 0, 0}};
  body.mesh.node_tags = {1, 2};
  MemberSet bar{.name = "bar", .kind = MemberKind::bar}, spring{.name = "spring", .kind = MemberKind::spring};
  bar.youngs_modulus = modulus;
  bar.area = 1e-4;  // 1e7 N/m
  bar.density = 7850;
  bar.prestress = 5e3;
  bar.yield_force = yield;
  bar.compression_force = compression;
  spring.stiffness = 1e6;
  bar.lines = spring.lines = {{0, 1}};
  body.members = {bar, spring};
  return body;
}

template <int D>
void hold(Index node, std::initializer_list<int> axes, Supports<D>& supports) {
  for (const int axis : axes) supports.held.push_back({node, axis, Support::no_motion, 0});
}

FemRules statics() {
  FemRules rules;
  rules.step = 1;
  rules.statics = true;
  rules.tolerance = 1e-11;
  return rules;
}

template <int D>
MemberForces forces(const FemStepper<D>& stepper, std::size_t set = 0) {
  const auto& state = stepper.state();
  return stepper.body().members().forces(set, state.displacement, state.velocity, state.memory.members);
}

FemStepper<2> pulled(std::optional<Real> compression = {}) {
  Supports<2> supports;
  hold<2>(0, {0, 1}, supports);
  hold<2>(1, {1}, supports);
  FemStepper<2> stepper(std::make_unique<Body<2>>(bar_and_spring(compression)), supports, statics());
  stepper.start();
  return stepper;
}

void pull(FemStepper<2>& stepper, Real force) {
  stepper.apply({0, 0, force, 0});
  stepper.advance();
}

TEST(yielding_bar, is_pulled_past_its_yield_force_and_back) {
  auto stepper = pulled();
  pull(stepper, 1e3);
  EXPECT_NEAR(stepper.state().displacement[2], (1e3 - 5e3) / 1.1e7, 1e-12);
  const Real lost = stepper.energy_residual();  // of the prestress, which nothing balanced before
  const Real full = 5e4, way = (full - yield) / 1e6, plastic = way - (yield - 5e3) / 1e7;
  for (int i = 1; i <= 50; ++i) pull(stepper, full * i / 50);
  EXPECT_NEAR(stepper.state().displacement[2], way, 1e-10);
  EXPECT_NEAR(forces(stepper).largest_axial, yield, 1e-6);
  EXPECT_NEAR(forces(stepper).plastic_elongation, plastic, 1e-10);
  EXPECT_NEAR(forces(stepper).force_ratio(stepper.body().members().sets()[0]), 1, 1e-12);
  EXPECT_NEAR(stepper.work().members, yield * plastic, 0.01 * yield * plastic);
  EXPECT_NEAR(stepper.energy_residual(), lost, 1e-9 * stepper.work().members);
  for (int i = 49; i >= 1; --i) pull(stepper, full * i / 50);
  EXPECT_NEAR(stepper.state().displacement[2], way - full * 0.98 / 1.1e7, 1e-10);
  EXPECT_NEAR(forces(stepper).plastic_elongation, plastic, 1e-10);
  for (int i = 1; i <= 50; ++i) pull(stepper, -full * i / 50);
  EXPECT_NEAR(forces(stepper).least_axial, -yield, 1e-6);
  EXPECT_NEAR(stepper.state().displacement[2], -way, 1e-10);
  EXPECT_NEAR(stepper.energy_residual(), lost, 1e-9 * stepper.work().members);
}

TEST(yielding_bar, goes_slack_and_bears_again_at_its_length) {
  auto stepper = pulled(0.0);
  pull(stepper, 5e4);
  const Real plastic = forces(stepper).plastic_elongation;
  EXPECT_GT(plastic, 0);
  pull(stepper, -5e4);
  EXPECT_EQ(forces(stepper).least_axial, 0);
  EXPECT_NEAR(stepper.state().displacement[2], -5e4 / 1e6, 1e-10);
  EXPECT_NEAR(forces(stepper).plastic_elongation, plastic, 1e-15);
  pull(stepper, 1e4);
  EXPECT_EQ(forces(stepper).largest_axial, 0);  // shorter than it has become
  EXPECT_NEAR(stepper.state().displacement[2], 1e4 / 1e6, 1e-10);
  pull(stepper, 2e4);
  EXPECT_NEAR(stepper.state().displacement[2], (2e4 - 5e3 + 1e7 * plastic) / 1.1e7, 1e-10);
  pull(stepper, 5e4);
  EXPECT_NEAR(forces(stepper).plastic_elongation, plastic, 1e-10);
}

/// A mass on a bar that yields, in space of one freedom: the balance closes with the work of the bar in it.
TEST(yielding_bar, closes_the_balance_of_a_vibration_and_goes_through_it_again) {
  Supports<2> supports;
  hold<2>(0, {0, 1}, supports);
  hold<2>(1, {1}, supports);
  BodyDescription description = bar_and_spring();
  description.members[0].prestress = 0;
  FemRules rules;
  rules.step = 2e-5;
  rules.tolerance = 1e-12;
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), supports, rules);
  stepper.start();
  FemState<2> pushed = stepper.state();
  pushed.velocity[2] = 60;
  stepper.restore(pushed);
  const Real energy = stepper.kinetic_energy();
  for (int step = 0; step < 50; ++step) stepper.advance();
  const FemState<2> saved = stepper.state();
  const auto go_on = [&] {
    for (int step = 0; step < 400; ++step) stepper.advance();
    return std::pair(stepper.state().displacement, stepper.state().memory.members);
  };
  const auto once = go_on();
  stepper.restore(saved);
  EXPECT_EQ(go_on(), once);
  EXPECT_GT(stepper.work().members, 0.3 * energy);
  EXPECT_NEAR(stepper.kinetic_energy() + stepper.elastic_energy() + stepper.work().members, energy, 1e-8 * energy);
}

/// A body of beams and bars whose hinges have turned: force is the slope of the energy, tangent that of the force.
template <int D>
void check_slopes() {
  BodyDescription description = beams<D>({1, 2, D == 3 ? 3.0 : 0.0}, 3);
  MemberSet bar = bar_and_spring().members[0];
  bar.lines = {{0, 2}, {1, 3}};
  description.members.push_back(bar);
  Body<D> body(std::move(description));
  const std::size_t size = body.freedoms();
  NodalColumn moved(size), force, other;
  for (std::size_t i = 0; i < size; ++i) moved[i] = 0.02 * std::sin(1.0 + 2.3 * static_cast<Real>(i));
  const Memory rest = body.memory_at_rest();
  Memory turned = rest, after = rest;
  BlockMatrix<D> tangent(body.pattern());
  body.evaluate(moved, rest, turned, force, &tangent);
  EXPECT_TRUE(std::ranges::any_of(turned.members, [](Real one) { return one != 0; }));
  EXPECT_GT(body.energies(NodalColumn(size, 0), moved, rest, turned).members, 0);
  NodalColumn along(size), product(size, 0);
  for (std::size_t i = 0; i < size; ++i) along[i] = std::cos(0.7 * static_cast<Real>(i));
  tangent.multiply(along, 1, product);
  const auto at = [&](Real step) {
    NodalColumn there = moved;
    for (std::size_t i = 0; i < size; ++i) there[i] += step * along[i];
    return there;
  };
  constexpr Real small = 1e-7;
  NodalColumn more, less;
  body.evaluate(at(small), rest, after, more, nullptr);
  body.evaluate(at(-small), rest, after, less, nullptr);
  Real largest = 0;
  for (const Real one : product) largest = std::max(largest, std::abs(one));
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR((more[i] - less[i]) / (2 * small), product[i], 1e-5 * largest);
  // Less moved it bears less and is elastic.
  for (Real& one : moved) one *= 0.999;
  for (Real& one : along) one *= 1e-3;
  body.evaluate(moved, turned, after, force, nullptr);
  ASSERT_EQ(after.members, turned.members);
  Real power = 0;
  for (std::size_t i = 0; i < size; ++i) power += force[i] * along[i];
  const auto energy = [&](Real step) { return body.energies(moved, at(step), turned, turned).elastic; };
  EXPECT_NEAR((energy(1e-5) - energy(-1e-5)) / 2e-5, power, 1e-6 * std::abs(power) + 1e-4);
}

TEST(yielding_members, have_forces_that_are_slopes_of_their_energy) {
  check_slopes<2>();
  check_slopes<3>();
}

/// A beam clamped at its first node under a force across it at a node, its last node on a roller or free. Throws PhysicsError
/// where it bears the force no more.
template <int D>
FemStepper<D> loaded(const Vector3& direction, int pieces, Index at, bool propped, Real push, int steps) {
  const Vector3 along = direction.normalized();
  const Vector3 across = D == 2 ? Vector3(-along.y(), along.x(), 0) : Vector3(along.unitOrthogonal());
  auto body = std::make_unique<Body<D>>(beams<D>(along, pieces));
  Supports<D> supports;
  for (int axis = 0; axis < D; ++axis) hold<D>(0, {axis}, supports);
  if (propped) hold<D>(pieces, {1}, supports);
  supports.clamped = {0};
  FemRules rules = statics();
  rules.most_cuts = 2;
  FemStepper<D> stepper(std::move(body), supports, rules);
  stepper.start();
  for (int step = 1; step <= steps; ++step) {
    NodalColumn force(static_cast<std::size_t>(pieces + 1) * D, 0);
    for (int axis = 0; axis < D; ++axis) force[static_cast<std::size_t>(at * D + axis)] = push * across[axis] * step / steps;
    stepper.apply(force);
    stepper.advance();
  }
  return stepper;
}

TEST(yielding_beam, bears_the_plastic_moment_of_a_cantilever_and_no_more) {
  const Real limit = plastic_moment / length;
  for (const int pieces : {1, 3}) {
    EXPECT_NO_THROW(loaded<2>({1, 2, 0}, pieces, pieces, false, 0.999 * limit, 4));
    EXPECT_THROW(loaded<2>({1, 2, 0}, pieces, pieces, false, 1.001 * limit, 4), PhysicsError);
    EXPECT_NO_THROW(loaded<3>({1, 2, 3}, pieces, pieces, false, 0.999 * limit, 4));
    EXPECT_THROW(loaded<3>({1, 2, 3}, pieces, pieces, false, 1.001 * limit, 4), PhysicsError);
  }
}

/// The clamp yields at 16/3 M/L, a mechanism is there at 6 M/L; between them it is a beam on two supports with M at one.
TEST(yielding_beam, turns_at_the_clamp_of_a_propped_beam_until_its_middle_yields) {
  for (const int pieces : {2, 6}) {
    const Index middle = pieces / 2;
    EXPECT_EQ(forces(loaded<2>({1, 0, 0}, pieces, middle, true, -5.32 * plastic_moment / length, 8)).plastic_rotation, 0);
    const Real push = 5.8 * plastic_moment / length;
    const auto stepper = loaded<2>({1, 0, 0}, pieces, middle, true, -push, 8);
    const Real bending = modulus * second_moment;
    const Real exact = push * length * length * length / (48 * bending) - plastic_moment * length * length / (16 * bending);
    EXPECT_NEAR(stepper.state().displacement[static_cast<std::size_t>(2 * middle + 1)], -exact, 1e-8 * exact);
    EXPECT_NEAR(forces(stepper).moment, plastic_moment, 1e-6 * plastic_moment);
    EXPECT_GT(forces(stepper).plastic_rotation, 0);
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * stepper.work().loads);
    EXPECT_NO_THROW(loaded<2>({1, 0, 0}, pieces, middle, true, -5.995 * plastic_moment / length, 8));
    EXPECT_THROW(loaded<2>({1, 0, 0}, pieces, middle, true, -6.005 * plastic_moment / length, 8), PhysicsError);
  }
}

/// Of two beams that meet in line the weaker one has the hinge.
TEST(yielding_beam, yields_where_its_section_is_weaker) {
  BodyDescription description = beams<2>({1, 0, 0}, 2);
  MemberSet outer = description.members[0];
  description.members[0].lines = {{0, 1}};
  description.members[0].yield_moment = 10 * plastic_moment;
  outer.name = "outer";
  outer.lines = {{1, 2}};
  description.members.push_back(outer);
  Supports<2> supports;
  hold<2>(0, {0, 1}, supports);
  hold<2>(2, {1}, supports);
  supports.clamped = {0};
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), supports, statics());
  stepper.start();
  stepper.apply({0, 0, 0, -1.2 * 2 * plastic_moment / length, 0, 0});
  stepper.advance();
  EXPECT_EQ(forces(stepper, 0).plastic_rotation, 0);
  EXPECT_EQ(forces(stepper, 1).plastic_rotation, 0);
  stepper.apply({0, 0, 0, -10 * plastic_moment / length, 0, 0});
  stepper.advance();
  EXPECT_EQ(forces(stepper, 0).plastic_rotation, 0);
  EXPECT_GT(forces(stepper, 1).plastic_rotation, 0);
  EXPECT_NEAR(forces(stepper, 1).moment, plastic_moment, 1e-6 * plastic_moment);
}

}  // namespace
}  // namespace sazare::methods::fem
