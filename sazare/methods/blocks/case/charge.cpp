#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sazare/core/mixed_hash.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::cases {

namespace {

/// A number of the standard normal distribution by a method of Box and Muller.
Real normal_number(std::uint64_t hash) {
  const auto uniform = [](std::uint64_t bits) { return (static_cast<Real>(bits >> 11) + 0.5) * 0x1p-53; };
  return std::sqrt(-2 * std::log(uniform(hash))) * std::cos(2 * std::numbers::pi * uniform(mixed_hash(hash, 1)));
}

}  // namespace

laws::Explosive Charge::filling() const {
  if (!is_custom()) {
    laws::Explosive known = laws::explosives[static_cast<std::size_t>(explosive)];
    known.velocity = detonation_velocity.value_or(known.velocity);
    return known;
  }
  const Real velocity = detonation_velocity.value();
  laws::Explosive own{"custom", density.value(), velocity, 0, {}};
  own.energy = own.density * (energy ? *energy : laws::energy_by_velocity(velocity, gas_exponent.value()));
  if (gas_exponent)
    own.gas.omega = *gas_exponent - 1;
  else
    own.gas = {jwl[0].value(), jwl[1].value(), jwl[2].value(), jwl[3].value(), jwl[4].value()};
  return own;
}

Real Charge::volume() const {
  return share * std::numbers::pi / 4 * explosive_diameter() * explosive_diameter() * (bottom_depth() - top);
}

Real Charge::firing_time(std::size_t place) const {
  if (delay_scatter == 0) return delay;
  const std::uint64_t hash = mixed_hash(mixed_hash(0, static_cast<std::uint64_t>(scatter_seed)), place);
  return std::max<Real>(0, delay + delay_scatter * normal_number(hash));
}

}  // namespace sazare::cases
