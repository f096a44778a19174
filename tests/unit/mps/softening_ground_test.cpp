#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "sazare/methods/mps/failing_forces.hpp"
#include "sazare/methods/mps/softening.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/particles/uniform_stepper.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

constexpr Real modulus = 1500 * 100 * 100, cohesion = 20e3, residual = 4e3, softening_strain = 0.01;

/// Softens at this strain whatever the spacing: the ground is as high as its softening displacement.
StrengthOfGround soft(std::optional<Real> residual_cohesion, Real residual_friction = 20) {
  constexpr Real degree = std::numbers::pi / 180;
  const auto law = laws::MohrCoulomb::make(cohesion, 20 * degree, 0, 10e3);
  std::optional<Softening> softening;
  if (residual_cohesion)
    softening = {{*residual_cohesion, std::sin(residual_friction * degree), 0},
                 {.shear_modulus = modulus, .displacement = softening_strain, .square_of_reach = 1e9, .height = 1}};
  return {.yields = true, .law = law, .elastic = {modulus, 2 * modulus}, .density = 1500, .rupture_strain = 1e9, .softening = softening};
}

/// A box that is let go, in several modes at once, and yields.
struct Vibration {
  explicit Vibration(const StrengthOfGround& ground) {
    const auto sites = box_sites<2>({16, 16});
    auto particles = make_particles<2>(sites, 0.5, {});
    const auto links = make_links<2>(sites, 0.5, 1.5);
    for (std::size_t i = 0; i < particles.size(); ++i)
      for (std::size_t axis = 0; axis < 2; ++axis)
        particles.velocity[axis][i] =
            0.6 * std::cos(std::numbers::pi * particles.start[1 - axis][i] / 8 + static_cast<Real>(axis));
    auto made = std::make_unique<FailingForces<2>>(
        particles, links, GroundStrength<2>(particles, links, {ground}, std::vector<Index>(particles.size(), 0)),
        LooseRules{.step = step});
    forces = made.get();
    stepper.emplace(particles, std::move(made), particles::ParticleSupports<2>{},
                    particles::UniformRules{step, particles::Integrator::verlet, {}});
  }
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) stepper->advance();
  }
  Real kept() { return stepper->kinetic_energy_of_kick() + stepper->elastic_energy(); }
  void columns(Archive& archive) { stepper->columns(archive); }

  static constexpr Real step = 5e-4;
  FailingForces<2>* forces = nullptr;
  std::optional<particles::UniformStepper<2>> stepper;
};

void expect_same_bits(const Vibration& a, const Vibration& b) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    EXPECT_EQ(a.stepper->particles().displacement[axis], b.stepper->particles().displacement[axis]);
  EXPECT_EQ(a.forces->strength().slip(), b.forces->strength().slip());
  EXPECT_EQ(a.forces->work().flow, b.forces->work().flow);
}

TEST(softening_ground, dissipates_in_every_step_and_keeps_the_energy_balance) {
  Vibration box(soft(residual));
  box.stepper->start();
  const Real before = box.kept();
  Real last = 0, largest = 0, back = 0;
  for (int i = 0; i < 1500; ++i) {
    box.advance(1);
    const Real flow = box.forces->work().flow;
    back = std::max(back, last - flow);
    last = flow;
    largest = std::max(largest, std::abs(box.kept() + flow - before));
  }
  EXPECT_GT(*std::ranges::max_element(box.forces->strength().slip()), softening_strain);
  EXPECT_GT(last, 0.3 * before);
  EXPECT_LT(largest, 1e-3 * before);
  EXPECT_LT(back, 1e-4 * before);
}

TEST(softening_ground, gives_the_same_bits_on_any_number_of_threads_and_after_a_restart) {
  Vibration one(soft(residual)), two(soft(residual)), again(soft(residual));
  parallel::set_threads(1);
  one.stepper->start();
  one.advance(400);
  parallel::set_threads(2);
  two.stepper->start();
  two.advance(300);
  test::MemoryArchive archive;
  two.columns(archive);
  archive.turn_round();
  again.columns(archive);
  two.advance(100);
  again.advance(100);
  parallel::set_threads(0);
  EXPECT_GT(*std::ranges::max_element(one.forces->strength().slip()), 0.2 * softening_strain);
  expect_same_bits(two, one);
  expect_same_bits(again, one);
}

