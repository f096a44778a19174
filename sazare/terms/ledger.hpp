#pragma once

/// Where energy went. Work comes in; everything else is a place where it is now, or a cause that took it for good.

#include <array>
#include <cstddef>
#include <numeric>

#include "sazare/core/vector.hpp"

namespace sazare::terms {

enum class Account {
  work,     ///< done on the bodies by loads and by gravity
  kinetic,  ///< gained since the beginning
  elastic,  ///< stored in joints, contacts and boundaries
  joint_dashpot,
  slip,  ///< of bonded joints on the Coulomb line
  fracture,
  release,  ///< elastic energy left in joints when their faces came apart
  contact_dashpot,
  friction,  ///< of contacts
  boundary,  ///< dashpots of absorbing and fixed outer faces
};

inline constexpr std::size_t account_count = 10;

struct Ledger {
  std::array<Real, account_count> joules{};

  Real& operator[](Account account) { return joules[static_cast<std::size_t>(account)]; }
  Real operator[](Account account) const { return joules[static_cast<std::size_t>(account)]; }

  /// Work that is found nowhere [J].
  Real residual() const { return joules[0] - std::accumulate(joules.begin() + 1, joules.end(), Real{0}); }
};

}  // namespace sazare::terms
