#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/rectangles/surface_contacts.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::rectangles {
namespace {

using geometry::OutlineKind, geometry::Vector2;
using test::Scene;
using Segments = std::vector<SurfaceContacts::Segment>;

struct Chain {
  std::vector<Vector3> nodes;
  Segments segments;
};

/// Through some places, from left to right: what is above it is on its left.
Chain chain(const std::vector<Vector2>& places) {
  Chain made;
  for (const Vector2& place : places) made.nodes.emplace_back(place.x(), place.y(), 0);
  for (Index i = 0; i + 1 < static_cast<Index>(places.size()); ++i) made.segments.push_back({i, i + 1});
  return made;
}

Chain level(int cuts) {
  std::vector<Vector2> places;
  for (int i = 0; i <= cuts; ++i) places.emplace_back(-3 + 6.0 * i / cuts, 0);
  return chain(places);
}

Scene square(const Vector2& centre, Real angle, Real damping_ratio = 0, Real friction = 0) {
  Scene scene;
  scene.contact = {1e8, 5e7, damping_ratio, friction, 1};
  scene.add(OutlineKind::rectangle, centre, 0.5, 0.5, angle);
  return scene;
}

std::unique_ptr<particles::UniformStepper<2>> put(Scene& scene, const Chain& on, Real step = 1e-5) {
  auto stepper = scene.make(step);
  scene.forces->add_surface(stepper->particles(), on.nodes, on.segments);
  return stepper;
}

struct Push {
  std::array<Real, 3> force{};
  Real energy = 0;
};

Push push_on(const Vector2& centre, Real angle, const Chain& on, OutlineKind kind = OutlineKind::rectangle) {
  Scene scene;
  scene.contact = {1e8, 5e7, 0, 0, 1};
  scene.add(kind, centre, 0.5, 0.5, angle);
  auto stepper = put(scene, on);
  stepper->start();
  Push push;
  scene.forces->surface()->add_to(0, push.force);
  push.energy = scene.forces->surface()->elastic_energy();
  return push;
}

TEST(surface_contacts, push_with_the_derivative_of_their_energy) {
  const Real small = 1e-7;
  for (const Real angle : {0.05, 0.4, 0.7, -1.2}) {
    const Real reach = 0.5 * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
    const Vector2 centre(0.23, reach - 0.02);
    const Push here = push_on(centre, angle, level(13));
    ASSERT_GT(here.force[1], 0);
    const auto slope = [&](const Vector2& way, Real turn) {
      const Real after = push_on(centre + small * way, angle + small * turn, level(13)).energy;
      return -(after - push_on(centre - small * way, angle - small * turn, level(13)).energy) / (2 * small);
    };
    EXPECT_NEAR(here.force[0], slope({1, 0}, 0), 1e-5 * here.force[1]);
    EXPECT_NEAR(here.force[1], slope({0, 1}, 0), 1e-5 * here.force[1]);
    EXPECT_NEAR(here.force[2], slope({0, 0}, 1), 1e-5 * here.force[1]);
  }
}

TEST(surface_contacts, do_not_depend_on_where_the_surface_is_cut) {
  for (const OutlineKind kind : {OutlineKind::rectangle, OutlineKind::circle})
    for (const Real angle : {0.0, 0.3}) {
      const Vector2 centre(0.1, kind == OutlineKind::circle || angle == 0 ? 0.49 : 0.61);
      const Push one = push_on(centre, angle, level(1), kind);
      ASSERT_GT(one.force[1], 0);
      for (const int cuts : {6, 13, 60}) {
        const Push many = push_on(centre, angle, level(cuts), kind);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(many.force[i], one.force[i], 1e-9 * one.force[1]) << cuts;
        EXPECT_NEAR(many.energy, one.energy, 1e-9 * one.energy);
      }
    }
}

TEST(surface_contacts, a_square_lies_as_deep_as_on_a_wall) {
  Scene on_wall = square({0, 0.499}, 0);
  on_wall.add_wall({-3, 0}, {3, 0});
  auto stepper = on_wall.make(1e-5);
  stepper->start();
  const Push push = push_on({0, 0.499}, 0, level(7));
  EXPECT_NEAR(push.force[1], -on_wall.forces->support_force(0)[1], 1e-9 * push.force[1]);
}

TEST(surface_contacts, give_the_nodes_the_force_and_the_moment_that_elements_get_turned_round) {
  Scene scene = square({0.1, 0.55}, 0.3, 0.2, 0.4);
  auto stepper = put(scene, chain({{-2, 0.3}, {-0.3, 0.02}, {0.4, 0}, {2, 0.2}}));
  stepper->start();
  scene.forces->lead({{-2, 0.3, 0}, {-0.3, 0.02, 0}, {0.4, 0, 0}, {2, 0.2, 0}}, std::vector<Vector3>(4, {0.5, 0.7, 0}));
  for (int step = 0; step < 20; ++step) stepper->advance();
  std::array<Real, 3> on_element{};
  scene.forces->surface()->add_to(0, on_element);
  Vector2 sum = Vector2::Zero();
  Real moment = 0;
  const auto& nodes = scene.forces->surface()->nodes();
  const Vector2 centre(stepper->particles().position(0, 0), stepper->particles().position(1, 0));
  for (Index node = 0; node < 4; ++node) {
    const Vector2 force = nodes.force()[static_cast<std::size_t>(node)].head<2>();
    const Vector2 arm = Vector2(nodes.place(node, 20 * 1e-5).head<2>()) - centre;
    sum += force;
    moment += arm.x() * force.y() - arm.y() * force.x();
  }
  ASSERT_GT(on_element[1], 0);
  EXPECT_NE(on_element[0], 0);
  EXPECT_NEAR(sum.x(), -on_element[0], 1e-12 * on_element[1]);
  EXPECT_NEAR(sum.y(), -on_element[1], 1e-12 * on_element[1]);
  EXPECT_NEAR(moment, -on_element[2], 1e-11 * on_element[1]);
}

TEST(surface_contacts, a_block_beyond_an_edge_is_not_pushed_off_it) {
  const Chain ledge = chain({{-3, 0}, {0, 0}, {0, -3}});
  for (const Real beyond : {0.05, 0.45, 0.9}) {  // of its width of 1 m
    const Push push = push_on({beyond - 0.5, 0.499}, 0, ledge);
    EXPECT_NEAR(push.force[0], 0, 1e-9) << beyond;
    EXPECT_NEAR(push.force[1], 2e8 * (1 - beyond) * 0.001, 1e-3) << beyond;
  }
}

TEST(surface_contacts, hold_in_a_corner_on_both_sides) {
  const Push push = push_on({0.499, 0.498}, 0, chain({{0, 3}, {0, 0}, {3, 0}}));
  EXPECT_NEAR(push.force[0], 2e8 * 0.001 * 0.998, 1e3);
  EXPECT_NEAR(push.force[1], 2e8 * 0.002 * 0.999, 1e3);
}

TEST(surface_contacts, a_block_slides_down_a_slope_as_coulomb_says) {
  const Real slope = 0.7, friction = 0.5;
  Scene scene = square({0, 0.5}, 0, 1, friction);
  scene.supports.gravity = 9.81 * Vector2(std::sin(slope), -std::cos(slope));
  auto stepper = put(scene, level(17), 2e-5);
  stepper->start();
  while (stepper->time() < 0.2) stepper->advance();  // until it has settled
  const Real time = stepper->time(), place = stepper->particles().displacement[0][0], velocity = stepper->velocity()[0][0];
  while (stepper->time() < 0.6) stepper->advance();
  const Real after = stepper->time() - time, exact = 0.5 * 9.81 * (std::sin(slope) - friction * std::cos(slope)) * after * after;
  EXPECT_NEAR(stepper->particles().displacement[0][0] - place - velocity * after, exact, 1e-4 * exact);
  // Friction turns it until it stands on 3 (1/2 - mu/2) of its side of 1 m, with a triangle of pressure.
  const Real normal_force = 2000 * 9.81 * std::cos(slope), side = 3 * (0.5 - 0.5 * friction);
  const Real turned = 2 * normal_force / (2e8 * side * side);
  EXPECT_NEAR(-stepper->particles().angle[0], turned, 1e-3 * turned);
}

/// A block and a cylinder on a surface that is thrown up and down.
struct Shaken {
  Scene scene;
  std::unique_ptr<particles::UniformStepper<2>> stepper;
  Chain ground = level(9);
  Real height = 0;

