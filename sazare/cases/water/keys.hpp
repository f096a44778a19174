#pragma once

#include <array>

#include "sazare/cases/format/enum_words.hpp"
#include "sazare/cases/format/schema.hpp"
#include "sazare/cases/water/table.hpp"

namespace sazare::cases {

template <>
struct EnumWords<laws::WaveTheory> {
  static constexpr auto& words = laws::wave_theory_words;
};

inline constexpr std::array water_keys{
    Key{.name = "level",
        .type = Type::number,
        .unit = "m",
        .need = Need::required,
        .sentence = "Elevation of the still water's surface: along z where gravity acts along -z, in general against gravity."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = {.low = 1e-3, .high = 1e5},
        .usual = {950, 1300},
        .default_text = "1000.0",
        .sentence = "Mass per volume of the water; sea water 1025."},
    Key{.name = "viscosity",
        .type = Type::number,
        .unit = "Pa s",
        .range = positive,
        .usual = {1e-4, 1},
        .default_text = "1e-3",
        .sentence = "Dynamic viscosity, which decides the drag of small or slow spheres without a drag_coefficient."},
    Key{.name = "drag_coefficient",
        .type = Type::number,
        .range = {.low = 0, .high = 100},
        .usual = {0.1, 5},
        .note = "default: that of a smooth sphere by its Reynolds number",
        .sentence = "Drag coefficient of bodies; their area is that of a sphere of their volume. A group may have its own."},
    Key{.name = "inertia_coefficient",
        .type = Type::number,
        .range = {.low = 1},
        .usual = {1, 3},
        .default_text = "1.5",
        .sentence =
            "Inertia coefficient C_M of Morison's equation: 1 and the coefficient of added mass, which is 0.5 for a sphere. A "
            "group may have its own."},
    Key{.name = "current",
        .type = Type::vector,
        .unit = "m/s",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Horizontal velocity of all the water, to which that of waves is added."},
    Key{.name = "waves",
        .type = Type::choice,
        .default_text = "\"none\"",
        .sentence = "Still water, linear (Airy) waves, Stokes waves of second order, a solitary wave, or a table of surface "
                    "elevation and "
                    "velocity over time.",
        .choices = laws::wave_theory_words},
    Key{.name = "bed",
        .type = Type::number,
        .unit = "m",
        .note = "required for waves by a theory",
        .sentence = "Elevation of the level bed over which waves travel, below the water."},
    Key{.name = "wave_height",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "required for waves by a theory",
        .sentence = "Height of the waves from trough to crest."},
    Key{.name = "wave_period",
        .type = Type::number,
        .unit = "s",
        .range = {.low = 1e-3, .high = 1e5},
        .usual = {0.1, 1800},
        .note = "required for airy and stokes2",
        .sentence = "Wave period; the wave length follows from the dispersion relation."},
    Key{.name = "wave_direction",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = -360, .high = 360},
        .default_text = "0.0",
        .note = "with waves",
        .sentence =
            "Direction in which waves travel, or the velocity of a table goes, from the x axis counter-clockwise as seen from "
            "above: with gravity along -z, from x towards y."},
    Key{.name = "wave_crest",
        .type = Type::number,
        .unit = "m",
        .default_text = "0.0",
        .note = "waves by a theory",
        .sentence = "Where a crest stands at t = 0, along the direction of the waves from the origin."},
    Key{.name = "wave_ramp",
        .type = Type::number,
        .unit = "s",
        .range = not_negative,
        .default_text = "0.0",
        .note = "airy and stokes2",
        .sentence = "Time in which waves grow from still water to their height."},
    Key{.name = "wave_file",
        .type = Type::file,
        .note = "required for a table",
        .sentence =
            "CSV with the header \"time [s],elevation [m],velocity [m/s]\": elevation of the surface above level, and velocity "
            "along wave_direction, both the same everywhere; linear between rows, constant before and after."},
};

/// Of water on the faces of bodies, see WaterOnFaces.
inline constexpr auto face_water_keys = [] {
  std::array<Key, water_keys.size() - 2> kept{};
  std::size_t next = 0;
  for (const Key& key : water_keys)
    if (key.name != "viscosity" && key.name != "inertia_coefficient") kept[next++] = key;
  for (Key& key : kept)
    if (key.name == "drag_coefficient") {
      key.default_text = "1.0";
      key.note = "";
      key.sentence = "Drag coefficient of faces that water meets: free ones, and those of elements that have come apart.";
    }
  return kept;
}();

inline constexpr Table face_water_table{"water", false, Need::optional,
                                        "Water around the body and its fragments: buoyancy and drag.", face_water_keys};

inline constexpr Table water_table{"water", false, Need::optional, "Water around bodies: buoyancy, drag and inertia.",
                                   water_keys};

template <class Visitor>
void visit_motion(Visitor& visit, Water& water) {
  visit("current", water.current);
  visit("waves", water.waves);
  visit("bed", water.bed);
  if (water.waves == laws::WaveTheory::none) return;
  visit("wave_direction", water.wave_direction);
  if (water.waves == laws::WaveTheory::table) return visit("wave_file", water.wave_file);
  visit("wave_height", water.wave_height);
  visit("wave_crest", water.wave_crest);
  if (!water.is_regular()) return;
  visit("wave_period", water.wave_period);
  visit("wave_ramp", water.wave_ramp);
}

template <class Visitor>
void visit_fields(Visitor& visit, Water& water) {
  if (!visit.has("level", water.is_there())) return;
  visit("level", water.level);
  visit("density", water.density);
  visit("viscosity", water.viscosity);
  visit("drag_coefficient", water.drag_coefficient);
  visit("inertia_coefficient", water.inertia_coefficient);
  visit_motion(visit, water);
}

template <class Visitor>
void visit_fields(Visitor& visit, WaterOnFaces& water) {
  if (!visit.has("level", water.is_there())) return;
  visit("level", water.level);
  visit("density", water.density);
  visit("drag_coefficient", water.drag_coefficient);
  visit_motion(visit, water);
}

}  // namespace sazare::cases
