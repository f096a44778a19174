#pragma once

/// What a hybrid case says of its coupling, for both sides in one program or one of them alone.

#include "sazare/cases/case_file.hpp"
#include "sazare/engine/continuum_side.hpp"

namespace sazare::runs {

engine::CouplingRules coupling_rules(const cases::HybridCase& hybrid);

/// Of the slab of bodies in front of a continuum in the plane; elements of rectangles have their own thickness [m].
Real surface_width(const cases::HybridCase& hybrid);

/// Number of the surface's material among those of the spheres.
Index surface_material(const cases::HybridCase& hybrid);

}  // namespace sazare::runs