  Shaken() {
    scene.contact = {1e8, 1e8, 0.05, 0.5, 1};
    scene.add(OutlineKind::rectangle, {0, 0.7}, 0.5, 0.3, 0.4);
    scene.add(OutlineKind::circle, {-1.2, 0.45}, 0.4, 0.4, 0, 1);
    scene.supports.gravity = {0, -9.81};
    stepper = put(scene, ground);
  }

  void window(int number) {
    const Real speed = 0.5 * std::cos(0.3 * number);
    std::vector<Vector3> from = ground.nodes;
    for (Vector3& node : from) node.y() += height;
    scene.forces->lead(from, std::vector<Vector3>(from.size(), {0.2, speed, 0}));
    for (int step = 0; step < 100; ++step) stepper->advance();
    for (Vector3& node : ground.nodes) node.x() += 100 * 1e-5 * 0.2;
    height += 100 * 1e-5 * speed;
  }

  Real energy() {
    Real total = stepper->kinetic_energy();
    const auto& particles = stepper->particles();
    for (std::size_t i = 0; i < 2; ++i) total += 9.81 / particles.inverse_mass[i] * particles.position(1, i);
    const EnergyParts energies = scene.forces->energy_parts(particles);
    return total + energies.elastic + energies.lost() - energies.surface;
  }
};

TEST(surface_contacts, what_is_thrown_about_closes_its_energy_balance) {
  Shaken shaken;
  shaken.stepper->start();
  const Real before = shaken.energy();
  for (int number = 0; number < 400; ++number) shaken.window(number);
  const EnergyParts energies = shaken.scene.forces->energy_parts(shaken.stepper->particles());
  EXPECT_GT(std::abs(energies.surface), 0.02 * before);
  EXPECT_GT(energies.contacts.friction, 0);
  EXPECT_NEAR(shaken.energy(), before, 2e-3 * before);
}

TEST(surface_contacts, give_the_same_bits_after_a_checkpoint_and_with_several_threads) {
  Shaken whole, first;
  whole.stepper->start();
  first.stepper->start();
  for (int number = 0; number < 30; ++number) first.window(number);
  test::MemoryArchive checkpoint;
  first.stepper->columns(checkpoint);
  checkpoint.turn_round();
  Shaken second;
  second.ground = first.ground;
  second.height = first.height;
  second.stepper->columns(checkpoint);
  for (int number = 30; number < 60; ++number) second.window(number);
  parallel::set_threads(3);
  for (int number = 0; number < 60; ++number) whole.window(number);
  parallel::set_threads(1);
  test::MemoryArchive one, other;
  whole.stepper->columns(one);
  second.stepper->columns(other);
  EXPECT_TRUE(one == other);
}

}  // namespace
}  // namespace sazare::methods::rectangles
