#pragma once

/// A spring and a dashpot side by side, in series with a slider: friction that holds until it slips.
///
///     T = -S x - c v     |T| <= L     x  elastic displacement [m]     v  sliding velocity [m/s]
///
/// S is the stiffness [N/m], c the damping [N s/m], L the force at which it slips [N]. Spring and dashpot together hold no more
/// than L, and the spring is never stretched beyond L/S, whatever the dashpot does: S, c and L change while a contact is pressed
/// together. The memory is x half a step back, m: x = m + h v/2 at the evaluation, and m = x + h v/2 after it, h being the step
/// [s]; so x is the integral of v by the trapezoidal rule.

#include "sazare/core/triple.hpp"

namespace sazare::laws {

template <class Number>
struct SliderForce {
  Triple<Number> force;    ///< T [N]
  Triple<Number> stretch;  ///< x [m]
};

template <class Number>
SliderForce<Number> slide(const Number& stiffness, const Number& damping, const Number& limit, const Triple<Number>& velocity,
                          const Number& step, Triple<Number>& memory) {
  const Number half = 0.5 * step;
  SliderForce<Number> result;
  result.stretch = memory + half * velocity;
  const Number spring = stiffness * stiffness * dot(result.stretch, result.stretch), most = limit * limit;
  if (const auto slips = spring > most; any(slips)) {
    const Number share = select(slips, limit / square_root(spring), Number{} + 1);
    result.stretch = share * result.stretch;
  }
  const Triple<Number> pull = stiffness * result.stretch + damping * velocity;
  result.force = Triple<Number>{} - pull;
  const Number square = dot(pull, pull);
  if (const auto slips = square > most; any(slips)) {
    const Number share = select(slips, limit / square_root(square), Number{} + 1);
    result.force = share * result.force;
  }
  memory = result.stretch + half * velocity;
  return result;
}

}  // namespace sazare::laws
