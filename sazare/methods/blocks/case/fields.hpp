#pragma once

#include "sazare/cases/fields.hpp"
#include "sazare/cases/water/keys.hpp"
#include "sazare/methods/blocks/case/case.hpp"

/// Which member of a case of method blocks belongs to which key (see fields.hpp of the module cases).
namespace sazare::cases {

template <>
struct EnumWords<JointLawName> {
  static constexpr auto words = laws::words_of_laws<laws::JointLaws>;
};

template <>
struct EnumWords<laws::RateLawName> {
  static constexpr auto& words = laws::words_of_laws<laws::RateLaws>;
};

template <>
struct EnumWords<DampingCap> {
  static constexpr std::array<std::string_view, 3> words{"literal", "critical", "step"};
};

template <>
struct EnumWords<ContactShape> {
  static constexpr std::array<std::string_view, 2> words{"spheres", "faces"};
};

template <>
struct EnumWords<Levels> {
  static constexpr std::array<std::string_view, 2> words{"per_element", "uniform"};
};

template <>
struct EnumWords<Limiter> {
  static constexpr std::array<std::string_view, 3> words{"stability", "travel", "none"};
};

template <>
struct EnumWords<BoundaryKind> {
  static constexpr std::array<std::string_view, 4> words{"fixed", "frictionless", "absorbing", "prescribed"};
};

template <>
struct EnumWords<GasInCracks> {
  static constexpr std::array<std::string_view, 3> words{"none", "share", "flow"};
};

template <>
struct EnumWords<ExplosiveName> {
  static constexpr auto words = [] {
    std::array<std::string_view, laws::explosives.size() + 1> all{};
    for (std::size_t i = 0; i < laws::explosives.size(); ++i) all[i] = laws::explosives[i].name;
    all.back() = "custom";
    return all;
  }();
};

/// Keys of the constants of a JWL gas.
inline constexpr std::array<std::string_view, 5> jwl_keys{"jwl_a", "jwl_b", "jwl_r1", "jwl_r2", "jwl_omega"};

template <class Visitor>
void visit_fields(Visitor& visit, Material& material) {
  visit("name", material.name);
  visit("regions", material.regions);
  visit("density", material.density);
  visit("youngs_modulus", material.youngs_modulus);
  visit("poisson_ratio", material.poisson_ratio);
  visit("deformable", material.deformable);
  if (visit.has("bulk_damping_ratio", material.deformable)) visit("bulk_damping_ratio", material.bulk_damping_ratio);
}

template <class Visitor>
void visit_fields(Visitor& visit, Joint& joint) {
  visit("name", joint.name);
  if (visit.has("surface", joint.on_surface()))
    visit("surface", joint.surface);
  else
    visit("between", joint.between);
  visit("bonded", joint.bonded);
  if (!joint.bonded) return;
  visit("law", joint.law);
  visit("joint_normal_stiffness", joint.normal_stiffness);
  visit("joint_shear_stiffness", joint.shear_stiffness);
  if (visit.has("damping_ratio", joint.damping_ratio.has_value())) {
    visit("damping_ratio", joint.damping_ratio);
  } else {
    visit("joint_normal_damping", joint.normal_damping);
    visit("joint_shear_damping", joint.shear_damping);
  }
  if (!joint.is_natural()) {
    visit("cohesion", joint.cohesion);
    visit.friction(joint.friction_coefficient);
    visit("tensile_strength", joint.tensile_strength);
    visit("fracture_energy", joint.fracture_energy);
  }
  for (std::size_t n = 0; n < joint.law_parameters.size(); ++n)
    visit(laws::parameters_of_laws<laws::JointLaws>[n].name, joint.law_parameters[n]);
  if (joint.is_natural()) return;
  visit("rate_law", joint.by_rate.law);
  for (std::size_t n = 0; n < joint.by_rate.parameters.size(); ++n)
    visit(laws::parameters_of_laws<laws::RateLaws>[n].name, joint.by_rate.parameters[n]);
  if (visit.has("rate_energy_exponent", joint.follows_rate())) visit("rate_energy_exponent", joint.by_rate.energy_exponent);
  if (!visit.has("weibull_modulus", joint.weibull_modulus.has_value())) return;
  visit("weibull_modulus", joint.weibull_modulus);
  visit("scatter_seed", joint.scatter_seed);
}

template <class Visitor>
void visit_fields(Visitor& visit, Contact& contact) {
  visit("contact_shape", contact.shape);
  const bool by_faces = contact.shape == ContactShape::faces;
  if (visit.has("contact_stiffness", contact.normal_stiffness > 0)) visit("contact_stiffness", contact.normal_stiffness);
  visit("contact_damping", contact.normal_damping);
  if (visit.has("face_contact_stiffness", by_faces)) visit("face_contact_stiffness", contact.face_stiffness);
  if (visit.has("face_contact_damping", by_faces)) visit("face_contact_damping", contact.face_damping);
  visit.friction(contact.friction_coefficient);
  visit("damping_cap", contact.damping_cap);
  visit("edge_division", contact.edge_division);
}

template <class Visitor>
void visit_fields(Visitor& visit, Blast& blast) {
  visit("surface", blast.surface);
  if (visit.has("name", true))
    visit("name", blast.name);
  else
    blast.name = blast.surface;
  visit("delay", blast.delay);
  if (visit.has("table", std::holds_alternative<PressureTable>(blast.pressure))) {
    if (!std::holds_alternative<PressureTable>(blast.pressure)) blast.pressure = PressureTable{};
    visit("table", std::get<PressureTable>(blast.pressure).file);
  } else if (bool is_function = std::holds_alternative<PressureFunction>(blast.pressure); visit.has("function", is_function)) {
    visit("function", is_function);
    if (is_function && !std::holds_alternative<PressureFunction>(blast.pressure)) blast.pressure = PressureFunction{};
  }
  if (std::holds_alternative<PressurePulse>(blast.pressure)) {
    auto& pulse = std::get<PressurePulse>(blast.pressure);
    visit("peak_pressure", pulse.peak_pressure);
    visit("rise_time", pulse.rise_time);
    visit("decay_ratio", pulse.decay_ratio);
  }
  visit("cut_distance", blast.cut_distance);
}

template <class Visitor>
void visit_fields(Visitor& visit, Charge& charge) {
  visit("surface", charge.surface);
  if (visit.has("name", true))
    visit("name", charge.name);
  else
    charge.name = charge.surface;
  visit("collar", charge.collar);
  visit("toe", charge.toe);
  visit("diameter", charge.diameter);
  visit("charge_diameter", charge.charge_diameter);
  visit("share", charge.share);
  visit("top", charge.top);
  visit("bottom", charge.bottom);
  visit("primer", charge.primer);
  visit("vents", charge.vents);
  visit("stemming_density", charge.stemming_density);
  visit("stemming_resistance", charge.stemming_resistance);
  visit("gas_in_cracks", charge.gas_in_cracks);
  if (charge.gas_in_cracks != GasInCracks::none) visit("crack_aperture", charge.crack_aperture);
  if (charge.gas_in_cracks == GasInCracks::share) visit("crack_pressure_share", charge.crack_pressure_share);
  if (charge.gas_in_cracks == GasInCracks::flow) visit("discharge_coefficient", charge.discharge_coefficient);
  visit("explosive", charge.explosive);
  visit("density", charge.density);
  visit("detonation_velocity", charge.detonation_velocity);
  visit("explosive_energy", charge.energy);
  visit("gas_exponent", charge.gas_exponent);
  for (std::size_t i = 0; i < jwl_keys.size(); ++i) visit(jwl_keys[i], charge.jwl[i]);
  visit("delay", charge.delay);
  visit("delay_scatter", charge.delay_scatter);
  visit("scatter_seed", charge.scatter_seed);
  visit("cut_distance", charge.cut_distance);
}

template <class Visitor>
void visit_fields(Visitor& visit, Boundary& boundary) {
  visit("surface", boundary.surface);
  visit("kind", boundary.kind);
  if (!boundary.can_move()) return;
  visit_motion_names(visit, boundary.motion);
}

template <class Visitor>
void visit_fields(Visitor& visit, Constraint& constraint) {
  visit("regions", constraint.regions);
  visit("translation", constraint.translation);
  visit("rotation", constraint.rotation);
}

template <class Visitor>
void visit_fields(Visitor& visit, BlockGravity& gravity) {
  visit("acceleration", gravity.acceleration);
  visit("settle", gravity.settle);
}

template <class Visitor>
void visit_fields(Visitor& visit, InitialStress& stress) {
  if (visit.has("k0", stress.k0.has_value())) {
    visit("k0", stress.k0);
  } else {
    visit("normal_stress", stress.normal);
    visit("shear_stress", stress.shear);
    visit("normal_stress_per_depth", stress.normal_per_depth);
    visit("shear_stress_per_depth", stress.shear_per_depth);
  }
  visit("datum", stress.datum);
  visit("settle", stress.settle);
}

template <class Visitor>
void visit_fields(Visitor& visit, InitialVelocity& velocity) {
  visit("regions", velocity.regions);
  visit("velocity", velocity.velocity);
}

template <class Visitor>
void visit_fields(Visitor& visit, Time& time) {
  visit("end", time.end);
  visit("levels", time.levels);
  visit("limiter", time.limiter);
  visit("base_step", time.base_step);
  visit("stability_fraction", time.stability_fraction);
  visit("travel_length", time.travel_length);
  visit("neighbor_levels", time.neighbor_levels);
  visit("history_interval", time.history_interval);
  visit("snapshot_interval", time.snapshot_interval);
  visit("strict", time.strict);
}

template <class Visitor>
void visit_tables(Visitor& visit, BlocksCase& blocks) {
  visit.one("mesh", blocks.mesh);
  visit.list("materials", blocks.materials);
  visit.list("joints", blocks.joints);
  visit.one("contact", blocks.contact);
  visit.list("blasts", blocks.blasts);
  visit.list("charges", blocks.charges);
  visit.one("gravity", blocks.gravity);
  visit.one("water", blocks.water);
  visit.one("initial_stress", blocks.initial_stress);
  visit.list("motions", blocks.motions);
  visit.list("boundaries", blocks.boundaries);
  visit.list("constraints", blocks.constraints);
  visit.list("initial_velocities", blocks.initial_velocities);
  visit.list("gauges", blocks.gauges);
  visit.one("time", blocks.time);
  visit.one("output", blocks.output);
}

}  // namespace sazare::cases
