#pragma once

#include "sazare/cases/fields.hpp"
#include "sazare/cases/soil/fields.hpp"
#include "sazare/methods/fem/case/case.hpp"

/// Which member of a case of method fem belongs to which key (see fields.hpp).
namespace sazare::cases {

template <>
struct EnumWords<MassKind> {
  static constexpr std::array<std::string_view, 2> words{"consistent", "lumped"};
};
template <>
struct EnumWords<IntegrationKind> {
  static constexpr std::array<std::string_view, 2> words{"full", "reduced"};
};
template <>
struct EnumWords<GroupKind> {
  static constexpr std::array<std::string_view, 5> words{"fixed", "roller", "prescribed", "viscous", "free_field"};
};
template <>
struct EnumWords<Analysis> {
  static constexpr std::array<std::string_view, 2> words{"dynamic", "static"};
};

template <>
struct EnumWords<FemMemberKind> {
  static constexpr std::array<std::string_view, 4> words{"beam", "bar", "spring", "dashpot"};
};

template <>
struct EnumWords<AddedMass> {
  static constexpr std::array<std::string_view, 2> words{"none", "westergaard"};
};

template <>
struct EnumWords<IncidentWaveKind> {
  static constexpr std::array<std::string_view, 3> words{"sv", "sh", "p"};
};

template <>
struct EnumWords<Drainage> {
  static constexpr std::array<std::string_view, 3> words{"drained", "undrained", "flow"};
};

template <class Visitor>
void visit_fields(Visitor& visit, FemMesh& mesh) {
  visit_fields(visit, static_cast<Mesh&>(mesh));
  visit("dimension", mesh.dimension);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemElements& elements) {
  visit("mass", elements.mass);
  visit("integration", elements.integration);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemMaterial& material) {
  visit("name", material.name);
  visit("regions", material.regions);
  visit("density", material.density);
  visit("youngs_modulus", material.youngs_modulus);
  visit("poisson_ratio", material.poisson_ratio);
  visit("damping_ratio", material.damping_ratio);
  if (visit.has("water_table", material.water_table.has_value())) {
    visit("water_table", material.water_table);
    visit("saturated_density", material.saturated_density);
    visit("pore_water_density", material.pore_water_density);
    visit("drainage", material.drainage);
    if (material.drainage != Drainage::drained) visit("porosity", material.porosity);
    if (material.drainage != Drainage::drained) visit("water_bulk_modulus", material.water_bulk_modulus);
    if (material.drainage == Drainage::flow) visit("hydraulic_conductivity", material.hydraulic_conductivity);
  }
  visit_backbone(visit, material);
  material.yields = visit.has("cohesion", material.yields);
  if (!material.yields) return;
  visit("cohesion", material.cohesion);
  visit("friction_angle", material.friction_angle);
  visit("dilation_angle", material.dilation_angle);
  visit("tensile_strength", material.tensile_strength);
  const bool by_blows = visit.has("blow_count", material.blow_count.has_value());
  const bool by_rate = visit.has("contraction_rate", material.contraction_rate.has_value());
  if (by_blows) visit("blow_count", material.blow_count);
  if (by_rate) visit("contraction_rate", material.contraction_rate);
  if (by_blows || by_rate) visit("contraction_threshold", material.contraction_threshold);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemJoint& joint) {
  visit("name", joint.name);
  if (visit.has("group", joint.on_group()))
    visit("group", joint.group);
  else
    visit("between", joint.between);
  visit("joint_normal_stiffness", joint.normal_stiffness);
  visit("joint_shear_stiffness", joint.shear_stiffness);
  visit("cohesion", joint.cohesion);
  visit("friction_angle", joint.friction_angle);
}

template <class Visitor>
void visit_fields(Visitor& visit, GroupBoundary& boundary) {
  visit("group", boundary.group);
  visit("kind", boundary.kind);
  if (boundary.kind == GroupKind::roller || boundary.kind == GroupKind::prescribed) visit("axes", boundary.axes);
  if (boundary.kind != GroupKind::prescribed && boundary.kind != GroupKind::viscous) return;
  visit_motion_names(visit, boundary.motion);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemIncidentWave& wave) {
  if (!visit.has("motion", wave.is_there())) return;
  visit("kind", wave.kind);
  visit("motion", wave.motion);
  visit("angle", wave.angle);
  visit("azimuth", wave.azimuth);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemTie& tie) {
  visit("group", tie.group);
  visit("opposite", tie.opposite);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemLoad& load) {
  visit("name", load.name);
  visit("group", load.group);
  visit("traction", load.traction);
  visit("ramp", load.ramp);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemWater& water) {
  visit("name", water.name);
  if (visit.has("joint", water.in_joint()))
    visit("joint", water.joint);
  else
    visit("group", water.group);
  visit("level", water.level);
  if (visit.has("far_level", water.far_level.has_value())) {
    visit("far_level", water.far_level);
    visit("direction", water.direction);
  }
  visit("density", water.density);
  visit("ramp", water.ramp);
  visit("added_mass", water.added_mass);
  if (water.added_mass == AddedMass::westergaard) visit("bed", water.bed);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemDrain& drain) {
  visit("group", drain.group);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemMember& member) {
  visit("name", member.name);
  visit("kind", member.kind);
  if (visit.has("group", member.on_group())) {
    visit("group", member.group);
  } else {
    visit("from", member.from);
    visit("to", member.to);
  }
  visit("spacing", member.spacing);
  if (member.kind == FemMemberKind::bar || member.kind == FemMemberKind::spring) {
    visit("yield_force", member.yield_force);
    visit("compression_force", member.compression_force);
  }
  if (member.kind == FemMemberKind::spring) visit("stiffness", member.stiffness);
  if (member.kind == FemMemberKind::dashpot) visit("damping", member.damping);
  if (member.kind == FemMemberKind::spring || member.kind == FemMemberKind::dashpot) return;
  visit("youngs_modulus", member.youngs_modulus);
  visit("area", member.area);
  visit("density", member.density);
  visit("damping_ratio", member.damping_ratio);
  if (member.kind == FemMemberKind::beam) visit("second_moment", member.second_moment);
  if (member.kind == FemMemberKind::beam) visit("yield_moment", member.yield_moment);
  if (member.kind == FemMemberKind::bar) visit("prestress", member.prestress);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemGravity& gravity) {
  visit("acceleration", gravity.acceleration);
  visit("settle", gravity.settle);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemSolver& solver) {
  visit("tolerance", solver.tolerance);
  visit("max_iterations", solver.iterations);
  visit("max_cuts", solver.cuts);
}

template <class Visitor>
void visit_fields(Visitor& visit, FemTime& time) {
  visit("end", time.end);
  visit("step", time.step);
  visit("analysis", time.analysis);
  if (visit.has("alpha", time.analysis == Analysis::dynamic)) visit("alpha", time.alpha);
  visit("history_interval", time.history_interval);
  visit("snapshot_interval", time.snapshot_interval);
  visit("strict", time.strict);
}

template <class Visitor>
void visit_tables(Visitor& visit, FemCase& fem) {
  visit.one("mesh", fem.mesh);
  visit.one("elements", fem.elements);
  visit.list("materials", fem.materials);
  visit.list("joints", fem.joints);
  visit.one("damping", fem.damping);
  visit.list("motions", fem.motions);
  visit.list("boundaries", fem.boundaries);
  visit.one("incident_wave", fem.incident_wave);
  visit.list("ties", fem.ties);
  visit.list("loads", fem.loads);
  visit.list("water_pressures", fem.waters);
  visit.list("drains", fem.drains);
  visit.list("members", fem.members);
  visit.one("gravity", fem.gravity);
  visit.one("solver", fem.solver);
  visit.list("gauges", fem.gauges);
  visit.one("time", fem.time);
  visit.one("output", fem.output);
}

}  // namespace sazare::cases
