#pragma once

/// What a hybrid case says of its coupling, for both sides in one program or one of them alone.

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/hybrid/case/case.hpp"
#include "sazare/methods/hybrid/continuum_side.hpp"

namespace sazare::runs {

methods::hybrid::CouplingRules coupling_rules(const cases::HybridCase& hybrid);

/// The surface that the case names, in the mesh of its continuum. Throws UserError where it is no surface of the body.
geometry::LinearSurface coupled_surface(const cases::CaseFile& file, const geometry::ElementMesh& mesh);

/// Width of the slab of bodies on a 2-D continuum; elements of rectangles have their own thickness, ground has 1 [m].
Real surface_width(const cases::HybridCase& hybrid);

/// Number of the surface's material among those of the spheres.
Index surface_material(const cases::HybridCase& hybrid);

}  // namespace sazare::runs
