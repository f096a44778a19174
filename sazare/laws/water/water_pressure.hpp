#pragma once

/// Pressure of still water, of water under a base, and the mass of water that moves with a wall.
///
///     p = rho g (h - z)     where h > z, else 0       z   elevation [m]               h  level of the water there [m]
///     h = h0 + i . (x - x0)                           h0  level at x0 [m]             i  its slope along the base, else 0 [-]
///     m = 7/8 rho sqrt(H y)                           y   depth below the level [m]   H  depth of the water at the wall [m]
///
/// m is the mass per area that gives the largest pressures of incompressible water on a rigid vertical wall, nearly: the parabola
/// of Westergaard, Trans. ASCE 98 (1933) 418-433. A level that falls evenly along a base gives the trapezium of uplift under
/// gravity structures.

#include <algorithm>
#include <cmath>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct WaterPressure {
  Real specific_weight = 0;         ///< rho g [N/m3]
  int up = 1;                       ///< the axis of elevations
  Real level = 0;                   ///< h0 [m]
  Vector3 from = Vector3::Zero();   ///< x0 [m]
  Vector3 slope = Vector3::Zero();  ///< i, horizontal [-]

  /// h - z: how far the water stands above a place [m].
  Real depth(const Vector3& place) const { return level + slope.dot(place - from) - place[up]; }
  /// p [Pa]
  Real pressure(const Vector3& place) const { return specific_weight * std::max(depth(place), Real{0}); }
};

/// m [kg/m2]; 0 above the level.
inline Real westergaard_mass(Real density, Real water_depth, Real depth) {
  return depth > 0 ? 0.875 * density * std::sqrt(water_depth * depth) : 0;
}

}  // namespace sazare::laws
