#pragma once

/// The words in which terms and the schedule speak of pairs.

#include "sazare/core/time.hpp"

namespace sazare {

/// Two bodies on which a force acts and reacts; `second` is `outside` for a force from nowhere (a wall, a load).
struct Link {
  static constexpr Index outside = -1;

  Index first = outside;
  Index second = outside;
};

/// A link that is due.
struct Due {
  Index link = 0;
  Real acting = 0;  ///< time over which the force of this evaluation acts [s]
  Real ahead = 0;   ///< how much of the time given so far lies after now [s]
};

}  // namespace sazare
