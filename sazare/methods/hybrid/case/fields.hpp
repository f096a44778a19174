#pragma once

#include "sazare/cases/fields.hpp"
#include "sazare/methods/hybrid/case/case.hpp"

/// Which member of a case of method hybrid belongs to which key (see fields.hpp).
namespace sazare::cases {

template <>
struct EnumWords<HybridScheme> {
  static constexpr std::array<std::string_view, 4> words{"automatic", "lagged", "impulse", "iterative"};
};

template <class Visitor>
void visit_fields(Visitor& visit, HybridSides& sides) {
  visit("continuum", sides.continuum);
  visit("bodies", sides.bodies);
}

template <class Visitor>
void visit_fields(Visitor& visit, HybridSurface& surface) {
  visit("group", surface.group);
  if (visit.has("material", !surface.material.empty())) visit("material", surface.material);
  if (visit.has("width", surface.width > 0)) visit("width", surface.width);
  visit("friction_coefficient", surface.friction_coefficient);
}

template <class Visitor>
void visit_fields(Visitor& visit, HybridCoupling& coupling) {
  visit("scheme", coupling.scheme);
  visit("tolerance", coupling.tolerance);
  visit("max_passes", coupling.passes);
}

template <class Visitor>
void visit_tables(Visitor& visit, HybridCase& hybrid) {
  visit.one("sides", hybrid.sides);
  visit.one("surface", hybrid.surface);
  visit.one("coupling", hybrid.coupling);
  visit.one("output", hybrid.output);
}

}  // namespace sazare::cases
