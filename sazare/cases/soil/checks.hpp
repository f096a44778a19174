#pragma once

#include "sazare/cases/checks.hpp"
#include "sazare/cases/soil/backbone.hpp"

namespace sazare::cases {

/// What the material of a soil is otherwise.
struct SoilMaterial {
  Real shear_modulus = 0;         ///< [Pa]
  bool modulus_is_known = false;  ///< whether what it follows from was given and sound
  bool yields = false;            ///< whether it has a Mohr-Coulomb strength
};

/// Checks of materials that degrade with strain; reads their tables.
void check_soil(const CheckContext& context, const Entry& entry, const SoilMaterial& material, SoilBackbone& soil);

}  // namespace sazare::cases
