#include <fmt/format.h>

#include <numbers>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/water/keys.hpp"

namespace sazare::cases {

namespace {

std::string explain_waves(const Water& water, const Gravity& gravity) {
  if (water.waves == laws::WaveTheory::none) return "";
  const laws::WaterField field = water_field(water, gravity);
  if (water.waves == laws::WaveTheory::table)
    return line("waves",
                fmt::format("table of {} rows from {} to {} s, along {}", water.record->time.size(),
                            number(water.record->time.front()), number(water.record->time.back()), vector_text(field.towards)));
  std::string wave = fmt::format("{}: {} m high in {} m of water, along {}", word(water.waves), number(*water.wave_height),
                                 number(water.depth()), vector_text(field.towards));
  const Real k = field.wave->number();
  if (water.is_regular())
    wave += fmt::format(", every {} s, {} m long", number(*water.wave_period), number(2 * std::numbers::pi / k));
  if (!water.is_regular()) {
    const Vector3 crest = water.wave_crest * field.towards;
    const Real speed = field.wave->at(crest, field.wave->elevation(crest, 0), 0).velocity.norm();
    wave += fmt::format(", a crest at {} m at t = 0, velocity beneath it {} m/s", number(water.wave_crest), number(speed));
  }
  return line("waves",
              wave + fmt::format("; would break at {} m", number(laws::breaking_height(water.waves, k, water.depth()), 3)));
}

std::string current_text(const Water& water) {
  return water.current.isZero() ? "" : fmt::format(", current {} m/s", vector_text(water.current));
}

}  // namespace

std::string explain_water(const Water& water, const Gravity& gravity) {
  if (!water.is_there()) return "";
  return line("water", fmt::format("level {} m, {} kg/m3, {} Pa s{}", number(*water.level), number(water.density),
                                   number(water.viscosity), current_text(water))) +
         line("", fmt::format("inertia coefficient {}, drag {}", number(water.inertia_coefficient),
                              water.drag_coefficient ? fmt::format("coefficient {}", number(*water.drag_coefficient))
                                                     : std::string("of smooth spheres by the Reynolds number"))) +
         explain_waves(water, gravity);
}

std::string explain_water(const WaterOnFaces& water, const Gravity& gravity) {
  if (!water.is_there()) return "";
  return line("water", fmt::format("level {} m, {} kg/m3{}", number(*water.level), number(water.density), current_text(water))) +
         line("", fmt::format("drag coefficient {} of free faces; no added mass", number(*water.drag_coefficient))) +
         explain_waves(water, gravity);
}

}  // namespace sazare::cases
