#include "sazare/cases/clocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

namespace sazare::cases {
namespace {

constexpr Real tolerance = 1e-9;
constexpr Real most_intervals = 1e13;

/// All divisors, smallest first.
std::vector<std::int64_t> divisors(std::int64_t count) {
  std::vector<std::int64_t> small, large;
  for (std::int64_t d = 1; d <= count / d; ++d) {
    if (count % d != 0) continue;
    small.push_back(d);
    if (d != count / d) large.push_back(count / d);
  }
  small.insert(small.end(), large.rbegin(), large.rend());
  return small;
}

}  // namespace

std::optional<std::int64_t> whole_multiple(Real time, Real interval) {
  const Real ratio = time / interval;
  if (!(ratio >= 0.5 && ratio <= most_intervals)) return std::nullopt;
  const Real whole = std::round(ratio);
  if (whole < 1 || std::abs(ratio - whole) > tolerance * whole) return std::nullopt;
  return static_cast<std::int64_t>(whole);
}

std::int64_t nearest_divisor(std::int64_t count, std::int64_t wanted) {
  const Real target = std::log(static_cast<Real>(std::max<std::int64_t>(1, wanted)));
  const auto distance = [&](std::int64_t d) { return std::abs(std::log(static_cast<Real>(d)) - target); };
  return std::ranges::min(divisors(count), {}, distance);
}

std::int64_t nearest_divisor_by_length(std::int64_t count, Real parts) {
  return std::ranges::min(divisors(count), {}, [&](std::int64_t d) { return std::abs(1 / static_cast<Real>(d) - 1 / parts); });
}

Real whole_fraction(Real time, std::int64_t parts) {
  const Real exact = time / static_cast<Real>(parts);
  for (int digits = 0; digits < 17; ++digits) {
    const Real rounded = std::strtod(fmt::format("{:.{}e}", exact, digits).c_str(), nullptr);
    if (whole_multiple(time, rounded) == parts) return rounded;
  }
  return exact;
}

std::optional<Real> round_fraction(Real time, Real interval, std::optional<Real> shorter) {
  std::optional<Real> best;
  const int exponent = static_cast<int>(std::floor(std::log10(interval))) - 1;
  for (int shift = -1; shift <= 1; ++shift) {
    for (int mantissa = 10; mantissa < 100; ++mantissa) {
      const Real candidate = std::strtod(fmt::format("{}e{}", mantissa, exponent + shift).c_str(), nullptr);
      if (candidate < 0.7 * interval || candidate > 1.4 * interval || !whole_multiple(time, candidate)) continue;
      if (shorter && !whole_multiple(candidate, *shorter)) continue;
      if (!best || std::abs(candidate - interval) < std::abs(*best - interval)) best = candidate;
    }
  }
  return best;
}

Real nearest_fraction(Real time, Real interval) {
  const Real fewer = std::clamp<Real>(std::floor(time / interval), 1, most_intervals);
  const bool take_fewer = std::abs(time / fewer - interval) <= std::abs(time / (fewer + 1) - interval);
  return whole_fraction(time, static_cast<std::int64_t>(take_fewer ? fewer : fewer + 1));
}

}  // namespace sazare::cases
