#pragma once

#include <cstdint>
#include <optional>

#include "sazare/core/vector.hpp"

/// Clocks nest when each interval is a whole number of the next shorter one.
namespace sazare::cases {

/// How many times `interval` fits into `time`, when that is a whole number (within 1e-9 of itself) and at
/// least one.
std::optional<std::int64_t> whole_multiple(Real time, Real interval);

/// The divisor of `count` nearest to `wanted`, by ratio.
std::int64_t nearest_divisor(std::int64_t count, std::int64_t wanted);

/// The divisor d of `count` for which 1 / d is nearest to 1 / `parts`.
std::int64_t nearest_divisor_by_length(std::int64_t count, Real parts);

/// `time / parts` in as few digits as will do.
Real whole_fraction(Real time, std::int64_t parts);

/// A whole fraction of `time` near `interval` (between 0.7 and 1.4 of it) in one or two digits, that is also
/// a whole multiple of `shorter` where that is given.
std::optional<Real> round_fraction(Real time, Real interval, std::optional<Real> shorter);

/// The whole fraction of `time` nearest to `interval`.
Real nearest_fraction(Real time, Real interval);

}  // namespace sazare::cases
