#pragma once

/// The energy balance. Work is done on the bodies; all other parts are energy that is stored, or dissipated by a cause.

#include <array>
#include <cstddef>
#include <numeric>

#include "sazare/core/exact_sum.hpp"

namespace sazare::terms {

enum class EnergyKind {
  work,     ///< done on the bodies by loads and by gravity
  kinetic,  ///< increase since the beginning
  elastic,  ///< stored in joints, contacts and boundaries, beyond what was stored at the beginning
  joint_dashpot,
  slip,  ///< of bonded joints on the Coulomb line
  fracture,
  release,  ///< elastic energy of joints that is lost when their faces open
  contact_dashpot,
  friction,  ///< of contacts
  boundary,  ///< dashpots of absorbing and fixed outer faces
};

inline constexpr std::size_t energy_kind_count = 10;

struct EnergyBalance {
  std::array<Real, energy_kind_count> joules{};

  Real& operator[](EnergyKind kind) { return joules[static_cast<std::size_t>(kind)]; }
  Real operator[](EnergyKind kind) const { return joules[static_cast<std::size_t>(kind)]; }

  /// Work that is neither stored nor dissipated [J].
  Real residual() const { return joules[0] - std::accumulate(joules.begin() + 1, joules.end(), Real{0}); }
};

/// An energy balance that is being added up. Its sums are exact, so they do not depend on the order, nor on the number of
/// threads and processes that find the parts.
struct EnergySums {
  std::array<ExactSum, energy_kind_count> joules{};

  ExactSum& operator[](EnergyKind kind) { return joules[static_cast<std::size_t>(kind)]; }

  EnergySums& operator+=(const EnergySums& other) {
    for (std::size_t kind = 0; kind < energy_kind_count; ++kind) joules[kind] += other.joules[kind];
    return *this;
  }

  EnergyBalance balance() const {
    EnergyBalance sums;
    for (std::size_t kind = 0; kind < energy_kind_count; ++kind) sums.joules[kind] = joules[kind].value();
    return sums;
  }
};

}  // namespace sazare::terms
