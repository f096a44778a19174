#pragma once

/// The step of many bodies at a time: kick, then drift.

#include <limits>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::motion {

/// How far a body steps.
struct Stride {
  Tick now = 0;                                                  ///< its own time, at which it is kicked
  Tick due = 0;                                                  ///< its next one
  Real seconds = 0;                                              ///< from now until then
  Real fastest_squared = std::numeric_limits<Real>::infinity();  ///< of the speeds after the kick for which this is right [m2/s2]
};

/// Kicks the bodies `which`, all of which stand at their own time, and drifts them. All spans have one length; `given` is about
/// the pole, and `mean` receives each body's motion there, midway through its kick. A body that would be faster than its stride
/// allows is left as it is: its place in the spans is added to `too_fast`.
void step(state::Bodies<3>& bodies, std::span<const Index> which, std::span<const state::Impulse<3>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<3>> mean, std::vector<std::size_t>& too_fast);
void step(state::Bodies<2>& bodies, std::span<const Index> which, std::span<const state::Impulse<2>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<2>> mean, std::vector<std::size_t>& too_fast);

}  // namespace sazare::motion
