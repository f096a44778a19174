#pragma once

/// What water does to a body whose size is small against waves, by the equation of Morison and others [Morison1950] in the form for
/// a body that moves itself. Of a body with the submerged volume V and the area A that water meets,
///
///     F = rho V (g z + C_M du/dt) + 1/2 rho C_D A |u - v| (u - v) - rho (C_M - 1) V dv/dt
///
/// with u the water's velocity and v the body's, C_M = 1 + C_A the coefficient of inertia. The last term is no load but a mass that
/// the body carries along. A sphere that the surface cuts has the volume of its submerged cap; the area is cut in the same
/// proportion.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sazare/laws/water/water_field.hpp"

namespace sazare::laws {

/// A sphere, or what a sphere stands for of a body.
struct BodyInWater {
  Real radius = 0;                            ///< by which the surface cuts it [m]
  Real volume = 0;                            ///< [m3]
  Real area = 0;                              ///< across the flow [m2]
  Real inertia_coefficient = 1.5;             ///< C_M
  std::optional<Real> drag_coefficient = {};  ///< C_D; without one that of a smooth sphere by its Reynolds number
};

/// The share of a sphere's volume that is below a level.
inline Real submerged_share(Real centre, Real radius, Real level) {
  const Real depth = std::clamp((level - centre) / (2 * radius) + 0.5, Real{0}, Real{1});
  return depth * depth * (3 - 2 * depth);
}

/// Force over velocity of a smooth sphere as wide as the area says [N s/m]: C_D = 24/Re (1 + 0.15 Re^0.687), at least 0.44
/// [SchillerNaumann1933].
inline Real sphere_drag(Real area, Real speed, const WaterField& water) {
  const Real width = 2 * std::sqrt(area / std::numbers::pi), reynolds = water.density * speed * width / water.viscosity;
  return std::max(3 * std::numbers::pi * water.viscosity * width * (1 + 0.15 * std::pow(reynolds, 0.687)),
                  0.22 * water.density * area * speed);
}

struct WaterLoad {
  Vector3 force = Vector3::Zero();  ///< without the added mass [N]
  Real added_mass = 0;              ///< [kg]
};

inline WaterLoad water_load(const BodyInWater& body, const Vector3& centre, const Vector3& velocity, const WaterField& water,
                            Real time) {
  const Real surface = water.surface(centre, time), share = submerged_share(water.elevation(centre), body.radius, surface);
  if (!(share > 0)) return {};
  const WaterMotion motion = water.motion(centre, surface, time);
  const Real mass = water.density * body.volume * share;
  const Vector3 relative = motion.velocity - velocity;
  const Real speed = relative.norm(), drag = share * (body.drag_coefficient
                                                          ? 0.5 * water.density * *body.drag_coefficient * body.area * speed
                                                          : sphere_drag(body.area, speed, water));
  return {mass * (water.gravity * water.up + body.inertia_coefficient * motion.acceleration) + drag * relative,
          (body.inertia_coefficient - 1) * mass};
}

}  // namespace sazare::laws
