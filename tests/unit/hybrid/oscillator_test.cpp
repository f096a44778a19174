#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/two_sides.hpp"

namespace sazare::methods::hybrid {
namespace {

constexpr Real weight = 10;  // of a ball of 1 kg [N]
constexpr Real spring = 1e5;

/// A mass of 1 kg on a spring, and on it a ball of 1 kg on the spring of its contact, which is pressed by the ball's weight from
/// the beginning; the first spring is not.
test::CouplingScene oscillator(CouplingScheme scheme) {
  test::CouplingScene scene;
  scene.box = {{0.1, 0.1, 1}, {1, 1, 1}, 0};
  scene.rules.width = 0.1;
  scene.rules.scheme = scheme;
  scene.rules.tolerance = 1e-9;
  scene.gravity = {0, -weight, 0};
  scene.balls = {{.centre = {0.05, 0.15 - weight / spring, 0}}};
  return scene;
}

/// Places of the mass and of the ball since the beginning.
Eigen::Vector2d exact(Real time) {
  Eigen::Matrix2d stiffness;
  stiffness << 2 * spring, -spring, -spring, spring;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(stiffness);
  const Eigen::Vector2d rest = -weight / spring * Eigen::Vector2d::Ones();
  const Eigen::Vector2d swing =
      ((modes.eigenvalues().array().sqrt() * time).cos() * (modes.eigenvectors().transpose() * -rest).array()).matrix();
  return rest + modes.eigenvectors() * swing;
}

Real energy(test::TwoSides<2>& sides) {
  return sides.balls().energies().sum() + sides.balls().energies().wall_work +
         sides.width() * (sides.fem().kinetic_energy() + sides.fem().elastic_energy());
}

struct Outcome {
  Real error = 0;   ///< of the mass, the largest [m]
  Real gained = 0;  ///< energy of both at the end, over the work of the weight on the way to rest [-]
  Real made = 0;    ///< of that, what the surface made [-]
};

Outcome run(CouplingScheme scheme, Real window, Real until = 0.06) {
  test::TwoSides<2> sides(oscillator(scheme), window);
  sides.start();
  const Real scale = weight * weight / spring, before = energy(sides);
  const auto top = static_cast<std::size_t>(test::node_at(sides.fem().body().mesh(), {0, 0.1, 0}));
  Outcome outcome;
  while (sides.fem().time() < until * (1 - 1e-9)) {
    sides.advance(1);
    outcome.error =
        std::max(outcome.error, std::abs(sides.fem().state().displacement[2 * top + 1] - exact(sides.fem().time())[0]));
  }
  EXPECT_EQ(sides.balls().contacts(), 1);
  outcome.gained = (energy(sides) - before) / scale;
  outcome.made = sides.continuum().totals().made() / scale;
  return outcome;
}

TEST(two_mass_oscillator, the_lagged_schemes_are_of_first_order_and_the_repeated_one_of_second) {
  for (const auto& [scheme, order] :
       {std::pair{CouplingScheme::lagged, 1.0}, {CouplingScheme::impulse, 1.0}, {CouplingScheme::iterative, 2.0}}) {
    const Real coarse = run(scheme, 1e-4).error, fine = run(scheme, 5e-5).error;
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.15) << static_cast<int>(scheme);
    if (scheme == CouplingScheme::iterative) {
      EXPECT_LT(fine, 2e-3 * weight / spring);
    }
  }
}

TEST(two_mass_oscillator, the_energy_that_it_gains_is_what_the_surface_made) {
  for (const CouplingScheme scheme : {CouplingScheme::lagged, CouplingScheme::impulse, CouplingScheme::iterative}) {
    const Outcome outcome = run(scheme, 1e-4);
    EXPECT_NEAR(outcome.gained, outcome.made, 2e-4) << static_cast<int>(scheme);
    if (scheme == CouplingScheme::iterative)
      EXPECT_NEAR(outcome.made, 0, 1e-7);
    else
      EXPECT_GT(outcome.made, 5e-3);
  }
}

/// Windows so long that a force that lags behind throws the ball off within the time (validation/analytic/two-mass-oscillator).
TEST(two_mass_oscillator, the_automatic_scheme_makes_little_energy_in_windows_in_which_the_lagged_ones_are_unstable) {
  for (const Real window : {1e-4, 2e-4, 4e-4}) {
    const Outcome outcome = run(CouplingScheme::automatic, window);
    EXPECT_NEAR(outcome.gained, outcome.made, 1e-3) << window;
    EXPECT_NEAR(outcome.made, 0, 2e-2) << window;
  }
}

}  // namespace
}  // namespace sazare::methods::hybrid
