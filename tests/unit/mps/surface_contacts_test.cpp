#include "sazare/methods/mps/surface_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/mps/ground_at_surface.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/particles/uniform_stepper.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

constexpr Real spacing = 0.5;
const std::vector<WaveVelocities> waves(16, {Soil{}.p_wave_velocity, Soil{}.s_wave_velocity});  // of more than any test has

/// A surface of triangles.
struct Surface {
  std::vector<Vector3> nodes;
  std::vector<std::array<Index, 3>> faces;
};

/// Strips along z through these points of the plane, wider than the particles.
Surface strips(const std::vector<Vector<2>>& line) {
  Surface surface;
  const auto count = static_cast<Index>(line.size());
  for (const Real z : {-4 * spacing, 4 * spacing})
    for (const auto& point : line) surface.nodes.emplace_back(point.x(), point.y(), z);
  for (Index i = 0; i + 1 < count; ++i) {
    surface.faces.push_back({i, i + 1 + count, i + 1});
    surface.faces.push_back({i, i + count, i + 1 + count});
  }
  return surface;
}

/// A line with a groove and a ridge.
Surface uneven() { return strips({{-5, 0.1}, {-0.3, 0.02}, {0.2, -0.06}, {0.6, 0.05}, {1.1, -0.04}, {6, 0.0}}); }

/// A plane through the origin that falls by this angle towards x.
Surface incline(Real angle) {
  const Real far = 30;
  return strips({{-far * std::cos(angle), far * std::sin(angle)}, {far * std::cos(angle), -far * std::sin(angle)}});
}

template <int D>
state::FreedomColumns<D> zero(const state::Particles<D>& particles) {
  state::FreedomColumns<D> columns;
  for (auto& column : columns) column.assign(particles.padded(), 0);
  return columns;
}

/// A row of single particles above the surface, moved down into it at random once it is known to be clear of them.
template <int D>
void expect_the_force_is_the_slope_of_the_energy() {
  Site<D> counts;
  counts.fill(1);
  counts[0] = 4;
  auto particles = make_particles<D>(box_sites<D>(counts), spacing, {});
  const auto lift = [&](Real by) {
    for (std::size_t i = 0; i < particles.size(); ++i) particles.displacement[1][i] = by;
  };
  const Surface surface = uneven();
  SurfaceContacts<D> contacts(particles, waves, {.step = 1e-4}, surface.nodes, surface.faces);
  if constexpr (D == 3)
    for (std::size_t i = 0; i < particles.size(); ++i) particles.displacement[2][i] = -0.5 * spacing;
  const auto linked = [](Index) { return true; };
  auto acceleration = zero<D>(particles);
  lift(0.25 * spacing);
  contacts.evaluate(particles, linked);
  contacts.add_forces(1, acceleration);
  Noise noise;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t axis = 0; axis < 2; ++axis) particles.displacement[axis][i] = (axis == 1 ? -0.06 : 0) + 0.05 * noise();
  const auto energy_with = [&](std::size_t i, std::size_t axis, Real by) {
    particles.displacement[axis][i] += by;
    contacts.evaluate(particles, linked);
    particles.displacement[axis][i] -= by;
    return contacts.energy();
  };
  acceleration = zero<D>(particles);
  contacts.evaluate(particles, linked);
  contacts.add_forces(1, acceleration);
  ASSERT_EQ(contacts.touching(), 4);
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      constexpr Real by = 1e-6;
      const Real slope = (energy_with(i, axis, by) - energy_with(i, axis, -by)) / (2 * by);
      const Real force = acceleration[axis][i] / particles.inverse_mass[i];
      EXPECT_NEAR(force, -slope, 1e-6 * std::abs(force) + 1);
    }
}

TEST(ground_on_a_surface, is_pushed_by_the_slope_of_an_energy) {
  expect_the_force_is_the_slope_of_the_energy<2>();
  expect_the_force_is_the_slope_of_the_energy<3>();
}

