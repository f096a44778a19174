#include "sazare/methods/mps/stable_step.hpp"

#include <algorithm>
#include <cmath>

#include "sazare/core/largest_eigenvalue.hpp"
#include "sazare/methods/mps/linear_stiffness.hpp"

namespace sazare::methods::mps {

namespace {

/// Positive root of square dt^2 + 2 square lag dt = 4.
Real verlet_limit(Real square, Real lag) { return 4 / square / (lag + std::sqrt(lag * lag + 4 / square)); }

Real euler_limit(Real square, Real mass_rate, Real lag) {
  const Real damping = mass_rate + lag * square, critical = damping * damping - 4 * square;
  return critical < 0 ? damping / square : 4 / (damping + std::sqrt(critical));
}

Real euler_lagged_limit(Real square, Real mass_rate, Real lag) {
  const Real damping = mass_rate + lag * square;
  return damping / (square * (1 + lag * damping));
}

}  // namespace

StableStep with_outside_springs(const StableStep& without, Real square) {
  const Real own = without.frequency * without.frequency, all = own + square;
  const Real lag = std::max((4 / own - without.verlet * without.verlet) / (2 * without.verlet), Real{0});  // of the mean ratio
  return {.verlet = verlet_limit(all, lag * own / all), .frequency = std::sqrt(all)};
}

template <int D>
StableStep stable_step(const state::Particles<D>& particles, const LinkTable<D>& links,
                       const particles::ParticleSupports<D>& supports, const laws::RayleighDamping& damping) {
  constexpr std::size_t freedoms = state::particle_freedoms<D>;
  constexpr Real tolerance = 1e-6;
  LinearStiffness<D> stiffness(particles, links, supports);
  const std::size_t n = stiffness.rows();
  std::vector<Real> weight(n, 1), inner(n);
  const auto largest = [&] {
    return largest_eigenvalue(n, [&](std::span<const Real> x, std::span<Real> y) {
      for (std::size_t i = 0; i < n; ++i) inner[i] = weight[i] * x[i];
      stiffness.apply(inner, y);
      for (std::size_t i = 0; i < n; ++i) y[i] *= weight[i];
    });
  };
  const Real square = largest();
  StableStep result;
  result.frequency = std::sqrt(square);
  const auto ratios = std::minmax_element(particles.damping_ratio.begin(), particles.damping_ratio.begin() + particles.count);
  const Real least = damping.stiffness_time * *ratios.first, most = damping.stiffness_time * *ratios.second;
  result.euler = euler_limit(square, damping.mass_rate * *ratios.first, least);
  result.euler_lagged = std::min(euler_lagged_limit(square, damping.mass_rate * *ratios.first, least),
                                 euler_lagged_limit(square, damping.mass_rate * *ratios.second, most));
  // Between the limits for the least and the most damping in all particles.
  Real low = verlet_limit(square, most), high = verlet_limit(square, least);
  while (high - low > tolerance * high) {
    const Real step = std::sqrt(low * high);
    for (std::size_t i = 0; i < n; ++i)
      weight[i] = std::sqrt(0.25 * step * (step + 2 * damping.stiffness_time * particles.damping_ratio[i / freedoms]));
    const Real growth = largest();
    // The eigenvalue is between linear and square in the step, so a better bracket is known from it.
    (growth > 1 ? high : low) = step;
    const Real one = step / growth, two = step / std::sqrt(growth);
    low = std::max(low, std::min(one, two) * (1 - tolerance));
    high = std::min(high, std::max(one, two) * (1 + tolerance));
  }
  result.verlet = 0.5 * (low + high);
  return result;
}

template StableStep stable_step<2>(const state::Particles<2>&, const LinkTable<2>&, const particles::ParticleSupports<2>&,
                                   const laws::RayleighDamping&);
template StableStep stable_step<3>(const state::Particles<3>&, const LinkTable<3>&, const particles::ParticleSupports<3>&,
                                   const laws::RayleighDamping&);

}  // namespace sazare::methods::mps
