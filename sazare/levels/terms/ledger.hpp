#pragma once

/// The energy balance. Work is done on the bodies; all other parts are energy that is stored, or dissipated by a cause.

#include <array>
#include <cstddef>
#include <numeric>

#include "sazare/core/exact_sum.hpp"

namespace sazare::terms {

enum class Account {
  work,     ///< done on the bodies by loads and by gravity
  kinetic,  ///< increase since the beginning
  elastic,  ///< stored in joints, contacts and boundaries
  joint_dashpot,
  slip,  ///< of bonded joints on the Coulomb line
  fracture,
  release,  ///< elastic energy of joints that is lost when their faces open
  contact_dashpot,
  friction,  ///< of contacts
  boundary,  ///< dashpots of absorbing and fixed outer faces
};

inline constexpr std::size_t account_count = 10;

struct Ledger {
  std::array<Real, account_count> joules{};

  Real& operator[](Account account) { return joules[static_cast<std::size_t>(account)]; }
  Real operator[](Account account) const { return joules[static_cast<std::size_t>(account)]; }

  /// Work that is neither stored nor dissipated [J].
  Real residual() const { return joules[0] - std::accumulate(joules.begin() + 1, joules.end(), Real{0}); }
};

/// An energy balance that is being added up. Its sums are exact, so they do not depend on the order, nor on the number of
/// threads and processes that find the parts.
struct Books {
  std::array<ExactSum, account_count> joules{};

  ExactSum& operator[](Account account) { return joules[static_cast<std::size_t>(account)]; }

  Books& operator+=(const Books& other) {
    for (std::size_t account = 0; account < account_count; ++account) joules[account] += other.joules[account];
    return *this;
  }

  Ledger ledger() const {
    Ledger sums;
    for (std::size_t account = 0; account < account_count; ++account) sums.joules[account] = joules[account].value();
    return sums;
  }
};

}  // namespace sazare::terms