/// A block of linked ground, turned and put on a surface.
struct Sledge {
  Sledge(const Surface& surface, Real angle, const SurfaceRules& given, Vector<2> gravity, Real damping_ratio = 0)
      : rules(given) {
    const auto sites = box_sites<2>({4, 2});
    particles = make_particles<2>(sites, spacing, {.damping_ratio = damping_ratio});
    const Real cosine = std::cos(angle), sine = std::sin(angle);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Real x = particles.start[0][i], y = particles.start[1][i];
      particles.displacement[0][i] = cosine * x + sine * y - x;
      particles.displacement[1][i] = cosine * y - sine * x - y;
      particles.angle[i] = -angle;
      particles.rotation[0][i] = cosine;
      particles.rotation[1][i] = -sine;
    }
    auto links = make_links<2>(sites, spacing, 1.5);
    particles::ParticleSupports<2> supports;
    supports.gravity = gravity;
    auto own = std::make_unique<GroundAtSurface<2>>(std::make_unique<ElasticForces<2>>(links, RotationRemoval::mean_rotation),
                                                    nullptr, waves, rules);
    forces = own.get();
    forces->attach(particles, surface.nodes, surface.faces);
    stepper = std::make_unique<particles::UniformStepper<2>>(
        particles, std::move(own), supports,
        particles::UniformRules{.step = rules.step, .damping = laws::RayleighDamping::make(5, 50)});
  }

  Vector<2> mean_velocity() const {
    const auto velocity = stepper->velocity();
    Vector<2> sum = Vector<2>::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i) sum += Vector<2>(velocity[0][i], velocity[1][i]);
    return sum / static_cast<Real>(particles.size());
  }
  Real mass() const { return static_cast<Real>(particles.size()) / particles.inverse_mass[0]; }
  Real unbalanced() {
    const auto* touched = forces->surface();
    return stepper->kinetic_energy_of_kick() + stepper->elastic_energy() + touched->dissipated() - touched->work() -
           stepper->work().sum();
  }

  SurfaceRules rules;
  state::Particles<2> particles;
  GroundAtSurface<2>* forces = nullptr;
  std::unique_ptr<particles::UniformStepper<2>> stepper;
};

/// After the bounces with which it begins.
TEST(ground_on_a_surface, slides_down_an_incline_as_coulomb_says) {
  constexpr Real angle = 30 * std::numbers::pi / 180, gravity = 9.81, friction = 0.3, seconds = 0.5;
  Sledge sledge(incline(angle), angle, {2e-4, 0.3, friction}, {0, -gravity});
  sledge.stepper->start();
  while (sledge.stepper->time() < seconds) sledge.stepper->advance();
  const Real before = sledge.mean_velocity().norm();
  while (sledge.stepper->time() < 2 * seconds) sledge.stepper->advance();
  const Real expected = gravity * (std::sin(angle) - friction * std::cos(angle)) * seconds;
  EXPECT_NEAR(sledge.mean_velocity().norm() - before, expected, 0.005 * expected);
}

TEST(ground_on_a_surface, rests_where_friction_holds_it) {
  constexpr Real angle = 20 * std::numbers::pi / 180;
  Sledge sledge(incline(angle), angle, {2e-4, 0.3, 0.5}, {0, -9.81}, 0.2);
  sledge.stepper->start();
  while (sledge.stepper->time() < 1) sledge.stepper->advance();
  const auto before = sledge.stepper->particles().displacement;
  while (sledge.stepper->time() < 2) sledge.stepper->advance();
  const auto& after = sledge.stepper->particles().displacement;
  EXPECT_LT(std::hypot(after[0][0] - before[0][0], after[1][0] - before[1][0]), 1e-6);
  EXPECT_LT(sledge.mean_velocity().norm(), 1e-4);
}

/// Onto an uneven surface whose nodes move, with friction and dashpots.
Sledge thrown(Real friction, Real damping_ratio, Real step) {
  Sledge sledge(uneven(), 0, {step, damping_ratio, friction}, {1, -20});
  auto start = sledge.stepper->particles();
  sledge.stepper->start();
  return sledge;
}

