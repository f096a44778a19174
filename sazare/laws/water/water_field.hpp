#pragma once

/// Water around bodies: where its surface is, and how it moves.

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sazare/laws/water/plane_wave.hpp"

namespace sazare::laws {

/// Elevation of the surface above still water and horizontal velocity of the water, both the same everywhere. Linear between
/// samples; before the first and after the last one they are those of these.
struct WaterRecord {
  std::vector<Real> time;       ///< increasing [s]
  std::vector<Real> elevation;  ///< [m]
  std::vector<Real> velocity;   ///< [m/s]
};

/// What a record says at a time.
struct WaterSample {
  Real elevation = 0, velocity = 0, acceleration = 0;  ///< [m; m/s; m/s2]
};

inline WaterSample sample(const WaterRecord& record, Real time) {
  const auto after = std::ranges::upper_bound(record.time, time);
  const auto n = static_cast<std::size_t>(after - record.time.begin());
  if (n == 0) return {record.elevation.front(), record.velocity.front(), 0};
  if (n == record.time.size()) return {record.elevation.back(), record.velocity.back(), 0};
  const Real length = record.time[n] - record.time[n - 1], share = (time - record.time[n - 1]) / length;
  const auto between = [&](const std::vector<Real>& of) { return of[n - 1] + share * (of[n] - of[n - 1]); };
  return {between(record.elevation), between(record.velocity), (record.velocity[n] - record.velocity[n - 1]) / length};
}

struct WaterField {
  Real density = 1000;     ///< [kg/m3]
  Real viscosity = 1e-3;   ///< dynamic [Pa s]
  Real gravity = 9.80665;  ///< [m/s2]
  Vector3 up = Vector3::UnitZ();  ///< against gravity, of length 1; elevations are places along it
  Real level = 0;          ///< elevation of the still water [m]
  Real bed = -std::numeric_limits<Real>::infinity();  ///< elevation of the bed, at which the water ends [m]
  Vector3 current = Vector3::Zero();                  ///< horizontal velocity that is everywhere [m/s]
  Vector3 towards = Vector3::UnitX();                 ///< in which a record's velocity goes
  std::optional<PlaneWave> wave;
  std::shared_ptr<const WaterRecord> record;

  Real elevation(const Vector3& at) const { return up.dot(at); }
  /// Elevation of the surface at a place, seen from above [m].
  Real surface(const Vector3& at, Real time) const {
    if (wave) return level + wave->elevation(at, time);
    return record ? level + sample(*record, time).elevation : level;
  }

  /// That the water has anywhere, at any time [m/s], or somewhat less.
  Real largest_speed() const {
    Real speed = current.norm();
    if (wave) speed += wave->largest_speed();
    Real of_record = 0;
    if (record)
      for (const Real velocity : record->velocity) of_record = std::max(of_record, std::abs(velocity));
    return speed + of_record;
  }

  /// Of the water at a place that is not above the surface, whose elevation there is given.
  WaterMotion motion(const Vector3& at, Real surface, Real time) const {
    WaterMotion motion;
    if (wave) motion = wave->at(at, std::clamp(elevation(at), std::min(bed, surface), surface) - level, time);
    if (record) {
      const WaterSample of = sample(*record, time);
      motion = {of.velocity * towards, of.acceleration * towards};
    }
    motion.velocity += current;
    return motion;
  }
};

/// The same water at rest.
inline WaterField without_motion(WaterField water) {
  water.current = Vector3::Zero();
  water.wave.reset();
  water.record.reset();
  return water;
}

}  // namespace sazare::laws
