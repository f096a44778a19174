#pragma once

/// Soil that degrades with shear strain, as the materials of several methods give it: its keys, and what follows from them.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sazare/cases/format/problems.hpp"
#include "sazare/laws/soil/backbone_curve.hpp"

namespace sazare::cases {

enum class BackboneKind { hyperbolic, ramberg_osgood, table, general_hyperbolic };

/// Rows of a table of G/G0 over shear strain.
struct ModulusReduction {
  std::vector<Real> strain;   // of shear, as a plain number
  std::vector<Real> ratio;    // G/G0
  std::vector<Real> damping;  // damping ratio as a plain number, or empty: only to compare with
};

/// What a material has that may degrade.
struct SoilBackbone {
  bool degrades = false;  // whether its stiffness falls with the shear strain
  BackboneKind backbone = BackboneKind::hyperbolic;
  std::optional<Real> reference_strain;  // of shear, where G/G0 = 0.5
  std::optional<Real> shear_strength;    // Pa
  Real ramberg_osgood_exponent = 0;
  laws::GeneralHyperbola hyperbola;         // of the general hyperbolic equation
  std::filesystem::path modulus_reduction;  // of a table
  int yield_surfaces = 0;
  ModulusReduction reduction;  // what the file holds
};

/// Largest share by which a row of a table may be lifted to the concave hull of the others.
inline constexpr Real most_lifted = 0.05;

/// The backbone of a soil that has one, after its checks, with the shear modulus of its material [Pa].
laws::BackboneCurve backbone_of(const SoilBackbone& soil, Real shear_modulus);

/// Rows of a table as strains and stresses [Pa].
std::vector<laws::CurvePoint> points_of(const ModulusReduction& table, Real shear_modulus);

/// By which share of itself the stress of each row lies below the concave hull of all.
std::vector<Real> lifts_of(const ModulusReduction& table);

/// What `sazare check` says of the backbone of a material.
std::string soil_text(const SoilBackbone& soil, Real shear_modulus);

/// Reads `soil.modulus_reduction`. Problems are shown in that file under the name `shown_name` and listed where the case
/// names the file.
void read_modulus_reduction(SoilBackbone& soil, const std::string& shown_name, const Place& named_at, Problems& problems);

}  // namespace sazare::cases
