#pragma once

/// Strengths that scatter as Weibull's distribution says [Weibull, A statistical theory of the strength of materials, 1939]:
///
///     P(s <= x) = 1 - exp(-(x/s0)^m)        m  Weibull modulus: the larger it is, the less strengths scatter
///     mean of s = s0 Gamma(1 + 1/m)

#include <cmath>
#include <cstddef>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

/// Strengths over their mean, in ascending order: those of classes which are equally likely, each the mean of its class.
inline std::vector<Real> weibull_factors(Real modulus, std::size_t classes) {
  constexpr int parts = 64;  // of a class, over which its mean is taken
  std::vector<Real> factors;
  Real sum = 0;
  for (std::size_t i = 0; i < classes; ++i) {
    Real mean = 0;
    for (int part = 0; part < parts; ++part) {
      const Real probability = (static_cast<Real>(i) + (part + 0.5) / parts) / static_cast<Real>(classes);
      mean += std::pow(-std::log1p(-probability), 1 / modulus) / parts;
    }
    factors.push_back(mean);
    sum += mean;
  }
  for (Real& factor : factors) factor *= static_cast<Real>(classes) / sum;
  return factors;
}

}  // namespace sazare::laws
