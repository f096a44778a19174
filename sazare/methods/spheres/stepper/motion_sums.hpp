#pragma once

/// What spheres and clumps hold by their motion and their place, added up without rounding: the sums do not depend on the order
/// of the spheres, and those of parts of them can be added.

#include "sazare/core/exact_vector.hpp"

namespace sazare::methods::spheres {

struct MotionEnergies {
  ExactSum translation;  ///< [J]
  ExactSum rotation;     ///< [J]
  ExactSum potential;    ///< of gravity [J]
  ExactSum carried;      ///< kinetic energy of the water that is carried along [J]

  MotionEnergies& operator+=(const MotionEnergies& more) {
    translation += more.translation;
    rotation += more.rotation;
    potential += more.potential;
    carried += more.carried;
    return *this;
  }
};

struct Momenta {
  ExactVector linear;   ///< [kg m/s]
  ExactVector angular;  ///< about the origin [kg m2/s]

  Momenta& operator+=(const Momenta& more) {
    linear += more.linear;
    angular += more.angular;
    return *this;
  }
};

/// What a mean velocity follows from.
struct MassFlow {
  ExactSum mass;         ///< [kg]
  ExactVector momentum;  ///< [kg m/s]

  MassFlow& operator+=(const MassFlow& more) {
    mass += more.mass;
    momentum += more.momentum;
    return *this;
  }
};

/// What tells how far spheres that fall are from rest.
struct UnrestSums {
  ExactSum mass;           ///< of what may move [kg]
  ExactSum square_forces;  ///< divided by masses [N2/kg]
  ExactSum radius;         ///< of all spheres [m]

  UnrestSums& operator+=(const UnrestSums& more) {
    mass += more.mass;
    square_forces += more.square_forces;
    radius += more.radius;
    return *this;
  }
};

}  // namespace sazare::methods::spheres
