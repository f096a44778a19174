#pragma once

/// A central impact of two spheres in steps, as the stepper takes them.

#include "sazare/laws/granular_contact.hpp"

namespace sazare::laws {

/// Speed after the impact over that before it, from spheres that are `gap` apart at the first step [m]. Where dashpots are as
/// strong as asked for, and the contact lasts for many steps, it is the coefficient of restitution. 0 where they do not part.
template <class Law>
Real rebound(const ContactConstants<Real>& constants, const Reduced<Real>& radius, Real mass, Real speed, Real step, Real gap) {
  constexpr int most_steps = 1'000'000;
  Real apart = gap, velocity = -speed, acceleration = 0;
  for (int n = 0; n < most_steps; ++n) {
    apart += step * velocity;
    Real now = 0;
    if (apart < 0) {
      ContactMemory<Real> memory{};
      SlipBands<Real> bands;
      ContactMotion<Real> at{.overlap = -apart,
                             .radius = radius,
                             .mass = Reduced<Real>::alone(mass),
                             .normal = {0, 0, 1},
                             .velocity = {0, 0, velocity + 0.5 * step * acceleration},
                             .rolling = {},
                             .twisting = 0,
                             .step = step,
                             .tilt = {},
                             .turn = 0};
      now = contact_force<Law, false>(constants, at, memory, &bands).normal / mass;
    }
    velocity += step * now;
    acceleration = now;
    if (apart >= 0 && velocity >= 0) return velocity / speed;
  }
  return 0;
}

/// The rebound that is farthest from the coefficient of restitution, among those from several places at the first step.
template <class Law>
Real worst_rebound(const ContactConstants<Real>& constants, Real restitution, const Reduced<Real>& radius, Real mass, Real speed,
                   Real step) {
  constexpr int places = 4;
  Real worst = restitution;
  for (int n = 0; n < places; ++n) {
    const Real found = rebound<Law>(constants, radius, mass, speed, step, (n + 0.5) / places * speed * step);
    if (std::abs(found - restitution) > std::abs(worst - restitution)) worst = found;
  }
  return worst;
}

}  // namespace sazare::laws
