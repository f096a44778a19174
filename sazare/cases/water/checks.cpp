#include "sazare/cases/water/checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/water/keys.hpp"

namespace sazare::cases {
namespace {

constexpr Real degree = std::numbers::pi / 180;
/// H L^2/d^3 above which a Stokes wave of second order has a second crest in its trough, which no wave has: 8 pi^2/3.
constexpr Real largest_ursell_number = 26.3;

using laws::WaveTheory;

Real depth_of(const Water& water) { return *water.level - *water.bed; }

Real wave_number_of(const Water& water, Real gravity) {
  return laws::wave_number(2 * std::numbers::pi / *water.wave_period, depth_of(water), gravity);
}

void check_directions(const CheckContext& context, const Entry& entry, const Water& water, const Gravity& gravity) {
  if (gravity.acceleration.isZero())
    return context.problems.error(
        entry.place("level"), "[water] needs gravity",
        "its surface is across gravity, and its pressure follows from it: give [gravity] acceleration = [0.0, 0.0, -9.81]");
  constexpr Real level = 1e-6;
  if (std::abs(water.current.dot(gravity.acceleration)) > level * water.current.norm() * gravity.acceleration.norm())
    context.problems.error(entry.place("current"), "the current is not level", "it must be at right angles to gravity");
}

void check_wave_keys(const CheckContext& context, const Entry& entry, const Water& water) {
  switch (water.waves) {
    case WaveTheory::none:
      return check_keys(context, entry, "still water", {},
                        {"wave_height", "wave_period", "wave_direction", "wave_crest", "wave_ramp", "wave_file"});
    case WaveTheory::table:
      return check_keys(context, entry, "a table of waves", {"wave_file"}, {"wave_height", "wave_period", "wave_crest", "wave_ramp"});
    case WaveTheory::solitary:
      return check_keys(context, entry, "a solitary wave", {"bed", "wave_height"}, {"wave_period", "wave_ramp", "wave_file"});
    default:
      return check_keys(context, entry, fmt::format("waves {}", word(water.waves)), {"bed", "wave_height", "wave_period"}, {"wave_file"});
  }
}

void check_wave(const CheckContext& context, const Entry& entry, const Water& water, Real gravity) {
  const Real depth = depth_of(water), height = *water.wave_height;
  const Real k = water.is_regular() ? wave_number_of(water, gravity) : 0;
  if (!std::isfinite(k) || (water.is_regular() && !(k * depth > 1e-12)))
    return context.problems.error(entry.place("wave_period"),
                                  "waves of this period in this depth have no length that can be computed",
                                  "check the period and the bed");
  const Real most = laws::breaking_height(water.waves, k, depth);
  if (height > most)
    return context.problems.error(
        entry.place("wave_height"),
        fmt::format("a wave {} m high breaks in {} m of water: the highest {} is {} m", number(height), number(depth),
                    water.is_regular() ? fmt::format("wave of {} s", number(*water.wave_period)) : "solitary wave", number(most, 3)),
        water.is_regular() ? "Miche's limit is 0.142 L tanh(2 pi d/L); these theories know no broken waves: give a lower wave, or "
                             "measured elevation and velocity as a table"
                           : "McCowan's limit is 0.78 of the depth; give a lower wave, or measured elevation and velocity as a table");
  if (water.waves != WaveTheory::stokes2) return;
  const Real length = 2 * std::numbers::pi / k, ursell = height * length * length / (depth * depth * depth);
  if (ursell > largest_ursell_number)
    context.problems.warning(
        entry.place("waves"),
        fmt::format("the wave is too long for Stokes's second order: H L^2/d^3 is {}, and above {} its trough has a second crest",
                    number(ursell, 3), largest_ursell_number),
        "take a solitary wave, a table, or a lower or shorter wave");
}

/// The level direction of waves: from that of x, or of y where x is upright, counter-clockwise as seen from above.
Vector3 direction_of(const Water& water, const Vector3& up) {
  constexpr Real upright = 0.99;
  const Vector3 axis = std::abs(up.x()) < upright ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 first = (axis - axis.dot(up) * up).normalized(), second = up.cross(first);
  return std::cos(degree * water.wave_direction) * first + std::sin(degree * water.wave_direction) * second;
}

/// A table is constant before its first row and after its last one, which need not be what was meant.
void check_record_times(const CheckContext& context, const Entry& entry, const Water& water, Real end) {
  if (!water.record) return;
  const laws::WaterRecord& record = *water.record;
  if (record.time.front() > 0 && (record.velocity.front() != 0 || record.elevation.front() != 0))
    context.problems.warning(entry.place("wave_file"),
                             fmt::format("the table of waves begins at {} s, and the water is as in its first row before",
                                         number(record.time.front())),
                             "begin it at 0 s, or with still water");
  if (record.time.back() < end && (record.velocity.back() != 0 || record.elevation.back() != 0))
    context.problems.warning(entry.place("wave_file"),
                             fmt::format("the table of waves ends at {} s, and the water goes on as in its last row until {} s",
                                         number(record.time.back()), number(end)),
                             "end it with still water, or end the run with it");
}

}  // namespace

void check_water(const CheckContext& context, Water& water, const Gravity& gravity, Real end) {
  if (!water.is_there()) return;
  const Entry entry = context.entries_of("water").front();
  check_directions(context, entry, water, gravity);
  check_wave_keys(context, entry, water);
  if (water.bed && !(*water.bed < *water.level))
    return context.problems.error(entry.place("bed"), "the bed must be below the water",
                                  fmt::format("the level is {} m", number(*water.level)));
  const Real down = gravity.acceleration.norm();
  const bool is_theory = water.is_regular() || water.waves == WaveTheory::solitary;
  if (is_theory && water.bed && water.wave_height && (water.wave_period || !water.is_regular()) && down > 0)
    check_wave(context, entry, water, down);
  if (water.waves != WaveTheory::table || !entry.gives("wave_file")) return;
  const std::string as_written(*entry.value->find("wave_file")->text());
  if (!check_file(context, entry.place("wave_file"), "table of waves", water.wave_file, as_written)) return;
  read_water_record(water, (context.shown_folder / as_written).lexically_normal().string(), entry.place("wave_file"), context.problems);
  check_record_times(context, entry, water, end);
}

void check_periodic_waves(const CheckContext& context, const Water& water, const Gravity& gravity,
                          const std::array<Real, 3>& lengths) {
  constexpr Real whole = 1e-6;
  const bool is_complete = water.bed && water.wave_height && (water.wave_period || !water.is_regular());
  if (!water.is_there() || !(water.is_regular() || water.waves == WaveTheory::solitary) || !is_complete ||
      context.problems.has_errors())
    return;
  const laws::WaterField field = water_field(water, gravity);
  for (int axis = 0; axis < 3; ++axis) {
    const Real along = lengths[static_cast<std::size_t>(axis)] * field.towards[axis];
    const Real waves = water.is_regular() ? field.wave->number() * std::abs(along) / (2 * std::numbers::pi) : std::abs(along);
    const Real off = water.is_regular() ? std::abs(waves - std::round(waves)) : waves;
    if (off <= whole * std::max(Real{1}, waves)) continue;
    context.problems.error(context.entries_of("water").front().place("waves"),
                           water.is_regular()
                               ? fmt::format("the domain repeats along {} every {} waves, so that they do not fit its sides",
                                             "xyz"[axis], number(waves))
                               : fmt::format("the domain repeats along {}, and a solitary wave does not", "xyz"[axis]),
                           "let waves travel across the periodic axis, or make its length a whole number of wave lengths");
  }
}

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
  if (water.is_regular() || water.waves == WaveTheory::solitary)
    field.wave.emplace(laws::PlaneWave::Given{.theory = water.waves,
                                              .height = *water.wave_height,
                                              .period = water.wave_period.value_or(0),
                                              .depth = depth_of(water),
                                              .towards = field.towards,
                                              .up = field.up,
                                              .crest = water.wave_crest,
                                              .ramp = water.wave_ramp,
                                              .gravity = field.gravity});
  return field;
}

