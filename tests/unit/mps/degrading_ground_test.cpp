#include <gtest/gtest.h>

#include <numbers>

#include "sazare/methods/mps/failing_forces.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/particles/uniform_stepper.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

constexpr Real modulus = 1500 * 100 * 100, reference = 1e-3;
constexpr laws::Elasticity elastic{modulus, 2 * modulus};
const laws::BackboneCurve curve = laws::hyperbolic_curve(modulus, reference, modulus* reference, 30);

StrengthOfGround soil() {
  return {.law = {}, .elastic = elastic, .density = 1500, .parts = laws::OverlayModel<4>(elastic, curve).parts()};
}

/// A box of soil that degrades, led along paths.
template <int D>
struct Box {
  explicit Box(const Site<D>& counts)
      : particles(make_particles<D>(box_sites<D>(counts), 0.5, {})),
        links(make_links<D>(box_sites<D>(counts), 0.5, 1.5)),
        forces(particles, links, GroundStrength<D>(particles, links, {soil()}, std::vector<Index>(particles.size(), 0)),
               {.step = 1e-4}) {
    for (auto& column : acceleration) column.assign(particles.padded(), 0);
    for (auto& column : stretch) column.assign(particles.padded(), 0);
  }

  /// Simple shear along x over the last axis, on a body that is turned as a whole about the axis across it.
  void shear(Real by, Real turned = 0) {
    const Real own = turned - 0.5 * by, cosine = std::cos(turned), sine = std::sin(turned);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Real x = particles.start[0][i], y = particles.start[D - 1][i], moved = x + by * y;
      particles.displacement[0][i] = cosine * moved - sine * y - x;
      particles.displacement[D - 1][i] = sine * moved + cosine * y - y;
      if constexpr (D == 2) {
        particles.rotation[0][i] = std::cos(own);
        particles.rotation[1][i] = std::sin(own);
      } else {
        particles.rotation[0][i] = particles.rotation[8][i] = std::cos(own);
        particles.rotation[6][i] = std::sin(own);
        particles.rotation[2][i] = -std::sin(own);
      }
    }
    forces.evaluate(particles, acceleration);
  }

  void lead(Real from, Real to, int steps, Real turned = 0) {
    for (int step = 1; step <= steps; ++step) shear(from + (to - from) * step / steps, turned);
  }

  /// Of a particle, in its own frame.
  Real stress(Index particle, Real turned = 0) {
    measure_stretch(links, particles, stretch);
    const Rotation<D> there = forces.strength().stress(particles, stretch, particle);
    Rotation<D> turn = Rotation<D>::Identity();
    turn(0, 0) = turn(D - 1, D - 1) = std::cos(turned);
    turn(D - 1, 0) = std::sin(turned);
    turn(0, D - 1) = -std::sin(turned);
    return (turn.transpose() * there * turn)(0, D - 1);
  }

  state::Particles<D> particles;
  LinkTable<D> links;
  FailingForces<D> forces;
  state::FreedomColumns<D> acceleration;
  Tensors<D> stretch;
};

template <int D>
Site<D> cube(int side) {
  Site<D> counts{};
  counts.fill(side);
  return counts;
}

template <int D>
void expect_masings_rules() {
  Box<D> box(cube<D>(4));
  constexpr Real most = 2e-3;
  for (const Real sheared : {1e-5, 3e-4, 1e-3, most}) {
    box.lead(0.5 * sheared, sheared, 20);
    for (Index i = 0; i < box.particles.count; ++i)
      EXPECT_NEAR(box.stress(i), curve.stress(sheared), 2e-3 * curve.stress(sheared)) << sheared << ", particle " << i;
  }
  box.lead(most, -most, 200);
  EXPECT_NEAR(box.stress(5), -curve.stress(most), 3e-3 * curve.stress(most));
  box.lead(-most, 0.5 * most, 200);
  EXPECT_NEAR(box.stress(5), 2 * curve.stress(0.75 * most) - curve.stress(most), 3e-3 * curve.stress(most));
  EXPECT_NEAR(box.forces.strength().degrading().peak(5), most, 1e-3 * most);
}

TEST(degrading_ground, follows_its_backbone_and_masings_rules_in_every_particle) {
  expect_masings_rules<2>();
  expect_masings_rules<3>();
}

/// Of closed cycles, after the first loading.
TEST(degrading_ground, dissipates_in_a_cycle_what_its_damping_says) {
  Box<2> still({8, 8});
  still.shear(1e-6);
  const Real volume = still.forces.energy(still.particles) / (0.5 * modulus * 1e-12);
  for (const Real most : {3e-4, 1e-3, 5e-3}) {
    Box<2> box({8, 8});
    box.shear(0);
    box.lead(0, most, 200);
    Real before = 0, cycle = 0, least = 0;
    for (int turn = 0; turn < 3; ++turn) {
      before = box.forces.work().flow;
      for (const Real to : {-most, most}) {
        Real last = box.forces.work().flow;
        for (int step = 1; step <= 400; ++step) {
          box.shear(-to + 2 * to * step / 400);
          const Real now = box.forces.work().flow;
          least = std::min(least, now - last);
          last = now;
        }
      }
      cycle = box.forces.work().flow - before;
    }
    const Real expected = 4 * std::numbers::pi * curve.masing_damping(most) * 0.5 * most * curve.stress(most) * volume;
    EXPECT_NEAR(cycle, expected, 5e-3 * expected) << most;
    EXPECT_GT(least, -1e-6 * cycle) << most;
  }
}

