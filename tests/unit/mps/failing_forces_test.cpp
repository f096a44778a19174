#include <gtest/gtest.h>

#include <numbers>

#include "sazare/methods/mps/elastic_forces.hpp"
#include "sazare/methods/mps/failing_forces.hpp"
#include "sazare/particles/uniform_stepper.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

constexpr Real degree = std::numbers::pi / 180;

StrengthOfGround strong_as(const Soil& soil, const laws::MohrCoulomb& law, Real rupture_strain) {
  const Real mu = soil.density * soil.s_wave_velocity * soil.s_wave_velocity;
  return {true, law, {mu, soil.density * soil.p_wave_velocity * soil.p_wave_velocity - 2 * mu}, soil.density, rupture_strain};
}

/// A box of particles of one ground.
template <int D>
struct Box {
  Box(const Site<D>& counts, Real spacing, const StrengthOfGround& ground, const LooseRules& rules = {.step = 1e-4})
      : particles(make_particles<D>(box_sites<D>(counts), spacing, {})),
        links(make_links<D>(box_sites<D>(counts), spacing, 1.5)),
        forces(particles, links, GroundStrength<D>(particles, links, {ground}, std::vector<Index>(particles.size(), 0)), rules) {
    for (auto& column : acceleration) column.assign(particles.padded(), 0);
  }

  void evaluate() { forces.evaluate(particles, acceleration); }

  /// x and then y by these amounts times y, everywhere, and turned with it.
  void shear(Real by) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.displacement[0][i] = by * particles.start[D - 1][i];
      if constexpr (D == 2) {
        particles.rotation[0][i] = std::cos(-0.5 * by);
        particles.rotation[1][i] = std::sin(-0.5 * by);
      }
    }
  }

  state::Particles<D> particles;
  LinkTable<D> links;
  FailingForces<D> forces;
  state::FreedomColumns<D> acceleration;
};

const StrengthOfGround unbreakable = strong_as({}, laws::MohrCoulomb::make(1e12, 0, 0, 1e12), 1);

template <int D>
void expect_elastic_forces() {
  Site<D> counts{};
  counts.fill(4);
  Box<D> box(counts, 0.8, unbreakable);
  Noise noise;
  for (auto& column : box.particles.displacement)
    for (std::size_t i = 0; i < box.particles.size(); ++i) column[i] = 0.05 * noise();
  box.evaluate();
  ElasticForces<D> elastic(box.links, RotationRemoval::mean_rotation);
  auto expected = box.acceleration;
  elastic.evaluate(box.particles, expected);
  for (std::size_t freedom = 0; freedom < expected.size(); ++freedom)
    for (std::size_t i = 0; i < box.particles.size(); ++i)
      EXPECT_NEAR(box.acceleration[freedom][i], expected[freedom][i], 1e-9 * std::abs(expected[freedom][i]) + 1e-9);
  EXPECT_NEAR(box.forces.energy(box.particles), elastic.energy(box.particles), 1e-9 * elastic.energy(box.particles));
}

TEST(failing_forces, are_elastic_below_the_strength) {
  expect_elastic_forces<2>();
  expect_elastic_forces<3>();
}

/// Simple shear without friction: every particle, at corners and edges too, yields at the cohesion.
TEST(failing_forces, flow_at_the_strength_in_every_particle) {
  const Soil soil;
  const Real mu = soil.density * soil.s_wave_velocity * soil.s_wave_velocity;
  Box<2> box({5, 4}, 0.5, strong_as(soil, laws::MohrCoulomb::make(30e3, 0, 0, 1e9), 1));
  constexpr Real sheared = 8e-3;
  box.shear(sheared);
  box.evaluate();
  const Real expected = sheared - 30e3 / mu;
  for (std::size_t i = 0; i < box.particles.size(); ++i)
    EXPECT_NEAR(box.forces.strength().slip()[i], expected, 1e-2 * expected) << i;
  box.evaluate();
  box.evaluate();
  for (std::size_t i = 0; i < box.particles.size(); ++i)
    EXPECT_NEAR(box.forces.strength().slip()[i], expected, 1e-2 * expected) << "again, " << i;
  Box<2> at_limit({5, 4}, 0.5, unbreakable);
  at_limit.shear(30e3 / mu);
  const Real stored = at_limit.forces.energy(at_limit.particles);
  EXPECT_NEAR(box.forces.energy(box.particles), stored, 0.02 * stored);
}

