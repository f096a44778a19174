#pragma once

#include "sazare/cases/fields.hpp"
#include "sazare/cases/water/keys.hpp"
#include "sazare/methods/spheres/case/case.hpp"

/// Which member of a case of method spheres belongs to which key (see fields.hpp).
namespace sazare::cases {

template <>
struct EnumWords<ContactModel> {
  static constexpr auto words = laws::contact_law_words;
};
template <>
struct EnumWords<SphereSource> {
  static constexpr std::array<std::string_view, 5> words{"one", "file", "lattice", "random", "bodies"};
};
template <>
struct EnumWords<SphereLevels> {
  static constexpr std::array<std::string_view, 3> words{"automatic", "per_sphere", "uniform"};
};
template <>
struct EnumWords<WallShape> {
  static constexpr std::array<std::string_view, 3> words{"plane", "box", "mesh"};
};

template <class Visitor>
void visit_fields(Visitor& visit, Domain& domain) {
  const bool repeats = domain.periodic[0] || domain.periodic[1] || domain.periodic[2];
  visit("periodic", domain.periodic);
  if (visit.has("lower", repeats)) visit("lower", domain.lower);
  if (visit.has("upper", repeats)) visit("upper", domain.upper);
}

template <class Visitor>
void visit_fields(Visitor& visit, SphereMaterial& material) {
  visit("name", material.name);
  visit("density", material.density);
  if (visit.has("youngs_modulus", material.youngs_modulus > 0)) visit("youngs_modulus", material.youngs_modulus);
  if (visit.has("poisson_ratio", material.youngs_modulus > 0)) visit("poisson_ratio", material.poisson_ratio);
}

template <class Visitor>
void visit_law_parameters(Visitor& visit, LawParameters& values) {
  for (std::size_t n = 0; n < values.size(); ++n) visit(laws::law_parameters[n].name, values[n]);
}

template <class Visitor>
void visit_fields(Visitor& visit, GranularContact& contact) {
  visit("model", contact.model);
  visit("restitution", contact.restitution);
  visit.friction(contact.friction_coefficient);
  visit("rolling_friction", contact.rolling_friction);
  visit("twisting_friction", contact.twisting_friction);
  visit_law_parameters(visit, contact.law_parameters);
  visit("overlap_limit", contact.overlap_limit);
  visit("margin", contact.margin);
}

template <class Visitor>
void visit_fields(Visitor& visit, MaterialPair& pair) {
  visit("between", pair.between);
  visit("restitution", pair.restitution);
  visit("friction_coefficient", pair.friction_coefficient);
  visit("rolling_friction", pair.rolling_friction);
  visit("twisting_friction", pair.twisting_friction);
  visit_law_parameters(visit, pair.law_parameters);
}

template <>
struct EnumWords<ClumpSource> {
  static constexpr std::array<std::string_view, 3> words{"tetrapod", "file", "mesh"};
};

template <class Visitor>
void visit_fields(Visitor& visit, ClumpShape& shape) {
  visit("name", shape.name);
  visit("source", shape.source);
  if (visit.has("bonds", !shape.bonds.empty())) visit("bonds", shape.bonds);
  if (shape.source == ClumpSource::tetrapod) {
    visit("height", shape.height);
    visit("leg_spheres", shape.leg_spheres);
    return;
  }
  visit("file", shape.file);
  visit("scale", shape.scale);
  if (shape.source == ClumpSource::mesh) visit("count", shape.count);
}

template <class Visitor>
void visit_fields(Visitor& visit, SphereGroup& group) {
  visit("name", group.name);
  visit("material", group.material);
  visit("source", group.source);
  if (group.source == SphereSource::file || group.source == SphereSource::bodies) {
    visit("file", group.file);
    if (group.source == SphereSource::bodies) visit("bodies_file", group.bodies_file);
  } else if (visit.has("radius", group.shape.empty())) {
    visit("radius", group.radius);
  }
  if (group.source == SphereSource::one) visit("centre", group.centre);
  if (group.source == SphereSource::lattice || group.source == SphereSource::random) {
    visit("lower", group.lower);
    visit("upper", group.upper);
  }
  if (group.source == SphereSource::lattice) visit("spacing", group.spacing);
  if (group.source == SphereSource::random) {
    visit("largest_radius", group.largest_radius);
    visit("count", group.count);
  }
  visit("seed", group.seed);
  visit("lowered", group.lowered);
  visit("rain", group.rain);
  visit("drag_coefficient", group.drag_coefficient);
  visit("inertia_coefficient", group.inertia_coefficient);
  if (visit.has("velocity", !group.rain)) visit("velocity", group.velocity);
  if (visit.has("angular_velocity", !group.rain)) visit("angular_velocity", group.spin);
  if (visit.has("noise", !group.rain)) visit("noise", group.noise);
  if (visit.has("held", !group.rain)) visit("held", group.held);
  if (!visit.has("shape", !group.shape.empty())) return;
  visit("shape", group.shape);
  visit("rotation", group.rotation);
  visit("random_rotation", group.random_rotation);
}

template <class Visitor>
void visit_fields(Visitor& visit, WallRules& wall) {
  visit("name", wall.name);
  visit("material", wall.material);
  visit("shape", wall.shape);
  if (wall.shape == WallShape::plane) {
    visit("point", wall.point);
    visit("normal", wall.normal);
  } else if (wall.shape == WallShape::box) {
    visit("lower", wall.lower);
    visit("upper", wall.upper);
  } else {
    visit("file", wall.file);
    if (visit.has("group", !wall.group.empty())) visit("group", wall.group);
    visit("scale", wall.scale);
  }
  visit_motion_names(visit, wall.motion);
  visit("angular_velocity", wall.spin);
  visit("pivot", wall.pivot);
}

template <class Visitor>
void visit_fields(Visitor& visit, BondRules& bond) {
  visit("name", bond.name);
  if (visit.has("between", !bond.between[0].empty())) visit("between", bond.between);
  visit("reach", bond.reach);
  visit("radius_ratio", bond.radius_ratio);
  visit("youngs_modulus", bond.youngs_modulus);
  visit("poisson_ratio", bond.poisson_ratio);
  visit("bond_normal_stiffness", bond.normal_stiffness);
  visit("bond_shear_stiffness", bond.shear_stiffness);
  visit("damping_ratio", bond.damping_ratio);
  visit("tensile_strength", bond.tensile_strength);
  visit("cohesion", bond.cohesion);
  visit("friction_angle", bond.friction_angle);
  visit("fracture_energy", bond.fracture_energy);
}

template <class Visitor>
void visit_fields(Visitor& visit, GroupGauge& gauge) {
  visit("name", gauge.name);
  visit("group", gauge.group);
}

template <class Visitor>
void visit_fields(Visitor& visit, SphereTime& time) {
  visit_fields(visit, static_cast<LeapfrogTime&>(time));
  visit("levels", time.levels);
}

template <class Visitor>
void visit_tables(Visitor& visit, SpheresCase& spheres) {
  visit.one("domain", spheres.domain);
  visit.list("materials", spheres.materials);
  visit.one("contact", spheres.contact);
  visit.list("pairs", spheres.pairs);
  visit.list("shapes", spheres.shapes);
  visit.list("spheres", spheres.spheres);
  visit.list("bonds", spheres.bonds);
  visit.list("walls", spheres.walls);
  visit.list("motions", spheres.motions);
  visit.one("gravity", spheres.gravity);
  visit.one("water", spheres.water);
  visit.list("gauges", spheres.gauges);
  visit.one("time", spheres.time);
  visit.one("output", spheres.output);
}

}  // namespace sazare::cases
