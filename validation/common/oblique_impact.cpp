#include "validation/common/oblique_impact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::validation {

namespace {

constexpr Real degree = std::numbers::pi / 180;

Real moment_of_inertia(const ObliqueImpact& impact) { return 0.4 * impact.mass() * impact.radius * impact.radius; }

/// How long a central impact without damping lasts [s].
Real duration(const ObliqueImpact& impact) {
  const Real modulus = 0.75 * impact.constants().normal, mass = impact.mass();
  return 2.868265 * std::pow(mass * mass / (impact.radius * modulus * modulus * impact.normal_speed()), 0.2);
}

/// From the velocity of the centre along the wall and away from it, and the spin that friction has given.
Rebound told(const ObliqueImpact& impact, Real along, Real away, Real spin) {
  Rebound told;
  told.tangential = along / impact.tangential_speed();
  told.angle = std::atan2(along, away) / degree;
  told.spin = spin;
  told.psi = impact.psi_scale() * (along - impact.radius * spin) / impact.normal_speed();
  return told;
}

}  // namespace

Real ObliqueImpact::normal_speed() const { return speed * std::cos(angle * degree); }
Real ObliqueImpact::tangential_speed() const { return speed * std::sin(angle * degree); }
Real ObliqueImpact::mass() const { return density * 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

laws::ContactConstants<Real> ObliqueImpact::constants() const {
  return laws::hertz_constants(ball, wall, restitution, {.sliding = friction});
}

Real ObliqueImpact::psi_scale() const { return constants().tangential / (1.5 * constants().normal) / friction; }

Rebound rebound(const ObliqueImpact& impact, laws::ContactModel model, int steps) {
  parallel::set_threads(1);
  state::Spheres spheres;
  spheres.add({0, 0, impact.radius}, impact.radius, impact.density, 0);
  spheres.set_motion(0, {impact.tangential_speed(), 0, -impact.normal_speed()}, Vector3::Zero());
  methods::spheres::ContactTable table(model, 1);
  table.set(0, 0, impact.constants());
  const Real step = duration(impact) / steps;
  methods::spheres::SphereStepper stepper(std::move(spheres), table, std::vector<methods::spheres::Wall>(1),
                                          {step, Vector3::Zero(), impact.radius, impact.radius});
  stepper.start();
  bool met = false;
  for (int k = 0; k < 8 * steps && !(met && stepper.contacts() == 0); ++k) {
    stepper.advance();
    stepper.evaluate_now();
    met = met || stepper.contacts() > 0;
  }
  return told(impact, stepper.velocity(0).x(), stepper.velocity(0).z(), stepper.spin(0).y());
}

Rebound rebound_of_theory(const ObliqueImpact& impact, int springs, int steps) {
  const auto constants = impact.constants();
  const Real mass = impact.mass(), radius = impact.radius, inertia = moment_of_inertia(impact), step = duration(impact) / steps;
  const Real deepest =
      std::pow(1.25 * mass * impact.normal_speed() * impact.normal_speed() / (constants.normal * std::sqrt(radius)), 0.4);
  const Real apart = 1.01 * std::sqrt(radius * deepest) / springs, stiffness = constants.tangential * apart;
  std::vector<Real> stretch(static_cast<std::size_t>(springs), 0);
  // Leapfrog: the speeds are half a step behind the depth and the stretches.
  Real depth = 0, sinking = impact.normal_speed(), along = impact.tangential_speed(), spin = 0;
  while (true) {
    depth += step * sinking;
    if (depth <= 0) break;
    const Real slid = step * (along - radius * spin), width = std::sqrt(radius * depth);
    Real friction = 0;
    for (std::size_t n = 0; n < stretch.size(); ++n) {
      const Real place = (static_cast<Real>(n) + 0.5) * apart;
      // A spring bears 3/2 of the mean load at the middle of the contact and none at its edge.
      const Real limit = impact.friction * 1.5 * constants.normal / radius * (width * width - place * place) * apart;
      if (!(limit > 0)) {
        stretch[n] = 0;
        continue;
      }
      const Real force = stiffness * (stretch[n] + slid);
      stretch[n] = std::clamp(force, -limit, limit) / stiffness;
      friction += std::clamp(force, -limit, limit);
    }
    sinking -= step * constants.normal * width * depth / mass;
    along -= step * friction / mass;
    spin += step * friction * radius / inertia;
  }
  return told(impact, along, -sinking, spin);
}

}  // namespace sazare::validation
