#include "sazare/methods/rectangles/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sazare/geometry/plane/voronoi.hpp"
#include "sazare/methods/rectangles/stable_step.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::rectangles {
namespace {

using geometry::Vector2;
using test::Scene;
constexpr Real step = 1e-5, size = 0.1;

std::vector<Vector2> rectangle(Real width, Real height) { return {{0, 0}, {width, 0}, {width, height}, {0, height}}; }

struct Block {
  std::vector<Vector2> nuclei;
  Packing packing;
};

Block block(Real width = 1, Real height = 0.5, int seed = 3) {
  Block made;
  made.nuclei = geometry::scatter_nuclei(rectangle(width, height), size, seed);
  made.packing = pack(made.nuclei, rectangle(width, height), 2000);
  return made;
}

Scene scene_of(const Block& of, Real strength = 1e300, Real damping_ratio = 0, Real shear = 3e7) {
  Scene scene;
  scene.kinds = {test::facets_of(1e8, shear, 3, strength, damping_ratio)};
  scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
  scene.add_packing(of.packing, 0);
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

state::FreedomColumns<2> evaluate(Scene& scene) {
  state::FreedomColumns<2> acceleration;
  for (auto& column : acceleration) column.resize(scene.particles().padded());
  scene.forces->evaluate(scene.particles(), acceleration);
  return acceleration;
}

/// Forces and moments on all elements as they stand.
std::array<std::vector<Real>, 3> forces_of(Scene& scene) {
  const auto stepper = scene.make(step);
  const auto& particles = scene.particles();
  const auto acceleration = evaluate(scene);
  std::array<std::vector<Real>, 3> forces;
  for (std::size_t freedom = 0; freedom < 3; ++freedom)
    for (std::size_t i = 0; i < particles.size(); ++i)
      forces[freedom].push_back(acceleration[freedom][i] / particles.inverse_inertia_of(freedom)[i]);
  return forces;
}

TEST(packing, fills_the_block_with_mass) {
  const Block of = block();
  Scene scene = scene_of(of);
  scene.make(step);
  const auto& particles = scene.particles();
  Real mass = 0, moment = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    mass += 1 / particles.inverse_mass[i];
    moment += 1 / particles.inverse_inertia[i] +
              (std::pow(particles.start[0][i] - 0.5, 2) + std::pow(particles.start[1][i] - 0.25, 2)) / particles.inverse_mass[i];
  }
  EXPECT_NEAR(mass, 1000, 1e-8);
  EXPECT_NEAR(moment, 1000 * (1 + 0.25) / 12, 1e-8);
}

/// With k_s = k_n the elements that move as their nuclei in a uniform strain bear a uniform stress k e: nothing is left on an
/// element inside, and on one at the edge what the stress gives on its part of the edge.
TEST(packing, bears_a_uniform_strain_exactly) {
  const Block of = block();
  const std::array<Real, 3> strains[] = {{1e-7, 0, 0}, {0, 1e-7, 0}, {0, 0, 1e-7}, {2e-7, -1e-7, 3e-7}};
  for (const auto& [xx, yy, xy] : strains) {
    Scene scene = scene_of(of, 1e300, 0, 1e8);
    scene.make(step);
    for (std::size_t i = 0; i < of.nuclei.size(); ++i) {
      scene.particles().displacement[0][i] = xx * of.nuclei[i].x() + xy * of.nuclei[i].y();
      scene.particles().displacement[1][i] = xy * of.nuclei[i].x() + yy * of.nuclei[i].y();
    }
    const auto forces = forces_of(scene);
    Scene unloaded = scene_of(of);
    const auto holder = unloaded.make(step);
    const auto& outlines = unloaded.forces->outlines();
    for (std::size_t i = 0; i < of.nuclei.size(); ++i) {
      Vector2 expected = Vector2::Zero();
      Real moment = 0;
      const auto outline = outlines.at(unloaded.particles(), i);
      for (int side = 0; side < geometry::face_count(outline); ++side) {
        if (!geometry::is_exposed(outline, side)) continue;
        const geometry::Face face = geometry::face_of(outline, side);
        const Vector2 load = 2 * face.half * 1e8 *
                             Vector2(xx * face.normal.x() + xy * face.normal.y(), xy * face.normal.x() + yy * face.normal.y());
        const Vector2 arm = face.centre - outline.centre;
        expected -= load;
        moment -= arm.x() * load.y() - arm.y() * load.x();
      }
      EXPECT_NEAR(forces[0][i], expected.x(), 1e-7) << i;  // of some 1 N
      EXPECT_NEAR(forces[1][i], expected.y(), 1e-7) << i;
      EXPECT_NEAR(forces[2][i], moment, 1e-7) << i;
    }
  }
}

TEST(packing, does_not_feel_a_rotation_as_a_whole) {
  const Block of = block();
  Scene scene = scene_of(of);
  scene.make(step);
  auto& particles = scene.particles();
  const Real c = std::cos(0.7), s = std::sin(0.7);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Real x = particles.start[0][i], y = particles.start[1][i];
    particles.displacement[0][i] = c * x - s * y - x + 0.3;
    particles.displacement[1][i] = s * x + c * y - y - 0.1;
    particles.angle[i] = 0.7;
    particles.rotation[0][i] = c;
    particles.rotation[1][i] = s;
  }
  for (const auto& column : forces_of(scene))
    for (const Real force : column) EXPECT_NEAR(force, 0, 1e-6);  // stiffness 1e8
}

