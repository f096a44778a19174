#pragma once

/// Time is an integer count of ticks; seconds are derived from it and never summed up.

#include <cstddef>
#include <cstdint>
#include <limits>

#include "sazare/core/vector.hpp"

namespace sazare {

using Tick = std::int64_t;
using Index = std::int32_t;

/// An index as containers take it.
constexpr std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// A point in time, as every part of a step needs it.
struct Instant {
  Tick tick = 0;
  Real tick_seconds = 0;  ///< length of a tick [s]
  Tick start = 0;         ///< the tick at which time is 0; `not_begun` while bodies still come to rest

  static constexpr Tick not_begun = std::numeric_limits<Tick>::max();
  bool has_begun() const { return tick >= start; }
  /// Long before 0 as long as time has not begun: what acts from a time on does not act yet.
  Real seconds() const { return static_cast<Real>(tick - start) * tick_seconds; }
  Real seconds_since(Tick earlier) const { return static_cast<Real>(tick - earlier) * tick_seconds; }
};

}  // namespace sazare
