#include <gtest/gtest.h>

#include "sazare/core/largest_eigenvalue.hpp"
#include "sazare/methods/mps/linear_stiffness.hpp"
#include "sazare/methods/mps/stable_step.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

Real limit(int across, int high, Real spacing, const laws::RayleighDamping& damping = {}, Real ratio = 0) {
  const Column2 column(across, high, spacing, {1500, 100, 200, ratio});
  return stable_step<2>(column.particles, column.links, column.supports, damping).verlet;
}

TEST(largest_eigenvalue, of_a_chain_of_springs) {
  constexpr int n = 50;
  const Real found = largest_eigenvalue(n, [](std::span<const Real> x, std::span<Real> y) {
    for (std::size_t i = 0; i < n; ++i) y[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < n ? x[i + 1] : 0);
  });
  EXPECT_NEAR(found, 2 + 2 * std::cos(std::numbers::pi / (n + 1)), 1e-6);
}

// The limits of an independent eigenvalue calculation of the same formulation by dense matrices.
TEST(stable_step, of_the_columns_of_the_paper) {
  EXPECT_NEAR(limit(10, 100, 1.0), 2 / 487.24046, 1e-8);
  EXPECT_NEAR(limit(5, 50, 2.0), 8.3664e-3, 1e-7);
  EXPECT_NEAR(limit(3, 31, 3.2), 1.40822e-2, 1e-7);
}

TEST(stable_step, with_damping_is_the_root_of_its_equation) {
  const auto damping = laws::RayleighDamping::make(1, 15);
  const Real dt = limit(5, 50, 2.0, damping, 0.1), square = std::pow(2 / limit(5, 50, 2.0), 2);
  EXPECT_NEAR(square * dt * dt + 2 * square * damping.stiffness_time * 0.1 * dt, 4, 1e-5);
}

TEST(stable_step, of_layers_with_their_own_damping_lies_between_those_of_one) {
  const auto damping = laws::RayleighDamping::make(1, 15);
  Column2 column(5, 20, 1.0, {1500, 100, 200, 0.02});
  for (std::size_t i = 0; i < column.sites.size(); ++i)
    if (column.sites[i][1] >= 10) column.particles.damping_ratio[i] = 0.3;
  const Real mixed = stable_step<2>(column.particles, column.links, column.supports, damping).verlet;
  const Real calm = limit(5, 20, 1.0, damping, 0.02), damped = limit(5, 20, 1.0, damping, 0.3);
  EXPECT_GT(mixed, damped * (1 - 1e-6));
  EXPECT_LT(mixed, 0.7 * calm);
}

/// Whether a run from noise stays bounded.
bool stays_bounded(const Column2& column, const particles::UniformRules& rules, int steps) {
  Column2 noisy = column;
  Noise noise;
  for (auto& velocity : noisy.particles.velocity)
    for (std::size_t i = 0; i < noisy.particles.size(); ++i) velocity[i] = 1e-8 * noise();
  auto stepper = noisy.stepper(rules);
  stepper.start();
  for (int step = 0; step < steps; ++step) stepper.advance();
  return stepper.largest_acceleration() < 1e-2;
}

class Limits : public testing::TestWithParam<particles::Integrator> {};

TEST_P(Limits, are_where_runs_begin_to_grow) {
  const auto damping = laws::RayleighDamping::make(1, 15);
  Column2 column(5, 20, 1.0, {1500, 100, 200, 0.05});
  for (std::size_t i = 0; i < column.sites.size(); ++i)
    if (!particles::is_euler(GetParam()) && column.sites[i][1] >= 10) column.particles.damping_ratio[i] = 0.3;
  const StableStep predicted = stable_step<2>(column.particles, column.links, column.supports, damping);
  const Real dt = GetParam() == particles::Integrator::euler          ? predicted.euler
                  : GetParam() == particles::Integrator::euler_lagged ? predicted.euler_lagged
                                                                      : predicted.verlet;
  const int steps = particles::is_euler(GetParam()) ? 40000 : 6000;  // Euler's growth is slower
  EXPECT_TRUE(stays_bounded(column, {0.99 * dt, GetParam(), damping}, steps));
  EXPECT_FALSE(stays_bounded(column, {1.01 * dt, GetParam(), damping}, steps));
}

INSTANTIATE_TEST_SUITE_P(Of, Limits,
                         testing::Values(particles::Integrator::verlet, particles::Integrator::leapfrog,
                                         particles::Integrator::euler, particles::Integrator::euler_lagged));

TEST(linear_stiffness, is_the_slope_of_the_elastic_forces) {
  const auto sites = box_sites<3>({3, 4, 3});
  state::Particles<3> particles = make_particles<3>(sites, 0.5, {});
  const LinkTable<3> links = make_links<3>(sites, 0.5, 1.5);
  LinearStiffness<3> stiffness(particles, links, {});
  std::vector<Real> x(stiffness.rows()), y(stiffness.rows());
  Noise noise;
  for (Real& value : x) value = noise();
  stiffness.apply(x, y);
  // A small motion of the shape x, evaluated by the forces themselves; rotations to first order.
  constexpr Real small = 1e-7;
  state::FreedomColumns<3> acceleration;
  for (auto& column : acceleration) column.assign(particles.padded(), 0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    std::array<Real, 6> q;
    for (std::size_t f = 0; f < 6; ++f) q[f] = small * x[6 * i + f] * std::sqrt(particles.inverse_inertia_of(f)[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) particles.displacement[axis][i] += q[axis];
    const Matrix3 turn =
        Eigen::AngleAxis<Real>(Vector3(q[3], q[4], q[5]).norm(), Vector3(q[3], q[4], q[5]).normalized()).toRotationMatrix();
    for (std::size_t n = 0; n < 9; ++n) particles.rotation[n][i] = turn(static_cast<int>(n / 3), static_cast<int>(n % 3));
  }
  ElasticForces<3> forces(links, RotationRemoval::mean_rotation);
  forces.evaluate(particles, acceleration);
  Real largest = 0, error = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t f = 0; f < 6; ++f) {
      const Real found = -acceleration[f][i] / std::sqrt(particles.inverse_inertia_of(f)[i]) / small;
      largest = std::max(largest, std::abs(y[6 * i + f]));
      error = std::max(error, std::abs(found - y[6 * i + f]));
    }
  EXPECT_LT(error, 1e-5 * largest);
}

}  // namespace
}  // namespace sazare::methods::mps
