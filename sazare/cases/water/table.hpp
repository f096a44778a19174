#pragma once

/// [water]: water around bodies, still or in waves.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "sazare/cases/tables.hpp"
#include "sazare/laws/water/water_field.hpp"

namespace sazare::cases {

struct Water {
  std::optional<Real> level;    // m; without one there is no water
  Real density = 1000;          // kg/m3
  Real viscosity = 1e-3;        // Pa s
  std::optional<Real> drag_coefficient;
  Real inertia_coefficient = 1.5;
  Vector3 current = Vector3::Zero();  // m/s
  laws::WaveTheory waves = laws::WaveTheory::none;
  std::optional<Real> bed;          // m
  std::optional<Real> wave_height;  // m
  std::optional<Real> wave_period;  // s
  Real wave_direction = 0;          // deg from x towards y
  Real wave_crest = 0;              // m
  Real wave_ramp = 0;               // s
  std::filesystem::path wave_file;
  std::shared_ptr<const laws::WaterRecord> record;  // of the file, in SI units

  bool is_there() const { return level.has_value(); }
  bool is_regular() const { return waves == laws::WaveTheory::airy || waves == laws::WaveTheory::stokes2; }
  /// Waves by a theory, with all that it needs.
  bool follows_a_theory() const {
    const bool has_period = waves == laws::WaveTheory::solitary || (is_regular() && wave_period);
    return has_period && bed && wave_height;
  }
  Real depth() const { return *level - *bed; }  ///< where there is a bed [m]
};

/// Water around bodies whose faces it meets: it has no viscosity, and they carry none of it along.
struct WaterOnFaces : Water {
  WaterOnFaces() {
    drag_coefficient = 1;
    inertia_coefficient = 1;
  }
};

/// The water of a checked case.
laws::WaterField water_field(const Water& water, const Gravity& gravity);

/// What `check` says of it; empty where there is none.
std::string explain_water(const Water& water, const Gravity& gravity);
std::string explain_water(const WaterOnFaces& water, const Gravity& gravity);

}  // namespace sazare::cases
