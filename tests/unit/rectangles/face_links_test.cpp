#include "sazare/methods/rectangles/face_links.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::rectangles {
namespace {

using laws::FaceFormula;
using test::Scene;
constexpr Real radius = 0.05, step = 1e-5;

/// A free bar of squares that bends and turns.
Scene bar(FaceFormula formula, Real damping_ratio = 0, Real strength = 1e300, int count = 3) {
  Scene scene;
  const Real mass = 4 * radius * radius * scene.density;
  scene.kinds = {test::square_faces(radius, 1e8, 3e7, count, formula, damping_ratio, mass)};
  scene.kinds[0].springs.tension_limit = scene.kinds[0].springs.cohesion_limit = strength;
  scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
  scene.add_lattice(8, 3, radius, {0, 0}, 0);
  return scene;
}

/// Turning, stretching and bending.
void set_in_motion(Scene& scene, Real speed = 1) {
  scene.make(step);  // completes the particles
  auto& particles = scene.particles();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Real x = particles.start[0][i], y = particles.start[1][i];
    particles.velocity[0][i] = speed * (-3 * y + 4 * x * x);
    particles.velocity[1][i] = speed * (3 * x - 5 * y * y);
    particles.velocity[2][i] = speed * 3;
  }
}

struct Sums {
  Real x = 0, y = 0, angular = 0;
};

Sums momentum(const state::Particles<2>& particles) {
  Sums sums;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.inverse_mass[i] == 0) continue;
    const Real mass = 1 / particles.inverse_mass[i];
    const auto& v = particles.velocity;
    sums.x += mass * v[0][i];
    sums.y += mass * v[1][i];
    sums.angular +=
        mass * (particles.position(0, i) * v[1][i] - particles.position(1, i) * v[0][i]) + v[2][i] / particles.inverse_inertia[i];
  }
  return sums;
}

TEST(face_links, keep_momentum_and_energy_of_a_free_bar) {
  for (const FaceFormula formula : {FaceFormula::exact, FaceFormula::small}) {
    Scene scene = bar(formula);
    set_in_motion(scene);
    auto stepper = scene.make(step);
    stepper->start();
    const Sums before = momentum(stepper->particles());
    const Real energy = stepper->kinetic_energy() + stepper->elastic_energy();
    Real worst = 0;
    for (int i = 0; i < 20000; ++i) {
      stepper->advance();
      if (i % 100 == 0) worst = std::max(worst, std::abs(stepper->kinetic_energy() + stepper->elastic_energy() - energy));
    }
    const Sums after = momentum(stepper->particles());
    EXPECT_GT(std::abs(stepper->particles().angle[0]), 0.5);
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);
    EXPECT_NEAR(after.angular, before.angular,
                1e-4 * before.angular);  // the leapfrog's velocities stand half a step beside its places
    EXPECT_LT(worst, 2e-3 * energy);
  }
}

TEST(face_links, damped_bar_closes_its_energy_balance) {
  Scene scene = bar(FaceFormula::small, 0.3);
  set_in_motion(scene);
  auto stepper = scene.make(step);
  stepper->start();
  const Real energy = stepper->kinetic_energy() + stepper->elastic_energy();
  for (int i = 0; i < 5000; ++i) stepper->advance();
  const EnergyParts energies = scene.forces->energy_parts(stepper->particles());
  EXPECT_GT(energies.links.dashpot, 0.01 * energy);
  EXPECT_NEAR(stepper->kinetic_energy() + energies.elastic + energies.links.dashpot, energy, 2e-3 * energy);
}

TEST(face_links, a_bar_in_tension_stretches_as_its_springs) {
  // A row of two columns, held left and pulled right by gravity along x.
  Scene scene;
  const Real mass = 4 * radius * radius * scene.density;
  scene.kinds = {test::square_faces(radius, 1e8, 3e7, 2, FaceFormula::exact, 0.5, mass)};
  scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
  scene.add_lattice(4, 1, radius, {0, 0}, 0);
  for (int freedom = 0; freedom < 3; ++freedom) scene.supports.held.push_back({0, freedom});
  scene.supports.gravity = {10, 0};
  auto stepper = scene.make(step);
  stepper->start();
  for (int i = 0; i < 40000; ++i) stepper->advance();
  EXPECT_NEAR(stepper->particles().displacement[0][3], (3 + 2 + 1) * mass * 10 / 1e8, 1e-6 * 6 * mass * 10 / 1e8);
}

/// The ordinary circular element in two loops: springs along and across the line of centres, the latter by increments.
struct PlainCircles {
  struct Circle {
    Real x, y, angle, vx, vy, spin;
  };
  struct Pair {
    std::size_t first, second;
    Real shear = 0;
  };
  Real radius, mass, normal, shear;
  std::vector<Circle> circles;
  std::vector<Pair> pairs;

  void step(Real dt, bool begin) {
    std::vector<std::array<Real, 3>> force(circles.size());
    for (Pair& pair : pairs) {
      const Circle &a = circles[pair.first], &b = circles[pair.second];
      const Real distance = std::hypot(b.x - a.x, b.y - a.y), nx = (b.x - a.x) / distance, ny = (b.y - a.y) / distance;
      const Real rate = ny * (a.vx - b.vx) - nx * (a.vy - b.vy) - radius * (a.spin + b.spin);
      pair.shear += begin ? 0 : shear * dt * rate;
      const Real pressure = normal * (2 * radius - distance);
      const Real fx = pressure * nx + pair.shear * ny, fy = pressure * ny - pair.shear * nx;
      force[pair.first][0] -= fx;
      force[pair.first][1] -= fy;
      force[pair.second][0] += fx;
      force[pair.second][1] += fy;
      force[pair.first][2] += radius * pair.shear;
      force[pair.second][2] += radius * pair.shear;
    }
    for (std::size_t i = 0; i < circles.size(); ++i) {
      Circle& c = circles[i];
      const Real half = begin ? 0.5 : 1, inertia = 0.5 * mass * radius * radius;
      c.vx += half * dt * force[i][0] / mass;
      c.vy += half * dt * force[i][1] / mass;
      c.spin += half * dt * force[i][2] / inertia;
      c.x += dt * c.vx;
      c.y += dt * c.vy;
      c.angle += dt * c.spin;
    }
  }
};