/// What is done on the particles, by the mean of the forces at both ends of every step, is stored or dissipated by flow: at edges too,
/// and with steps in which the ground flows by as much as it bears elastically.
TEST(failing_forces, store_or_dissipate_the_work_done_on_them) {
  Box<2> box({8, 8}, 0.5, strong_as({}, laws::MohrCoulomb::make(30e3, 20 * degree, 0, 5e3), 1));
  const Real mu = unbreakable.elastic.shear_modulus, yields = 30e3 / mu;
  Real done = 0;
  box.shear(0);
  box.evaluate();
  for (int step = 1; step <= 60; ++step) {
    const auto before = box.acceleration;
    const auto was = box.particles;
    box.shear(0.5 * yields * step);
    box.evaluate();
    for (std::size_t i = 0; i < box.particles.size(); ++i) {
      const Real moved = box.particles.displacement[0][i] - was.displacement[0][i];
      done -= 0.5 * (before[0][i] + box.acceleration[0][i]) / box.particles.inverse_mass[i] * moved;
      const Real turned = std::atan2(box.particles.rotation[1][i], box.particles.rotation[0][i]) -
                          std::atan2(was.rotation[1][i], was.rotation[0][i]);
      done -= 0.5 * (before[2][i] + box.acceleration[2][i]) / box.particles.inverse_inertia[i] * turned;
    }
  }
  EXPECT_GT(box.forces.work().flow, 5 * box.forces.energy(box.particles));
  EXPECT_NEAR(box.forces.work().flow + box.forces.energy(box.particles), done, 1e-3 * done);
}

template <int D>
void expect_momenta_kept(const Box<D>& box) {
  Vector<D> force = Vector<D>::Zero();
  Angular<D> torque = Angular<D>::Zero();
  Real size = 0;
  for (std::size_t i = 0; i < box.particles.size(); ++i) {
    Vector<D> own, place;
    for (std::size_t axis = 0; axis < D; ++axis) {
      own[static_cast<int>(axis)] = box.acceleration[axis][i] / box.particles.inverse_mass[i];
      place[static_cast<int>(axis)] = box.particles.position(axis, i);
    }
    force += own;
    torque += moment(place, own);
    for (std::size_t axis = D; axis < box.acceleration.size(); ++axis)
      torque[static_cast<int>(axis - D)] += box.acceleration[axis][i] / box.particles.inverse_inertia[i];
    size += own.norm();
  }
  EXPECT_GT(size, 1);
  EXPECT_LT(force.norm(), 1e-10 * size);
  EXPECT_LT(torque.norm(), 1e-9 * size);
}

/// Crushed until particles break.
template <int D>
void expect_momenta_kept_when_broken() {
  Site<D> counts{};
  counts.fill(4);
  Box<D> box(counts, 0.5, strong_as({}, laws::MohrCoulomb::make(1e3, 20 * degree, 5 * degree, 0), 0.01),
             {.step = 1e-4, .damping_ratio = 0.2});
  Noise noise;
  for (int step = 0; step < 3; ++step) {
    for (std::size_t axis = 0; axis < D; ++axis)
      for (std::size_t i = 0; i < box.particles.size(); ++i) {
        box.particles.displacement[axis][i] = (axis + 1 == D ? -0.15 : 0.02) * box.particles.start[axis][i] + 0.02 * noise();
        box.particles.velocity[axis][i] = noise();
      }
    box.evaluate();
  }
  EXPECT_GT(box.forces.broken_links(), 10);
  EXPECT_FALSE(box.forces.gathered().empty());
  expect_momenta_kept<D>(box);
}

TEST(failing_forces, keep_both_momenta_when_ground_breaks) {
  expect_momenta_kept_when_broken<2>();
  expect_momenta_kept_when_broken<3>();
}

TEST(failing_forces, break_links_at_the_rupture_strain) {
  const Soil soil;
  const Real mu = soil.density * soil.s_wave_velocity * soil.s_wave_velocity;
  Box<2> box({4, 4}, 0.5, strong_as(soil, laws::MohrCoulomb::make(10e3, 0, 0, 1e9), 0.01));
  const Real yields = 10e3 / mu;
  box.shear(yields + 0.0095);
  box.evaluate();
  EXPECT_EQ(box.forces.broken_links(), 0);
  const Real before = box.forces.energy(box.particles);
  box.shear(yields + 0.0105);
  box.evaluate();
  EXPECT_EQ(box.forces.broken_links(), 4 * 3 * 2 + 2 * 3 * 3);
  for (Index i = 0; i < 16; ++i) EXPECT_EQ(box.forces.broken_fraction(i), 1);
  // Without cohesion and friction no shear is left.
  box.evaluate();
  EXPECT_NEAR(box.forces.work().rupture + box.forces.energy(box.particles), before, 0.1 * before);
}

