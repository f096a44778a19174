#pragma once

/// How ranks would share the spheres of one process.

#include "sazare/methods/spheres/stepper/levels.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::methods::spheres {

struct SharingForecast {
  std::int64_t fewest = 0, most = 0;  ///< spheres of a rank
  std::int64_t shown = 0;  ///< spheres that a rank shows to others, each counted for each of them: of the rank with most
  std::int64_t bytes = 0;  ///< sent in a base step, by the rank that sends most
};

/// With ranges of as many tiles of each active level for each.
SharingForecast forecast(const SphereLevels& levels, bool with_turns, int ranks);

}  // namespace sazare::methods::spheres