TEST(softening_ground, is_weaker_than_perfectly_plastic_ground) {
  Vibration plastic(soft(std::nullopt)), softening(soft(residual));
  for (auto* box : {&plastic, &softening}) {
    box->stepper->start();
    box->advance(600);
  }
  const auto most = [](const Vibration& box) { return *std::ranges::max_element(box.forces->strength().slip()); };
  EXPECT_GT(most(softening), 1.2 * most(plastic));
}

TEST(softening_ground, of_friction_is_weaker_than_that_of_cohesion_alone) {
  Vibration cohesive(soft(residual)), both(soft(residual, 5));
  for (auto* box : {&cohesive, &both}) {
    box->stepper->start();
    box->advance(600);
  }
  EXPECT_GT(both.forces->work().flow, 0);
  const auto most = [](const Vibration& box) { return *std::ranges::max_element(box.forces->strength().slip()); };
  EXPECT_GT(most(both), most(cohesive));
}

/// The band follows the stress at which it softens, so that u is the same at any depth.
TEST(softening_ground, has_the_same_slip_under_any_pressure) {
  constexpr Real degree = std::numbers::pi / 180, reach = 0.2;
  for (const Real dilation : {0.0, 10.0}) {
    const auto peak = laws::MohrCoulomb::make(2e3, 40 * degree, dilation * degree, {});
    const Softening softening{{0, std::sin(30 * degree), 0},
                              {.shear_modulus = modulus, .displacement = 0.1, .square_of_reach = reach}};
    for (const Real pressure : {0.0, 20e3, 300e3}) {
      const SofteningBand band = softening.under(peak, pressure);
      EXPECT_NEAR(band.drop, peak.shear_strength(pressure) - pressure * std::sin(30 * degree),
                  1e-9 * peak.shear_strength(pressure));
      const Real inner = std::sqrt(reach * modulus * band.strain() / (4 * band.drop));
      EXPECT_NEAR(2 * std::numbers::pi * inner * band.strain(), 0.1, 1e-12);
      // The plane of the band bears the pressure p where the mean of the principal stresses is this, by Mohr's circle.
      const Real radius = peak.shear_strength(pressure) / std::cos(dilation * degree);
      EXPECT_NEAR(softening.strain(peak, peak, pressure + radius * peak.sin_dilation), band.strain(), 1e-12);
    }
    EXPECT_EQ(softening.strain(peak, peak, -1e3), softening.under(peak, 0).strain());
  }
}

TEST(softening_ground, has_no_band_wider_than_the_ground_is_high) {
  const auto sand = laws::MohrCoulomb::make(0, 40 * std::numbers::pi / 180, 0, {});
  const Softening softening{{0, 0.5, 0}, {.shear_modulus = modulus, .displacement = 0.1, .square_of_reach = 0.2, .height = 20}};
  EXPECT_EQ(softening.under(sand, 0).strain(), 0.1 / 20);
  EXPECT_EQ(softening.under(sand, 0).width(), 20);
}

/// u = 2 pi L k_r with L^2 = M mu k_r/(4 d), and M is 0.75 (w1 + 4 w2)/(w1 + 2 w2) spacings squared, of links of one spacing and of
/// its root of two, whose stiffness is w1 = 0.5 and w2 = (1.5/sqrt(2) - 1)/2.
TEST(softening_ground, has_a_band_whose_slip_does_not_depend_on_the_spacing) {
  const Real diagonal = (1.5 / std::sqrt(2.0) - 1) / 2, share = 0.75 * (0.5 + 4 * diagonal) / (0.5 + 2 * diagonal);
  for (const Real spacing : {0.5, 0.25}) {
    const auto links = make_links<2>(box_sites<2>({4, 4}), spacing, 1.5);
    const Real reach = square_of_reach(links);
    EXPECT_NEAR(reach, share * spacing * spacing, 1e-12);
    const SofteningBand band{16e3, modulus, 0.1, reach, spacing};
    const Real inner = std::sqrt(reach * modulus * band.strain() / (4 * 16e3));
    EXPECT_NEAR(2 * std::numbers::pi * inner * band.strain(), 0.1, 1e-12);
    EXPECT_NEAR(band.width(), 2 * std::numbers::pi * inner, 1e-9);
    const Real largest = band.largest_spacing();
    for (const Real coarser : {1.0, 3.0}) {
      const Real coarse = coarser * largest;
      const SofteningBand resolved{16e3, modulus, 0.1, share * coarse * coarse, coarse};
      EXPECT_NEAR(resolved.width(), 2 * std::numbers::pi * coarse, 1e-9);
    }
  }
}

}  // namespace
}  // namespace sazare::methods::mps
