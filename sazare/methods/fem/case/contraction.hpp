#pragma once

#include "sazare/laws/cyclic_contraction.hpp"
#include "sazare/methods/fem/case/case.hpp"

namespace sazare::cases {

/// The contraction under cycles of a material that has a blow count or a rate.
laws::CyclicContraction contraction_of(const FemMaterial& material);

}  // namespace sazare::cases
