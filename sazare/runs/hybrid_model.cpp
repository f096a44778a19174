#include "sazare/runs/hybrid_model.hpp"

#include <algorithm>

namespace sazare::runs {

engine::CouplingRules coupling_rules(const cases::HybridCase& hybrid) {
  const auto scheme = hybrid.coupling.scheme == cases::HybridScheme::paper     ? engine::CouplingScheme::paper
                      : hybrid.coupling.scheme == cases::HybridScheme::impulse ? engine::CouplingScheme::impulse
                                                                               : engine::CouplingScheme::repeat;
  return {scheme, surface_width(hybrid), hybrid.coupling.tolerance, hybrid.coupling.passes};
}

Real surface_width(const cases::HybridCase& hybrid) {
  const auto* rectangles = std::get_if<cases::RectanglesCase>(&hybrid.bodies->content);
  return rectangles != nullptr ? rectangles->elements.thickness : hybrid.surface.width;
}

Index surface_material(const cases::HybridCase& hybrid) {
  const auto& materials = hybrid.bodies->spheres().materials;
  return static_cast<Index>(std::ranges::find(materials, hybrid.surface.material, &cases::SphereMaterial::name) -
                            materials.begin());
}

}  // namespace sazare::runs
