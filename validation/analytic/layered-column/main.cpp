#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "sazare/methods/mps/case/case.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/mps_trace.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using Complex = std::complex<Real>;
constexpr auto path = "validation/analytic/layered-column/case.toml";
constexpr Complex i(0, 1);

/// Exact: surface motion over 2 E of the half-space, layer by layer from the free surface down to the plane of the boundary.
/// Damping a1 h of the mass and a2 h of the stiffness makes density and modulus complex. Where layers meet, the damped stress is
/// continuous (Kelvin and Voigt); or the elastic one, where the damping is that of each particle (A20).
Complex exact_ratio(const cases::MpsCase& mps, Real frequency, bool by_particle) {
  const Real omega = 2 * std::numbers::pi * frequency;
  const auto damping = laws::RayleighDamping::make(mps.damping.f1, mps.damping.f2);
  Complex up = 1, down = 1;  // amplitudes of the rising and the falling wave at the top of a layer
  for (std::size_t layer = 0; layer < mps.materials.size(); ++layer) {
    const auto properties = [&](const cases::Ground& ground) {
      const Complex density = ground.density * (1.0 - i * damping.mass_rate * ground.damping_ratio / omega);
      const Complex modulus = ground.density * ground.s_wave_velocity * ground.s_wave_velocity *
                              (1.0 + i * omega * damping.stiffness_time * ground.damping_ratio);
      const Complex number = omega * std::sqrt(density / modulus);
      return std::pair{number, number * (by_particle ? Complex(std::real(modulus)) : modulus)};
    };
    const auto [number, impedance] = properties(mps.materials[layer]);
    const bool last = layer + 1 == mps.materials.size();
    // The boundary goes through the centres of the lowest particles.
    const Real thickness = mps.regions[layer].upper.y() - mps.regions[layer].lower.y() - (last ? 0.5 * mps.particles.spacing : 0);
    up *= std::exp(i * number * thickness);
    down *= std::exp(-i * number * thickness);
    if (last) break;
    const Complex ratio = impedance / properties(mps.materials[layer + 1]).second;
    const Complex sum = up + down, difference = ratio * (up - down);
    up = 0.5 * (sum + difference);
    down = 0.5 * (sum - difference);
  }
  return 2.0 / (2.0 * up);  // the surface moves by 2, the half-space alone would by 2 E
}

Complex transform(const std::vector<Real>& values, Real step, Real frequency) {
  Complex sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    sum += values[k] * std::exp(-2 * std::numbers::pi * frequency * step * static_cast<Real>(k) * i);
  return sum * step;
}

/// Largest errors of the amplitude from 0.2 to 10 Hz, over the exact one: Kelvin and Voigt's, and by particle.
std::array<Real, 2> largest_errors(Real spacing) {
  const std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing)};
  const auto trace = validation::trace_gauges(path, settings, 0, 10);
  const cases::CaseFile file = registry::read_case(path, settings);
  const laws::Ricker wave{5, 0.4};
  std::vector<Real> incoming;
  for (std::size_t k = 0; k < trace.acceleration.back().size(); ++k)
    incoming.push_back(2 * laws::ricker(wave, trace.step * static_cast<Real>(k)));
  std::array<Real, 2> largest{};
  for (Real frequency = 0.2; frequency <= 10.0001; frequency += 0.1) {
    const Complex found =
        transform(trace.acceleration.back(), trace.step, frequency) / transform(incoming, trace.step, frequency);
    for (const bool by_particle : {false, true}) {
      Real& error = largest[by_particle ? 1 : 0];
      error = std::max(error, std::abs(std::abs(found) / std::abs(exact_ratio(file.as<cases::MpsCase>(), frequency, by_particle)) - 1));
    }
  }
  return largest;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  const auto coarse = largest_errors(0.5), fine = largest_errors(0.25);
  validation::print_row("error", fine[0]);
  validation::print_row("error-by-particle", fine[1]);
  validation::print_row("convergence", fine[1] / coarse[1]);
}
