#pragma once

/// A spring and a dashpot side by side, in series with a slider: friction that holds until it slips.
///
///     T = -sqrt(S) z - c v     dz/dt = sqrt(S) v     U = z^2/2     |T| <= L
///
/// z    elastic stretch x = z/sqrt(S), times sqrt(S) [sqrt(J)]       U    energy of the spring [J]
/// S    stiffness [N/m]     c  damping [N s/m]     L  force at which it slips [N]     v  sliding velocity [m/s]
///
/// S, c and L change while a contact is pressed together. Since z is remembered and not x, a change of S alone changes no
/// energy: U grows by nothing but the work of T, so that no sequence of pressing and shearing yields work (docs/theory/spheres.md;
/// with x remembered, pressing a stretched spring harder would fill it with energy that nobody has spent).
/// Spring and dashpot together hold no more than L, and the spring alone no more than L either, whatever the dashpot does.
///
/// The memory is z half a step back, m: z = m + h sqrt(S) v/2 at the evaluation, and m = z + h sqrt(S) v/2 after it, h being the
/// step [s]; so z is the integral by the trapezoidal rule. z, v and T are vectors, or numbers where there is one way to slide.

#include "sazare/core/vector_of.hpp"

namespace sazare::laws {

template <class Way>
struct SliderForce {
  Way force;    ///< T [N]
  Way stretch;  ///< z [sqrt(J)]
};

/// A number or a vector times itself.
template <class Number>
Number square_of(const Number& number) {
  return number * number;
}
template <IsVectorOf Vector>
NumberOf<Vector> square_of(const Vector& vector) {
  return dot(vector, vector);
}

/// Energy of the spring [J].
template <class Way>
auto energy_of(const SliderForce<Way>& slid) {
  return 0.5 * square_of(slid.stretch);
}

/// `root` is sqrt(S).
template <class Number, class Way>
SliderForce<Way> slide(const Number& root, const Number& damping, const Number& limit, const Way& velocity, const Number& step,
                       Way& memory) {
  const Number half = 0.5 * step * root, drag = Number{} - damping;
  Way stretch = add_product(half, velocity, memory);
  const Number spring = root * root * square_of(stretch), most = limit * limit;
  if (any_above(spring, most)) stretch = select(spring > most, limit * inverse_square_root(spring), Number{} + 1) * stretch;
  Way force = subtract_product(root, stretch, Way(drag * velocity));
  const Number square = square_of(force);
  if (any_above(square, most)) force = select(square > most, limit * inverse_square_root(square), Number{} + 1) * force;
  memory = add_product(half, velocity, stretch);
  return {force, stretch};
}

}  // namespace sazare::laws