TEST(face_links, circles_with_one_spring_are_ordinary_circular_elements) {
  Scene scene;
  const Real mass = std::numbers::pi * radius * radius * scene.density;
  scene.kinds = {test::square_faces(radius, 1e8, 3e7, 1, FaceFormula::small, 0, mass)};
  scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
  PlainCircles plain{radius, mass, 1e8, 3e7, {}, {}};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const Real x = 2 * radius * column, y = 2 * radius * row;
      const Index own = scene.add(geometry::OutlineKind::circle, {x, y}, radius, radius);
      plain.circles.push_back({x, y, 0, 0.01 * (y + 0.1), 0.02 * x * x, 0.05});
      const auto at = static_cast<std::size_t>(own);
      if (column > 0) scene.link(own - 1, own, 0, 0), plain.pairs.push_back({at - 1, at});
      if (row > 0) scene.link(own - 3, own, 1, 0), plain.pairs.push_back({at - 3, at});
    }
  scene.make(step);
  auto& particles = scene.particles();
  for (std::size_t i = 0; i < plain.circles.size(); ++i) {
    particles.velocity[0][i] = plain.circles[i].vx;
    particles.velocity[1][i] = plain.circles[i].vy;
    particles.velocity[2][i] = plain.circles[i].spin;
  }
  auto stepper = scene.make(step);
  stepper->start();
  for (int i = 0; i < 1000; ++i) {
    stepper->advance();
    plain.step(step, i == 0);
  }
  for (std::size_t i = 0; i < plain.circles.size(); ++i) {  // but for the arm of the shear force, half of the distance here
    EXPECT_NEAR(stepper->particles().position(0, i), plain.circles[i].x, 1e-9);
    EXPECT_NEAR(stepper->particles().position(1, i), plain.circles[i].y, 1e-9);
    EXPECT_NEAR(stepper->particles().angle[i], plain.circles[i].angle, 1e-7);
    EXPECT_GT(std::abs(plain.circles[i].angle), 1e-5);
  }
}

/// A bar that breaks where it is struck.
Scene breaking_bar() {
  Scene scene = bar(FaceFormula::small, 0.1, 2e3);
  set_in_motion(scene, 8);
  return scene;
}

TEST(face_links, break_and_open_and_close_the_energy_balance) {
  Scene scene = breaking_bar();
  auto stepper = scene.make(step);
  stepper->start();
  const Real energy = stepper->kinetic_energy() + stepper->elastic_energy();
  for (int i = 0; i < 5000; ++i) stepper->advance();
  EXPECT_GT(scene.forces->links().broken_links(), 0);
  EXPECT_GT(scene.forces->links().broken_springs(), 0);
  const EnergyParts energies = scene.forces->energy_parts(stepper->particles());
  EXPECT_GT(energies.links.fracture, 0);
  EXPECT_NEAR(stepper->kinetic_energy() + energies.elastic + energies.lost(), energy, 5e-3 * energy);
}

TEST(face_links, same_bits_with_any_number_of_threads) {
  std::vector<state::Column> found;
  for (const int threads : {1, 2, 3}) {
    parallel::set_threads(threads);
    Scene scene;
    scene.kinds = {test::square_faces(radius, 1e8, 3e7, 3, FaceFormula::small, 0.1, 20)};
    scene.kinds[0].springs.tension_limit = scene.kinds[0].springs.cohesion_limit = 3e3;
    scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
    scene.add_lattice(80, 60, radius, {0, 0}, 0);
    set_in_motion(scene, 0.3);
    auto stepper = scene.make(step);
    stepper->start();
    for (int i = 0; i < 200; ++i) stepper->advance();
    EXPECT_GT(scene.forces->links().broken_springs(), 10);
    found.push_back(stepper->particles().velocity[1]);
  }
  parallel::set_threads(0);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

TEST(face_links, go_on_from_a_checkpoint_with_the_same_bits) {
  Scene scene = breaking_bar(), resumed_scene = breaking_bar();
  auto whole = scene.make(step);
  whole->start();
  for (int i = 0; i < 3000; ++i) whole->advance();
  test::MemoryArchive archive;
  whole->columns(archive);
  archive.turn_round();
  auto resumed = resumed_scene.make(step);
  resumed->columns(archive);
  for (int i = 0; i < 3000; ++i) {
    whole->advance();
    resumed->advance();
  }
  for (std::size_t freedom = 0; freedom < 3; ++freedom)
    EXPECT_EQ(whole->particles().velocity[freedom], resumed->particles().velocity[freedom]);
  const EnergyParts one = scene.forces->energy_parts(whole->particles()), other = resumed_scene.forces->energy_parts(resumed->particles());
  EXPECT_EQ(one.links.dashpot, other.links.dashpot);
  EXPECT_EQ(one.links.fracture, other.links.fracture);
}

}  // namespace
}  // namespace sazare::methods::rectangles
