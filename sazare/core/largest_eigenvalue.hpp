#pragma once

/// Largest eigenvalue of a symmetric matrix that is known by its products only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare {

/// y = A x.
using LinearMap = std::function<void(std::span<const Real> x, std::span<Real> y)>;

namespace eigenvalue {

inline constexpr int most_iterations = 600;
inline constexpr int check_every = 10;

/// Numbers between -1 and 1 in which every eigenvector has its part.
inline std::vector<Real> start_vector(std::size_t n) {
  std::vector<Real> x(n);
  std::uint64_t state = 0x9E3779B97F4A7C15ULL;
  for (Real& value : x) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    value = static_cast<Real>(state >> 11) / 4503599627370496.0 - 1;
  }
  return x;
}

inline Real dot(const std::vector<Real>& a, const std::vector<Real>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), Real{0});
}

/// Largest eigenvalue of the tridiagonal matrix, by counting those above a number (Sturm).
inline Real largest_of_tridiagonal(const std::vector<Real>& diagonal, const std::vector<Real>& beside) {
  Real high = 0;
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    high = std::max(high, std::abs(diagonal[i]) + (i > 0 ? beside[i - 1] : 0) + (i < beside.size() ? beside[i] : 0));
  Real low = 0;
  const auto any_above = [&](Real value) {
    Real pivot = diagonal[0] - value;
    for (std::size_t i = 1; i < diagonal.size(); ++i) {
      if (pivot > 0) return true;
      pivot = diagonal[i] - value - beside[i - 1] * beside[i - 1] / (pivot == 0 ? -1e-300 : pivot);
    }
    return pivot > 0;
  };
  for (int halving = 0; halving < 60 && high - low > 1e-14 * high; ++halving) {
    const Real middle = 0.5 * (low + high);
    (any_above(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace eigenvalue

/// Relative error about `tolerance`, of a positive semidefinite matrix of n rows: power iteration in Lanczos's form, which takes
/// the best of all iterates. The starting vector is always the same.
inline Real largest_eigenvalue(std::size_t n, const LinearMap& map, Real tolerance = 1e-7) {
  std::vector<Real> x = eigenvalue::start_vector(n), before(n, 0), y(n);
  std::vector<Real> diagonal, beside;
  map(x, y);  // takes out what the map holds
  x = y;
  Real length = std::sqrt(eigenvalue::dot(x, x)), found = 0;
  for (int iteration = 1; iteration <= eigenvalue::most_iterations && length > 0; ++iteration) {
    for (Real& value : x) value /= length;
    map(x, y);
    diagonal.push_back(eigenvalue::dot(x, y));
    for (std::size_t i = 0; i < n; ++i) y[i] -= diagonal.back() * x[i] + (beside.empty() ? 0 : beside.back()) * before[i];
    before = x;
    x = y;
    length = std::sqrt(eigenvalue::dot(x, x));
    const bool exhausted = length <= 1e-12 * diagonal.front();
    if (iteration % eigenvalue::check_every == 0 || exhausted || iteration == eigenvalue::most_iterations) {
      const Real latest = eigenvalue::largest_of_tridiagonal(diagonal, beside);
      if (exhausted || std::abs(latest - found) <= tolerance * latest) return latest;
      found = latest;
    }
    beside.push_back(length);
  }
  return found;
}

}  // namespace sazare