TEST(degrading_ground, does_not_notice_that_the_whole_body_has_turned) {
  for (const Real turned : {0.7, 2.5}) {
    Box<2> flat({5, 5}), steep({5, 5});
    Box<3> flat_in_space(cube<3>(4)), steep_in_space(cube<3>(4));
    const auto compare = [&](auto& here, auto& there) {
      here.lead(0, 2e-3, 40);
      here.lead(2e-3, -1e-3, 60);
      there.lead(0, 2e-3, 40, turned);
      there.lead(2e-3, -1e-3, 60, turned);
      EXPECT_NEAR(there.stress(7, turned), here.stress(7), 1e-9 * std::abs(here.stress(7)));
      EXPECT_NEAR(there.forces.energy(there.particles), here.forces.energy(here.particles),
                  1e-9 * here.forces.energy(here.particles));
      EXPECT_NEAR(there.forces.work().flow, here.forces.work().flow, 1e-9 * here.forces.work().flow);
    };
    compare(flat, steep);
    compare(flat_in_space, steep_in_space);
  }
}

template <int D>
void expect_elastic_forces_at_tiny_strains() {
  Box<D> box(cube<D>(4));
  Noise noise;
  for (auto& column : box.particles.displacement)
    for (std::size_t i = 0; i < box.particles.size(); ++i) column[i] = 1e-6 * noise();
  box.forces.evaluate(box.particles, box.acceleration);
  ElasticForces<D> elastic_forces(box.links, RotationRemoval::mean_rotation);
  auto expected = box.acceleration;
  elastic_forces.evaluate(box.particles, expected);
  Real largest = 0;
  for (const Real one : expected[0]) largest = std::max(largest, std::abs(one));
  for (std::size_t freedom = 0; freedom < D; ++freedom)
    for (std::size_t i = 0; i < box.particles.size(); ++i)
      EXPECT_NEAR(box.acceleration[freedom][i], expected[freedom][i], 1e-9 * largest);
  EXPECT_EQ(box.forces.work().flow, 0);
}

TEST(degrading_ground, is_elastic_below_its_first_corner) {
  expect_elastic_forces_at_tiny_strains<2>();
  expect_elastic_forces_at_tiny_strains<3>();
}

/// A box that is let go, in several modes at once.
template <int D>
struct Vibration {
  explicit Vibration(int side, Real speed) {
    const auto sites = box_sites<D>(cube<D>(side));
    auto particles = make_particles<D>(sites, 0.5, {});
    const auto links = make_links<D>(sites, 0.5, 1.5);
    const Real length = 0.5 * side;
    for (std::size_t i = 0; i < particles.size(); ++i)
      for (std::size_t axis = 0; axis < D; ++axis)
        particles.velocity[axis][i] =
            speed * std::cos(std::numbers::pi * particles.start[(axis + 1) % D][i] / length + static_cast<Real>(axis));
    auto made = std::make_unique<FailingForces<D>>(
        particles, links, GroundStrength<D>(particles, links, {soil()}, std::vector<Index>(particles.size(), 0)),
        LooseRules{.step = step});
    forces = made.get();
    stepper.emplace(particles, std::move(made), particles::ParticleSupports<D>{},
                    particles::UniformRules{step, particles::Integrator::verlet, {}});
  }
  Real kept() { return stepper->kinetic_energy_of_kick() + stepper->elastic_energy(); }
  void columns(Archive& archive) { stepper->columns(archive); }

  static constexpr Real step = 5e-4;
  FailingForces<D>* forces = nullptr;
  std::optional<particles::UniformStepper<D>> stepper;
};

template <int D>
void expect_energy_to_be_dissipated_and_none_lost(int side) {
  Vibration<D> box(side, 0.2);
  box.stepper->start();
  const Real before = box.kept();
  Real last = 0, largest = 0, back = 0;
  for (int i = 0; i < 1500; ++i) {
    box.stepper->advance();
    const Real flow = box.forces->work().flow;
    back = std::max(back, last - flow);
    last = flow;
    largest = std::max(largest, std::abs(box.kept() + flow - before));
  }
  EXPECT_GT(last, 0.3 * before);
  EXPECT_LT(largest, 1e-5 * before);
  EXPECT_LT(back, 3e-4 * before);
}

TEST(degrading_ground, stores_or_dissipates_the_energy_of_a_vibration) {
  expect_energy_to_be_dissipated_and_none_lost<2>(12);
  expect_energy_to_be_dissipated_and_none_lost<3>(6);
}

TEST(degrading_ground, gives_the_same_bits_on_any_number_of_threads_and_after_a_restart) {
  Vibration<2> one(40, 1), two(40, 1), again(40, 1);
  parallel::set_threads(1);
  one.stepper->start();
  for (int i = 0; i < 60; ++i) one.stepper->advance();
  parallel::set_threads(2);
  two.stepper->start();
  for (int i = 0; i < 40; ++i) two.stepper->advance();
  test::MemoryArchive archive;
  two.columns(archive);
  archive.turn_round();
  again.columns(archive);
  for (int i = 0; i < 20; ++i) {
    two.stepper->advance();
    again.stepper->advance();
  }
  parallel::set_threads(0);
  EXPECT_GT(one.forces->work().flow, 0);
  for (const auto* other : {&two, &again}) {
    for (std::size_t axis = 0; axis < 2; ++axis)
      EXPECT_EQ(other->stepper->particles().displacement[axis], one.stepper->particles().displacement[axis]);
    EXPECT_EQ(other->forces->work().flow, one.forces->work().flow);
    for (Index i = 0; i < 1600; ++i)
      EXPECT_EQ(other->forces->strength().degrading().peak(i), one.forces->strength().degrading().peak(i));
  }
}

}  // namespace
}  // namespace sazare::methods::mps
