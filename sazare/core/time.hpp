#pragma once

/// Time is an integer count of ticks; seconds are derived from it and never summed up.

#include <cstddef>
#include <cstdint>

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

  Real seconds() const { return static_cast<Real>(tick) * tick_seconds; }
  Real seconds_since(Tick earlier) const { return static_cast<Real>(tick - earlier) * tick_seconds; }
};

}  // namespace sazare
