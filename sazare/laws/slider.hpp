#pragma once

/// A spring and a dashpot side by side, in series with a slider: friction that holds until it slips.
///
///     T = -S x - c v     |T| <= L     x  elastic displacement [m]     v  sliding velocity [m/s]
///
/// S is the stiffness [N/m], c the damping [N s/m], L the force at which it slips [N]. Spring and dashpot together hold no more
/// than L, and the spring is never stretched beyond L/S, whatever the dashpot does: S, c and L change while a contact is pressed
/// together. The memory is x half a step back, m: x = m + h v/2 at the evaluation, and m = x + h v/2 after it, h being the step
/// [s]; so x is the integral of v by the trapezoidal rule. x, v and T are vectors, or numbers where there is one way to slide.

#include "sazare/core/vector_of.hpp"

namespace sazare::laws {

template <class Way>
struct SliderForce {
  Way force;    ///< T [N]
  Way stretch;  ///< x [m]
};

template <class Number>
Number square_of(const Number& number) {
  return number * number;
}
template <IsVectorOf Vector>
NumberOf<Vector> square_of(const Vector& vector) {
  return dot(vector, vector);
}

template <class Number, class Way>
SliderForce<Way> slide(const Number& stiffness, const Number& damping, const Number& limit, const Way& velocity,
                       const Number& step, Way& memory) {
  const Number half = 0.5 * step, drag = Number{} - damping;
  Way stretch = add_product(half, velocity, memory);
  const Number spring = stiffness * stiffness * square_of(stretch), most = limit * limit;
  if (any_above(spring, most)) stretch = select(spring > most, limit * inverse_square_root(spring), Number{} + 1) * stretch;
  Way force = subtract_product(stiffness, stretch, Way(drag * velocity));
  const Number square = square_of(force);
  if (any_above(square, most)) force = select(square > most, limit * inverse_square_root(square), Number{} + 1) * force;
  memory = add_product(half, velocity, stretch);
  return {force, stretch};
}

}  // namespace sazare::laws
