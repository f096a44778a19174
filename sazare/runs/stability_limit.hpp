#pragma once

/// The limit step of a case by trial, as studies seek it.

#include <cmath>
#include <cstdint>

#include "sazare/core/vector.hpp"

namespace sazare::runs {

struct LimitRules {
  Real ratio = 1.01;          ///< of the two steps, at which the search ends
  std::int64_t steps = 4000;  ///< of a trial; 0: to the end of the case
  Real divergence = 1e15;     ///< acceleration above which a trial has diverged [m/s2]
};

struct FoundLimit {
  Real predicted = 0;  ///< from the linearised operator [s]
  Real stable = 0;     ///< largest step of a trial that held [s]
  Real unstable = 0;   ///< smallest step of a trial that diverged [s]
  int trials = 0;
  std::int64_t particles = 0;

  Real limit() const { return std::sqrt(stable * unstable); }  ///< geometric mean of the two [s]
};

}  // namespace sazare::runs
