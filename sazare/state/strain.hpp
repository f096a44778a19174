#pragma once

/// How bodies are strained, beside their motion as rigid bodies. A point that is at X from the centre of the unstrained body, in
/// the body frame, is at
///
///     x = position + R (1 + E) X        E  strain, symmetric: that of Biot, for R is the rotation of the polar decomposition
///
/// The kinetic energy is that of the rigid motion and j/2 dE/dt : dE/dt, so a step solves no equations: of second order in the
/// size of the body over the wavelength, it is not what decides how waves run. A body whose j is infinite is rigid.

#include "sazare/core/symmetric_tensor.hpp"
#include "sazare/core/time.hpp"

namespace sazare::state {

/// Lanes read the first twelve numbers at once. As in `Motion`, what forces need stands at the body's next own time.
struct alignas(64) Strain {
  Vector6 strain = Vector6::Zero();          ///< E at `due`
  Vector6 predicted_rate = Vector6::Zero();  ///< dE/dt at `due` [1/s]
  Vector6 rate = Vector6::Zero();            ///< from `last_kick` to `due` [1/s]
  Real inverse_inertia = 0;                  ///< 1/j [1/(kg m2)]; 0: rigid
};
static_assert(sizeof(Strain) == 24 * sizeof(Real));

/// At an instant, for energies and output.
struct StrainNow {
  Vector6 strain = Vector6::Zero();  ///< E
  Vector6 ahead = Vector6::Zero();   ///< mean of the rates now and after the last kick [1/s], see terms::Synchronized
  Vector6 rate = Vector6::Zero();    ///< dE/dt [1/s]
};

/// What the strain of one body receives at a kick, as `Impulse` is what its motion receives.
struct StrainImpulse {
  Vector6 given = Vector6::Zero();  ///< [N m s]
  Vector6 lead = Vector6::Zero();   ///< what the momentum j dE/dt gains by the body's next time [N m s]
};

}  // namespace sazare::state
