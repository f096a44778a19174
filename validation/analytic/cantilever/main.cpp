#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "sazare/parallel/threads.hpp"
#include "validation/common/mps_trace.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Rest of the least squares of c0 + c1 cos + c2 sin.
Real rest(const std::vector<Real>& values, Real step, Real frequency) {
  Eigen::MatrixX3d wave(static_cast<Eigen::Index>(values.size()), 3);
  for (Eigen::Index k = 0; k < wave.rows(); ++k) {
    const Real phase = 2 * std::numbers::pi * frequency * step * static_cast<Real>(k);
    wave.row(k) << 1, std::cos(phase), std::sin(phase);
  }
  const Eigen::Map<const Eigen::VectorXd> right(values.data(), wave.rows());
  const Eigen::Vector3d best = (wave.transpose() * wave).ldlt().solve(wave.transpose() * right);
  return (wave * best - right).squaredNorm();
}

Real frequency_of(const std::vector<Real>& values, Real step, Real guess) {
  Real low = 0.85 * guess, high = 1.15 * guess;
  while (high - low > 1e-6 * guess) {
    const Real first = low + (high - low) / 3, second = high - (high - low) / 3;
    (rest(values, step, first) < rest(values, step, second) ? high : low) =
        rest(values, step, first) < rest(values, step, second) ? second : first;
  }
  return 0.5 * (low + high);
}

/// The first root b of the frequency equation of Timoshenko's cantilever, b^2 = rho A L^4 w^2/(E I): T. C. Huang, J. Appl. Mech.
/// 28 (1961) 579-584. `slenderness` is h/L, `shear` E/(kappa G).
Real timoshenko_root(Real slenderness, Real shear) {
  const Real r2 = slenderness * slenderness / 12, s2 = shear * r2;
  const auto equation = [&](Real b) {
    const Real root = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
    const Real alpha = b * std::sqrt(0.5 * (root - r2 - s2)), beta = b * std::sqrt(0.5 * (root + r2 + s2));
    return 2 + (b * b * (r2 - s2) * (r2 - s2) + 2) * std::cosh(alpha) * std::cos(beta) -
           b * (r2 + s2) / std::sqrt(1 - b * b * r2 * s2) * std::sinh(alpha) * std::sin(beta);
  };
  Real low = 3, high = 3.6;
  while (high - low > 1e-12) (equation(0.5 * (low + high)) * equation(low) > 0 ? low : high) = 0.5 * (low + high);
  return low;
}

/// First frequency over that of Timoshenko's beam in plane strain. The clamp goes through the centres of the lowest particles.
Real ratio(Real spacing, Real poisson) {
  const auto trace = validation::trace_gauges(
      "validation/analytic/cantilever/case.toml",
      {fmt::format("particles.spacing={}", spacing), fmt::format("materials.0.poisson_ratio={}", poisson)}, 0, 20);
  constexpr Real s_wave_velocity = 100, height = 1;
  const Real length = 20 - 0.5 * spacing, modulus = 2 * (1 + poisson) / (1 - poisson * poisson);  // plane strain, over G
  const Real kappa = 10 * (1 + poisson) / (12 + 11 * poisson);
  const Real theory = timoshenko_root(height / length, modulus / kappa) / (2 * std::numbers::pi) * s_wave_velocity *
                      std::sqrt(modulus / 12) * height / (length * length);
  return frequency_of(trace.displacement.front(), trace.step, theory) / theory;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  validation::print_row("first", ratio(0.1, 1.0 / 3));
  const Real coarse = ratio(0.2, 0), fine = ratio(0.1, 0);
  validation::print_row("without-poisson", fine);
  validation::print_row("refined", std::abs(fine - 1) / std::abs(coarse - 1));
}
