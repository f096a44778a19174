#include "sazare/cases/water/checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/water/keys.hpp"

namespace sazare::cases {
namespace {

/// H L^2/d^3 above which a Stokes wave of second order has a second crest in its trough, which no wave has: 8 pi^2/3.
constexpr Real largest_ursell_number = 26.3;

using laws::WaveTheory;

Real wave_number_of(const Water& water, Real gravity) {
  return laws::wave_number(2 * std::numbers::pi / *water.wave_period, water.depth(), gravity);
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
  const Real depth = water.depth(), height = *water.wave_height;
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
  if (water.follows_a_theory() && down > 0) check_wave(context, entry, water, down);
  if (water.waves != WaveTheory::table || !entry.gives("wave_file")) return;
  const std::string as_written(*entry.value->find("wave_file")->text());
  if (!check_file(context, entry.place("wave_file"), "table of waves", water.wave_file, as_written)) return;
  read_water_record(water, (context.shown_folder / as_written).lexically_normal().string(), entry.place("wave_file"), context.problems);
  check_record_times(context, entry, water, end);
}

void check_periodic_waves(const CheckContext& context, const Water& water, const Gravity& gravity,
                          const std::array<Real, 3>& lengths) {
  constexpr Real whole = 1e-6;
  if (!water.is_there() || !water.follows_a_theory() || context.problems.has_errors()) return;
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

}  // namespace sazare::cases
