#pragma once

/// Materials that degrade with strain: what follows from their keys.

#include <string>
#include <vector>

#include "sazare/cases/format/problems.hpp"
#include "sazare/laws/backbone_curve.hpp"
#include "sazare/laws/cyclic_contraction.hpp"
#include "sazare/methods/fem/case/case.hpp"

namespace sazare::cases {

/// Largest share by which a row of a table may be lifted to the concave hull of the others.
inline constexpr Real most_lifted = 0.05;

/// The backbone of a material that has one, after its checks.
laws::BackboneCurve backbone_of(const FemMaterial& material);

/// Rows of a table as strains and stresses [Pa].
std::vector<laws::CurvePoint> points_of(const ModulusReduction& table, Real shear_modulus);

/// By which share of itself the stress of each row lies below the concave hull of all.
std::vector<Real> lifts_of(const ModulusReduction& table);

/// What `sazare check` says of the backbone of a material.
std::string soil_text(const FemMaterial& material);

/// Reads `material.modulus_reduction`. Problems are shown in that file under the name `shown_name` and listed where the case
/// names the file.
void read_modulus_reduction(FemMaterial& material, const std::string& shown_name, const Place& named_at, Problems& problems);

/// The contraction under cycles of a material that has a blow count or a rate.
laws::CyclicContraction contraction_of(const FemMaterial& material);

}  // namespace sazare::cases