/// Two bodies that were never linked: the free surfaces of two boxes.
struct Collision {
  explicit Collision(Real damping_ratio, Real friction_angle = 0) {
    const Soil soil;
    std::vector<Site<2>> sites;
    for (int body = 0; body < 2; ++body)
      for (const Site<2>& site : box_sites<2>({3, 3})) sites.push_back({site[0], site[1] + 6 * body});
    auto particles = make_particles<2>(sites, spacing, soil);
    for (std::size_t i = 9; i < 18; ++i) {
      particles.displacement[1][i] = -2.9 * spacing;  // a tenth of a spacing is left between them
      particles.velocity[1][i] = -1;
      particles.velocity[0][i] = 0.5;
    }
    const auto links = make_links<2>(sites, spacing, 1.5);
    const auto ground = strong_as(soil, laws::MohrCoulomb::make(1e12, friction_angle, 0, 1e11), 1);
    const Real step = 0.1 * spacing / soil.p_wave_velocity;
    auto made = std::make_unique<FailingForces<2>>(particles, links,
                                                   GroundStrength<2>(particles, links, {ground}, std::vector<Index>(18, 0)),
                                                   LooseRules{.step = step, .damping_ratio = damping_ratio});
    forces = made.get();
    stepper.emplace(particles, std::move(made), particles::ParticleSupports<2>{},
                    particles::UniformRules{step, particles::Integrator::leapfrog, {}});
    stepper->start();
  }

  Real momentum(std::size_t axis) const {
    Real sum = 0;
    for (std::size_t i = 0; i < 18; ++i) sum += stepper->velocity()[axis][i] / stepper->particles().inverse_mass[i];
    return sum;
  }
  Real energy() { return stepper->kinetic_energy() + stepper->elastic_energy(); }

  static constexpr Real spacing = 0.5;
  FailingForces<2>* forces = nullptr;
  std::optional<particles::UniformStepper<2>> stepper;
};

TEST(loose_contacts, keep_the_energy_of_bodies_that_meet_without_damping_and_friction) {
  Collision collision(0);
  const Real before = collision.energy(), up = collision.momentum(1);
  Index most = 0;
  for (int i = 0; i < 1200; ++i) {
    collision.stepper->advance();
    most = std::max(most, collision.forces->contacts());
  }
  EXPECT_EQ(most, 3);
  EXPECT_EQ(collision.forces->contacts(), 0);
  EXPECT_NEAR(collision.energy(), before, 2e-3 * before);
  EXPECT_NEAR(collision.momentum(1), up, 1e-10 * std::abs(up));
}

TEST(loose_contacts, add_up_what_dashpots_and_friction_take) {
  Collision collision(0.2, 30 * degree);
  const Real before = collision.energy(), along = collision.momentum(0);
  for (int i = 0; i < 1200; ++i) collision.stepper->advance();
  const Real lost = before - collision.energy();
  EXPECT_GT(lost, 0.05 * before);
  EXPECT_NEAR(collision.forces->work().contact, lost, 0.02 * before);
  EXPECT_NEAR(collision.momentum(0), along, 1e-10 * std::abs(along));
}

TEST(failing_forces, go_on_from_a_checkpoint_with_the_same_bits) {
  const auto make = [] {
    return Box<2>({6, 6}, 0.5, strong_as({}, laws::MohrCoulomb::make(1e3, 20 * degree, 5 * degree, 0), 0.02),
                  {.step = 1e-4, .damping_ratio = 0.2});
  };
  const auto move = [](Box<2>& box, Real by) {
    Noise noise;
    for (std::size_t axis = 0; axis < 2; ++axis)
      for (std::size_t i = 0; i < box.particles.size(); ++i) {
        box.particles.displacement[axis][i] = -by * box.particles.start[axis][i] + 0.02 * noise();
        box.particles.velocity[axis][i] = noise();
      }
    box.evaluate();
  };
  Box<2> first = make(), second = make();
  move(first, 0.03);
  move(first, 0.06);
  test::MemoryArchive archive;
  first.forces.columns(archive);
  archive.turn_round();
  second.forces.columns(archive);
  EXPECT_GT(first.forces.broken_links(), 0);
  for (const Real by : {0.09, 0.05}) {
    move(first, by);
    move(second, by);
    for (std::size_t freedom = 0; freedom < 3; ++freedom) EXPECT_EQ(first.acceleration[freedom], second.acceleration[freedom]);
  }
  EXPECT_EQ(first.forces.work().rupture, second.forces.work().rupture);
}

}  // namespace
}  // namespace sazare::methods::mps
