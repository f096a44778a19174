#include "sazare/runs/strength_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sazare::runs {

ReducedStrength ReducedStrength::over(Real factor) const {
  constexpr Real degree = std::numbers::pi / 180;
  ReducedStrength reduced = *this;
  reduced.cohesion /= factor;
  reduced.friction_angle = std::atan(std::tan(friction_angle * degree) / factor) / degree;
  reduced.dilation_angle = std::min(dilation_angle, reduced.friction_angle);
  if (tensile_strength) reduced.tensile_strength = *tensile_strength / factor;
  return reduced;
}

}  // namespace sazare::runs
