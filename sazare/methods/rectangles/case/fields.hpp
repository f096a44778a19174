#pragma once

#include "sazare/cases/fields.hpp"
#include "sazare/methods/rectangles/case/case.hpp"

/// Which member of a case of method rectangles belongs to which key (see fields.hpp).
namespace sazare::cases {

template <>
struct EnumWords<BlockShape> {
  static constexpr std::array<std::string_view, 3> words{"rectangle", "polygon", "image"};
};
template <>
struct EnumWords<ElementShape> {
  static constexpr std::array<std::string_view, 3> words{"squares", "circles", "polygons"};
};
template <>
struct EnumWords<SpringLayout> {
  static constexpr std::array<std::string_view, 2> words{"centres", "ends"};
};
template <>
struct EnumWords<IncrementFormula> {
  static constexpr std::array<std::string_view, 2> words{"small", "exact"};
};

template <class Visitor>
void visit_fields(Visitor& visit, SquareRules& elements) {
  visit("thickness", elements.thickness);
}

template <class Visitor>
void visit_fields(Visitor& visit, SquareBlock& block) {
  visit("name", block.name);
  visit("material", block.material);
  visit("shape", block.shape);
  visit("elements", block.elements);
  if (visit.has("element_size", block.element_size > 0)) visit("element_size", block.element_size);
  if (visit.has("nuclei", !block.nuclei.empty())) visit("nuclei", block.nuclei);
  if (block.elements == ElementShape::polygons && block.element_size > 0) visit("seed", block.seed);
  if (block.shape == BlockShape::polygon)
    visit("points", block.points);
  else
    visit("lower", block.lower);
  if (block.shape == BlockShape::rectangle) visit("upper", block.upper);
  if (block.shape == BlockShape::image) visit("file", block.file);
  visit("angle", block.angle);
}

/// Young's modulus and Poisson's ratio of a square lattice: k_n = (1 - nu) E/((1 + nu)(1 - 2 nu)), k_s = (1 - 2 nu) k_n/(2 (1 -
/// nu)). [Matsui1999], eq. (25) of its section 3 (3).
template <class Visitor>
void visit_fields(Visitor& visit, SquareMaterial& material) {
  visit("name", material.name);
  visit("density", material.density);
  if (visit.has("youngs_modulus", false) && visit.has("poisson_ratio", false)) {
    Real &modulus = material.youngs_modulus, &ratio = material.poisson_ratio;
    visit("youngs_modulus", modulus);
    visit("poisson_ratio", ratio);
    material.normal_stiffness = (1 - ratio) * modulus / ((1 + ratio) * (1 - 2 * ratio));
    material.shear_stiffness = (1 - 2 * ratio) / (2 * (1 - ratio)) * material.normal_stiffness;
  } else {
    visit("face_normal_stiffness", material.normal_stiffness);
    visit("face_shear_stiffness", material.shear_stiffness);
  }
  visit("damping_ratio", material.damping_ratio);
  visit("tensile_strength", material.tensile_strength);
  visit("cohesion", material.cohesion);
  visit("friction_angle", material.friction_angle);
  visit("springs", material.springs);
  visit("layout", material.layout);
  visit("increments", material.increments);
}

template <class Visitor>
void visit_fields(Visitor& visit, SquareContact& contact) {
  visit("face_normal_stiffness", contact.normal_stiffness);
  visit("face_shear_stiffness", contact.shear_stiffness);
  visit("damping_ratio", contact.damping_ratio);
  visit("friction_angle", contact.friction_angle);
}

template <class Visitor>
void visit_fields(Visitor& visit, SupportMotion& moves) {
  visit("velocity", moves.velocity);
  visit_motion_names(visit, moves.motion);
}

template <class Visitor>
void visit_fields(Visitor& visit, Wall& wall) {
  visit("name", wall.name);
  visit("from", wall.from);
  visit("to", wall.to);
  visit_fields(visit, wall.moves);
}

template <class Visitor>
void visit_fields(Visitor& visit, Roller& roller) {
  visit("name", roller.name);
  visit("center", roller.center);
  visit("radius", roller.radius);
  visit_fields(visit, roller.moves);
}

template <class Visitor>
void visit_fields(Visitor& visit, Plate& plate) {
  visit("friction_coefficient", plate.friction_coefficient);
  visit("velocity", plate.velocity);
  visit("gravity", plate.gravity);
}

template <class Visitor>
void visit_tables(Visitor& visit, RectanglesCase& rectangles) {
  visit.one("elements", rectangles.elements);
  visit.list("blocks", rectangles.blocks);
  visit.list("materials", rectangles.materials);
  visit.one("contact", rectangles.contact);
  visit.list("walls", rectangles.walls);
  visit.list("rollers", rectangles.rollers);
  visit.list("motions", rectangles.motions);
  visit.one("base_friction", rectangles.plate);
  visit.one("gravity", rectangles.gravity);
  visit.list("gauges", rectangles.gauges);
  visit.one("time", rectangles.time);
  visit.one("output", rectangles.output);
}

}  // namespace sazare::cases
