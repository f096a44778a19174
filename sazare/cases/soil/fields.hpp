#pragma once

#include "sazare/cases/fields.hpp"
#include "sazare/cases/soil/backbone.hpp"

/// Which member of a soil belongs to which key (see fields.hpp).
namespace sazare::cases {

template <>
struct EnumWords<BackboneKind> {
  static constexpr std::array<std::string_view, 4> words{"hyperbolic", "ramberg_osgood", "table", "general_hyperbolic"};
};

template <class Visitor>
void visit_backbone(Visitor& visit, SoilBackbone& soil) {
  soil.degrades = visit.has("backbone", soil.degrades);
  if (!soil.degrades) return;
  visit("backbone", soil.backbone);
  visit("shear_strength", soil.shear_strength);
  if (soil.backbone == BackboneKind::table) {
    visit("modulus_reduction", soil.modulus_reduction);
    return;
  }
  if (soil.backbone == BackboneKind::general_hyperbolic) {
    visit("ghe_c1_end", soil.hyperbola.first_end);
    visit("ghe_c2_begin", soil.hyperbola.second_begin);
    visit("ghe_c2_end", soil.hyperbola.second_end);
    visit("ghe_alpha", soil.hyperbola.first_change);
    visit("ghe_beta", soil.hyperbola.second_change);
  } else {
    visit("reference_strain", soil.reference_strain);
  }
  if (soil.backbone == BackboneKind::ramberg_osgood) visit("ramberg_osgood_exponent", soil.ramberg_osgood_exponent);
  visit("yield_surfaces", soil.yield_surfaces);
}

}  // namespace sazare::cases
