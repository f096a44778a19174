#pragma once

/// An elastic ball that hits a wall obliquely, by method `spheres` and by the theory.

#include "sazare/core/vector.hpp"
#include "sazare/laws/granular/contact_laws.hpp"

namespace sazare::validation {

struct ObliqueImpact {
  laws::GrainElasticity ball, wall;
  Real density = 0;      ///< [kg/m3]
  Real radius = 0;       ///< [m]
  Real friction = 0;     ///< [-]
  Real restitution = 1;  ///< [-]
  Real speed = 0;        ///< [m/s]
  Real angle = 0;        ///< to the normal [deg]

  Real normal_speed() const;
  Real tangential_speed() const;
  Real mass() const;
  laws::ContactConstants<Real> constants() const;
  /// psi of Maw, Barber and Fawcett over the ratio of a tangential velocity of the contact to the normal speed.
  Real psi_scale() const;
};

struct Rebound {
  Real tangential = 0;  ///< velocity of the centre along the wall, after over before [-]
  Real angle = 0;       ///< to the normal [deg]
  Real spin = 0;        ///< [rad/s]
  Real psi = 0;         ///< of the velocity of the contact [-]
};

/// By method `spheres` with a model of contact, in steps of which this many fill the contact.
Rebound rebound(const ObliqueImpact& impact, laws::ContactModel model, int steps = 4000);

/// By the theory: Hertz along the normal, and across it a row of springs that each hold their part of mu N at most. Elastic
/// impacts alone.
Rebound rebound_of_theory(const ObliqueImpact& impact, int springs = 2000, int steps = 4000);

}  // namespace sazare::validation
