#pragma once

/// How the plane of a contact turns from one step to the next, and with it what lies in it, as the stretches of friction do.
///
///     x' = c x + s n x x + p/2 t - (...) n     p = x . n
///
/// n    normal now                        t    tilt: how the normal has moved since the last step, across it [rad]
/// c,s  cosine and sine of the turn about the normal since the last step
///
/// The turn of a step is exact to its third order, and lengthens nothing: c^2 + s^2 does not exceed 1, and the part in the tilt
/// keeps its length as far as t is the difference of the two normals.

#include "sazare/core/vector_of.hpp"

namespace sazare::laws {

template <class Number>
class PlaneTurn {
public:
  /// `turn` is about the normal [rad]; what the tilt has along the normal does nothing.
  PlaneTurn(const VectorOf<Number>& normal, const VectorOf<Number>& tilt, const Number& turn)
      : normal_(normal),
        tilt_(tilt),
        along_(dot(tilt, normal)),
        cosine_(1.0 - 0.5 * turn * turn),
        sine_(turn * (1.0 - 1.0 / 6 * turn * turn)) {}

  /// A vector that lay in the plane before, carried along: what sticks out of the plane now is taken off, and half of it comes
  /// back along the tilt.
  VectorOf<Number> carried(const VectorOf<Number>& vector) const {
    const Number out = dot(vector, normal_), half = 0.5 * out;
    const VectorOf<Number> turned = add_product(sine_, cross(normal_, vector), cosine_ * vector),
                         tilted = add_product(half, tilt_, turned);
    return subtract_product(add_product(half, along_, Number(cosine_ * out)), normal_, tilted);
  }

private:
  VectorOf<Number> normal_, tilt_;
  Number along_, cosine_, sine_;
};

}  // namespace sazare::laws