std::string explain_water(const Water& water, const Gravity& gravity) {
  if (!water.is_there()) return "";
  std::string text =
      fmt::format("level {} m, {} kg/m3, {} Pa s", number(*water.level), number(water.density), number(water.viscosity));
  if (!water.current.isZero()) text += fmt::format(", current {} m/s", vector_text(water.current));
  text = line("water", text) +
         line("", fmt::format("inertia coefficient {}, drag {}", number(water.inertia_coefficient),
                              water.drag_coefficient ? fmt::format("coefficient {}", number(*water.drag_coefficient))
                                                     : std::string("of smooth spheres by the Reynolds number")));
  if (water.waves == WaveTheory::none) return text;
  const laws::WaterField field = water_field(water, gravity);
  if (water.waves == WaveTheory::table)
    return text + line("waves", fmt::format("table of {} rows from {} to {} s, along {}", water.record->time.size(),
                                            number(water.record->time.front()), number(water.record->time.back()),
                                            vector_text(field.towards)));
  std::string wave = fmt::format("{}: {} m high in {} m of water, along {}", word(water.waves), number(*water.wave_height),
                                 number(depth_of(water)), vector_text(field.towards));
  const Real k = field.wave->number();
  if (water.is_regular())
    wave += fmt::format(", every {} s, {} m long", number(*water.wave_period), number(2 * std::numbers::pi / k));
  const Vector3 crest = water.wave_crest * field.towards;
  const Real surface = field.wave->elevation(crest, water.wave_ramp);
  const Real speed = field.wave->at(crest, surface, water.is_regular() ? water.wave_ramp : 0).velocity.norm();
  wave += water.is_regular()
              ? ""
              : fmt::format(", a crest at {} m at t = 0, velocity beneath it {} m/s", number(water.wave_crest), number(speed));
  return text + line("waves", wave + fmt::format("; would break at {} m", number(laws::breaking_height(water.waves, k, depth_of(water)), 3)));
}

}  // namespace sazare::cases