TEST(packing, keeps_momentum_and_energy) {
  Scene scene = scene_of(block());
  set_in_motion(scene);
  auto stepper = scene.make(step);
  stepper->start();
  const auto momentum = [&](std::size_t axis) {
    Real sum = 0;
    for (std::size_t i = 0; i < stepper->particles().size(); ++i)
      sum += stepper->particles().velocity[axis][i] / stepper->particles().inverse_mass[i];
    return sum;
  };
  const Real x = momentum(0), y = momentum(1), energy = stepper->kinetic_energy() + stepper->elastic_energy();
  Real worst = 0;
  for (int i = 0; i < 20000; ++i) {
    stepper->advance();
    if (i % 100 == 0) worst = std::max(worst, std::abs(stepper->kinetic_energy() + stepper->elastic_energy() - energy));
  }
  EXPECT_GT(std::abs(stepper->particles().angle[0]), 0.5);
  EXPECT_NEAR(momentum(0), x, 1e-8);
  EXPECT_NEAR(momentum(1), y, 1e-8);
  EXPECT_LT(worst, 2e-3 * energy);
}

Scene breaking() {
  Scene scene = scene_of(block(), 2e4, 0.1);
  set_in_motion(scene, 4);
  return scene;
}

TEST(packing, breaks_and_closes_the_energy_balance) {
  Scene scene = breaking();
  auto stepper = scene.make(step);
  stepper->start();
  const Real energy = stepper->kinetic_energy() + stepper->elastic_energy();
  for (int i = 0; i < 5000; ++i) stepper->advance();
  EXPECT_GT(scene.forces->links().broken_links(), 0);
  EXPECT_GT(scene.forces->contacts().pairs().size(), 0U);
  const EnergyParts energies = scene.forces->energy_parts(stepper->particles());
  EXPECT_GT(energies.links.fracture, 0);
  EXPECT_NEAR(stepper->kinetic_energy() + energies.elastic + energies.lost(), energy, 5e-3 * energy);
}

TEST(packing, goes_on_from_a_checkpoint_with_the_same_bits) {
  Scene scene = breaking(), resumed_scene = breaking();
  auto whole = scene.make(step);
  whole->start();
  for (int i = 0; i < 3000; ++i) whole->advance();
  test::MemoryArchive archive;
  whole->columns(archive);
  archive.turn_round();
  auto resumed = resumed_scene.make(step);
  resumed->columns(archive);
  for (int i = 0; i < 1000; ++i) {
    whole->advance();
    resumed->advance();
  }
  for (std::size_t freedom = 0; freedom < 3; ++freedom)
    EXPECT_EQ(whole->particles().velocity[freedom], resumed->particles().velocity[freedom]);
}

