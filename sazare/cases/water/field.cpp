#include <cmath>
#include <numbers>

#include "sazare/cases/water/table.hpp"

namespace sazare::cases {
namespace {

constexpr Real degree = std::numbers::pi / 180;

/// The level direction of waves: from that of x, or of y where x is upright, counter-clockwise as seen from above.
Vector3 direction_of(const Water& water, const Vector3& up) {
  constexpr Real upright = 0.99;
  const Vector3 axis = std::abs(up.x()) < upright ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 first = (axis - axis.dot(up) * up).normalized(), second = up.cross(first);
  return std::cos(degree * water.wave_direction) * first + std::sin(degree * water.wave_direction) * second;
}

}  // namespace

laws::WaterField water_field(const Water& water, const Gravity& gravity) {
  laws::WaterField field;
  field.density = water.density;
  field.viscosity = water.viscosity;
  field.gravity = gravity.acceleration.norm();
  field.up = -gravity.acceleration / field.gravity;
  field.level = *water.level;
  if (water.bed) field.bed = *water.bed;
  field.current = water.current;
  field.towards = direction_of(water, field.up);
  field.record = water.record;
  if (water.follows_a_theory())
    field.wave.emplace(laws::PlaneWave::Given{.theory = water.waves,
                                              .height = *water.wave_height,
                                              .period = water.wave_period.value_or(0),
                                              .depth = water.depth(),
                                              .towards = field.towards,
                                              .up = field.up,
                                              .crest = water.wave_crest,
                                              .ramp = water.wave_ramp,
                                              .gravity = field.gravity});
  return field;
}

}  // namespace sazare::cases
