#include "sazare/methods/blocks/charges/crack_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sazare/core/saturated.hpp"

namespace sazare::methods::blocks {

namespace {

Real opening_area(const Opening& opening, std::span<const GasVessel> vessels) {
  const Real width = std::min(opening.widest, vessels[at(opening.first)].width);
  return opening.length * (opening.second == Opening::outside ? width : std::min(width, vessels[at(opening.second)].width));
}

/// What of a vessel an opening may fill or empty in a step [m3].
Real share_of(const GasVessel& vessel) { return vessel.volume / static_cast<Real>(std::max<Index>(1, vessel.openings)); }

/// The mass that flows in a step through an opening out of a vessel, into another one or into the air.
Real step_mass(const FlowingGas& gas, const GasVessel& from, const GasVessel* to, Real area, Real step) {
  const Real pressure = to == nullptr ? 0 : to->pressure;
  const Real room = to == nullptr ? share_of(from) : std::min(share_of(from), share_of(*to));
  const Real equalizing = (from.pressure - pressure) * room / (from.sound * from.sound);
  return std::min(mass_rate(gas, from, pressure, area) * step, 0.5 * equalizing);
}

int count_steps(const FlowingGas& gas, std::span<const GasVessel> vessels, std::span<const Opening> openings, Real time) {
  Real fastest = 0;
  for (const GasVessel& vessel : vessels) fastest = std::max(fastest, vessel.sound);
  std::vector<Real> leaves(vessels.size(), 0);  // area of the openings of a vessel [m2]
  for (const Opening& opening : openings) {
    leaves[at(opening.first)] += opening_area(opening, vessels);
    if (opening.second != Opening::outside) leaves[at(opening.second)] += opening_area(opening, vessels);
  }
  Real rate = 0;  // with which the gas of the quickest vessel is replaced [1/s]
  for (std::size_t i = 0; i < vessels.size(); ++i)
    if (vessels[i].volume > 0) rate = std::max(rate, gas.discharge * fastest * leaves[i] / vessels[i].volume);
  return saturated<int>(std::clamp<Real>(std::ceil(rate * time), 1, most_flow_steps));
}

void give(GasVessel& vessel, Real mass, Real energy) {
  vessel.mass += mass;
  vessel.energy += energy;
}

GasAmount flow_step(const FlowingGas& gas, std::span<GasVessel> vessels, std::span<const Opening> openings, Real step) {
  GasAmount left;
  std::vector<GasAmount> moved;
  for (const Opening& opening : openings) {
    const GasVessel& first = vessels[at(opening.first)];
    const GasVessel* second = opening.second == Opening::outside ? nullptr : &vessels[at(opening.second)];
    const Real area = opening_area(opening, vessels);
    const bool backwards = second != nullptr && second->pressure > first.pressure;
    const GasVessel& from = backwards ? *second : first;
    const Real mass = from.mass > 0 && from.pressure > 0 ? step_mass(gas, from, backwards ? &first : second, area, step) : 0;
    const Real energy = mass * from.enthalpy();
    moved.push_back(backwards ? GasAmount{-mass, -energy} : GasAmount{mass, energy});
  }
  for (std::size_t i = 0; i < openings.size(); ++i) {
    give(vessels[at(openings[i].first)], -moved[i].mass, -moved[i].energy);
    if (openings[i].second != Opening::outside) {
      give(vessels[at(openings[i].second)], moved[i].mass, moved[i].energy);
      continue;
    }
    left.mass += moved[i].mass;
    left.energy += moved[i].energy;
  }
  for (GasVessel& vessel : vessels) gas.settle(vessel);
  return left;
}

}  // namespace

void FlowingGas::settle(GasVessel& vessel) const {
  vessel.pressure = gas_pressure(*this, vessel.volume, vessel.mass, vessel.energy);
  vessel.sound = 0;
  if (vessel.pressure <= 0) return;
  const Real explosive = vessel.mass / density;
  // Gas that has lost its energy by work would have none that is above 0; no gas is softer than at a constant temperature.
  const Real stiffness = std::max<Real>(1, laws::jwl_exponent(law, vessel.volume / explosive, vessel.energy / explosive));
  vessel.sound = std::sqrt(stiffness * vessel.pressure * vessel.volume / vessel.mass);
}

Real mass_rate(const FlowingGas& gas, const GasVessel& from, Real pressure, Real area) {
  if (!(from.pressure > pressure)) return 0;
  const Real k = gas.exponent(), ratio = pressure / from.pressure;
  const Real drive = ratio > gas.critical_ratio ? gas.drive(ratio) : gas.choked_drive;
  return gas.discharge * area * std::sqrt(2 * k / (k - 1) * from.pressure * from.mass / from.volume * drive);
}

GasAmount flow(const FlowingGas& gas, std::span<GasVessel> vessels, std::span<const Opening> openings, Real time) {
  GasAmount left;
  const int steps = count_steps(gas, vessels, openings, time);
  for (int i = 0; i < steps; ++i) {
    const GasAmount of_step = flow_step(gas, vessels, openings, time / steps);
    left.mass += of_step.mass;
    left.energy += of_step.energy;
  }
  return left;
}

}  // namespace sazare::methods::blocks