TEST(packing, stable_step_is_the_limit) {
  const Block of = block();
  const auto grows = [&](Real factor) {
    Scene scene = scene_of(of);
    const auto holder = scene.make(1);
    const StableStep limit =
        stable_step(scene.particles(), scene.forces->outlines(), scene.forces->links(), scene.contact, false);
    Real& kick = scene.particles().velocity[0][7];
    kick = 1e-6;
    auto stepper = scene.make(factor * limit.limit);
    stepper->start();
    const Real most = 1e3 * 0.5 * 1e-12 * 2000 * size * size;
    for (int i = 0; i < 3000 && stepper->kinetic_energy() < most; ++i) stepper->advance();
    return stepper->kinetic_energy() >= most;
  };
  EXPECT_FALSE(grows(0.99));
  EXPECT_TRUE(grows(1.02));
}

TEST(packing, stiffnesses_are_those_of_a_lattice_without_poisson_s_ratio) {
  const FacetStiffness none = facet_stiffness(3e9, 0);
  EXPECT_DOUBLE_EQ(none.normal, 3e9);
  EXPECT_DOUBLE_EQ(none.shear, 3e9);
  const FacetStiffness most = facet_stiffness(3e9, 0.25);
  EXPECT_NEAR(most.shear, 0, 1);
  const FacetStiffness some = facet_stiffness(1, 0.2);  // mu = 1/2.4, lambda = 1/3.6
  EXPECT_NEAR(some.normal, 2 * (1 / 2.4 + 1 / 3.6), 1e-15);
  EXPECT_NEAR(some.shear, 2 * (1 / 2.4 - 1 / 3.6), 1e-15);
}

/// The sides of a crack press on one another though both elements hold on to a third.
TEST(packing, sides_of_a_crack_meet_again) {
  const std::vector<Vector2> nuclei = {{0.25, 0.25}, {0.75, 0.25}, {0.5, 0.75}};
  const Packing packing = pack(nuclei, rectangle(1, 1), 2000);
  ASSERT_EQ(packing.facets.size(), 3U);
  Scene scene;
  scene.kinds = {test::facets_of(1e8, 3e7, 3, 2e5)};
  scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
  scene.add_packing(packing, 0);
  const auto stepper = scene.make(step);
  const auto move = [&](Real way) {
    scene.particles().displacement[0][0] = -way;
    scene.particles().displacement[0][1] = way;
  };
  evaluate(scene);
  EXPECT_EQ(scene.forces->outlines().exposed[0], packing.outside[0]);
  move(1e-3);  // stresses of 4e5 Pa between the first two, and 8e4 Pa to the third
  evaluate(scene);
  EXPECT_EQ(scene.forces->links().broken_links(), 1);
  EXPECT_NE(scene.forces->outlines().exposed[0], packing.outside[0]);
  EXPECT_EQ(scene.forces->contacts().touching(), 0);
  move(-1e-3);
  const auto acceleration = evaluate(scene);
  EXPECT_EQ(scene.forces->contacts().touching(), 1);
  EXPECT_LT(acceleration[0][0], 0);
  EXPECT_GT(acceleration[0][1], 0);
}

TEST(packing, same_bits_with_any_number_of_threads) {
  std::vector<state::Column> found;
  const Block of = block(6, 4);
  for (const int threads : {1, 2, 3}) {
    parallel::set_threads(threads);
    Scene scene = scene_of(of, 2e4, 0.1);
    set_in_motion(scene, 0.5);
    auto stepper = scene.make(step);
    stepper->start();
    for (int i = 0; i < 100; ++i) stepper->advance();
    EXPECT_GT(scene.forces->links().broken_springs(), 10);
    found.push_back(stepper->particles().velocity[1]);
  }
  parallel::set_threads(0);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

}  // namespace
}  // namespace sazare::methods::rectangles
