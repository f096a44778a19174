#pragma once

/// The step of many bodies at a time: kick, then drift.

#include <span>

#include "sazare/core/time.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::motion {

/// How far a body steps.
struct Stride {
  Tick due = 0;      ///< its next own time
  Real seconds = 0;  ///< from now until then
};

/// Kicks the bodies `which`, all of which stand at their own time, and drifts them. All spans have one length; `mean`
/// receives each body's motion midway through its kick.
void step(state::Bodies<3>& bodies, std::span<const Index> which, std::span<const state::Impulse<3>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<3>> mean);
void step(state::Bodies<2>& bodies, std::span<const Index> which, std::span<const state::Impulse<2>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<2>> mean);

}  // namespace sazare::motion