void move_nodes(Sledge& sledge, const Vector3& velocity) {
  const auto& nodes = sledge.forces->surface()->nodes();
  std::vector<Vector3> from, with(nodes.node_count(), velocity);
  for (std::size_t node = 0; node < nodes.node_count(); ++node) from.push_back(uneven().nodes[node]);
  sledge.forces->lead(from, with);
}

TEST(ground_on_a_surface, loses_the_momentum_that_the_nodes_get) {
  Sledge sledge = thrown(0.4, 0.2, 1e-4);
  move_nodes(sledge, {0.3, 0.2, 0});
  const Vector<2> before = sledge.mean_velocity();
  constexpr int steps = 3000;
  for (int n = 0; n < steps; ++n) sledge.stepper->advance();
  Vector3 given = Vector3::Zero();
  for (const Vector3& impulse : sledge.forces->surface()->nodes().impulse()) given += impulse;
  const Vector<2> gained = sledge.mass() * (sledge.mean_velocity() - before - steps * 1e-4 * Vector<2>(1, -20));
  ASSERT_GT(given.norm(), 1000);
  EXPECT_LT((given.head<2>() + gained).norm(), 1e-10 * given.norm());
}

TEST(ground_on_a_surface, balances_its_energy_to_second_order) {
  for (const Real friction : {0.0, 0.4}) {
    std::vector<Real> off;
    for (const Real step : {2e-4, 1e-4}) {
      Sledge sledge = thrown(friction, 0, step);
      move_nodes(sledge, {0.3, 0.2, 0});
      const Real start = sledge.unbalanced();
      Real most = 0;
      while (sledge.stepper->time() < 0.3) {
        sledge.stepper->advance();
        most = std::max(most, std::abs(sledge.unbalanced() - start));
      }
      off.push_back(most / std::abs(sledge.forces->surface()->work()));
    }
    EXPECT_LT(off[1], 2e-4);
    EXPECT_LT(off[1], 0.5 * off[0]);
  }
}

TEST(ground_on_a_surface, is_not_turned_where_it_is_broken) {
  auto particles = make_particles<2>(box_sites<2>({1, 1}), spacing, {});
  const Surface surface = strips({{-5, 0}, {5, 0}});
  SurfaceContacts<2> contacts(particles, waves, {.step = 1e-4, .friction = 0.5}, surface.nodes, surface.faces);
  particles.displacement[1][0] = 0.01;
  for (const bool is_linked : {true, false}) {
    auto acceleration = zero<2>(particles);
    const auto linked = [&](Index) { return is_linked; };
    particles.displacement[1][0] = 0.01;
    contacts.evaluate(particles, linked);
    contacts.add_forces(1, acceleration);
    particles.displacement[1][0] = -0.01;
    particles.velocity[0][0] = 1;
    acceleration = zero<2>(particles);
    contacts.evaluate(particles, linked);
    contacts.add_forces(1, acceleration);
    EXPECT_LT(acceleration[0][0], 0);
    if (is_linked) {
      EXPECT_LT(acceleration[2][0], 0);  // the foot is held back
    } else {
      EXPECT_EQ(acceleration[2][0], 0);
    }
  }
}

test::MemoryArchive after(int steps) {
  Sledge sledge = thrown(0.4, 0.2, 1e-4);
  move_nodes(sledge, {0.3, 0.2, 0});
  for (int n = 0; n < steps; ++n) sledge.stepper->advance();
  test::MemoryArchive archive;
  sledge.stepper->columns(archive);
  return archive;
}

TEST(ground_on_a_surface, goes_on_from_a_checkpoint_and_with_more_threads_as_if_nothing_had_been) {
  auto checkpoint = after(1500);
  checkpoint.turn_round();
  Sledge resumed(uneven(), 0, {1e-4, 0.2, 0.4}, {1, -20});
  resumed.stepper->columns(checkpoint);
  for (int n = 0; n < 1500; ++n) resumed.stepper->advance();
  test::MemoryArchive archive;
  resumed.stepper->columns(archive);
  parallel::set_threads(2);
  const auto whole = after(3000);
  parallel::set_threads(1);
  EXPECT_TRUE(archive == whole);
}

}  // namespace
}  // namespace sazare::methods::mps
