#pragma once

#include <cmath>

#include "sazare/cases/fields.hpp"
#include "sazare/cases/soil/fields.hpp"
#include "sazare/methods/mps/case/case.hpp"

/// Which member of a case of method mps belongs to which key (see fields.hpp).
namespace sazare::cases {

template <>
struct EnumWords<ParticleFit> {
  static constexpr std::array<std::string_view, 2> words{"exact", "inside"};
};
template <>
struct EnumWords<RotationRemoval> {
  static constexpr std::array<std::string_view, 2> words{"mean_rotation", "mean_angle"};
};
template <>
struct EnumWords<RotationTorque> {
  static constexpr std::array<std::string_view, 2> words{"half", "whole"};
};
template <>
struct EnumWords<EulerDamping> {
  static constexpr std::array<std::string_view, 2> words{"present", "lagged"};
};
template <>
struct EnumWords<RegionShape> {
  static constexpr std::array<std::string_view, 3> words{"rectangle", "polygon", "mesh"};
};
template <>
struct EnumWords<Side> {
  static constexpr std::array<std::string_view, 7> words{"left", "right", "bottom", "top", "front", "back", "all"};
};
template <>
struct EnumWords<SideExtent> {
  static constexpr std::array<std::string_view, 2> words{"plane", "surface"};
};
template <>
struct EnumWords<SideKind> {
  static constexpr std::array<std::string_view, 5> words{"fixed", "roller", "prescribed", "viscous", "free_field"};
};
template <class Visitor>
void visit_fields(Visitor& visit, ParticleRules& particles) {
  visit("spacing", particles.spacing);
  visit("dimension", particles.dimension);
  visit("influence", particles.influence);
  visit("fit", particles.fit);
  visit("periodic", particles.periodic);
  visit("rotation", particles.rotation);
  visit("rotation_torque", particles.rotation_torque);
}

template <class Visitor>
void visit_fields(Visitor& visit, MpsTime& time) {
  visit_fields(visit, static_cast<UniformTime&>(time));
  if (visit.has("euler_damping", time.integrator == Integrator::euler)) visit("euler_damping", time.euler_damping);
}

template <class Visitor>
void visit_fields(Visitor& visit, ParticleRegion& region) {
  visit("name", region.name);
  visit("shape", region.shape);
  if (region.shape == RegionShape::rectangle) {
    visit("lower", region.lower);
    visit("upper", region.upper);
  } else if (region.shape == RegionShape::polygon) {
    visit("points", region.points);
  } else {
    visit("file", region.file);
    visit("group", region.group);
  }
}

template <class Visitor>
void visit_fields(Visitor& visit, Ground& ground) {
  visit("name", ground.name);
  visit("regions", ground.regions);
  visit("density", ground.density);
  if (visit.has("s_wave_velocity", true)) visit("s_wave_velocity", ground.s_wave_velocity);
  if (visit.has("p_wave_velocity", true)) visit("p_wave_velocity", ground.p_wave_velocity);
  if (visit.has("poisson_ratio", false)) {
    Real ratio = 0;
    visit("poisson_ratio", ratio);
    const Real square = (1 - 2 * ratio) / (2 - 2 * ratio);  // of the shear velocity over the other
    if (visit.has("s_wave_velocity", true))
      ground.p_wave_velocity = ground.s_wave_velocity / std::sqrt(square);
    else
      ground.s_wave_velocity = ground.p_wave_velocity * std::sqrt(square);
  }
  visit("damping_ratio", ground.damping_ratio);
  visit_backbone(visit, ground);
  ground.yields = visit.has("cohesion", ground.yields);
  if (!ground.yields) return;
  visit("cohesion", ground.cohesion);
  visit("friction_angle", ground.friction_angle);
  visit("dilation_angle", ground.dilation_angle);
  visit("tensile_strength", ground.tensile_strength);
  visit("rupture_strain", ground.rupture_strain);
  visit("residual_cohesion", ground.residual_cohesion);
  visit("residual_friction_angle", ground.residual_friction_angle);
  if (visit.has("softening_displacement", ground.residual_cohesion || ground.residual_friction_angle))
    visit("softening_displacement", ground.softening_displacement);
}

template <class Visitor>
void visit_fields(Visitor& visit, SideBoundary& boundary) {
  visit("side", boundary.side);
  visit("extent", boundary.extent);
  if (visit.has("region", !boundary.region.empty())) visit("region", boundary.region);
  visit("kind", boundary.kind);
  if (boundary.kind == SideKind::roller) visit("axes", boundary.axes);
  if (boundary.kind != SideKind::prescribed && boundary.kind != SideKind::viscous) return;
  visit_motion_names(visit, boundary.motion);
}

template <class Visitor>
void visit_fields(Visitor& visit, LooseContact& contact) {
  visit("damping_ratio", contact.damping_ratio);
}

template <class Visitor>
void visit_fields(Visitor& visit, GroundGravity& gravity) {
  visit("acceleration", gravity.acceleration);
  visit("settle", gravity.settle);
  visit("max_settling_steps", gravity.max_settling_steps);
}

template <class Visitor>
void visit_fields(Visitor& visit, Noise& noise) {
  visit("velocity", noise.velocity);
  visit("seed", noise.seed);
}

template <class Visitor>
void visit_tables(Visitor& visit, MpsCase& mps) {
  visit.one("particles", mps.particles);
  visit.list("regions", mps.regions);
  visit.list("materials", mps.materials);
  visit.one("damping", mps.damping);
  visit.list("motions", mps.motions);
  visit.list("boundaries", mps.boundaries);
  visit.one("contact", mps.contact);
  visit.one("gravity", mps.gravity);
  visit.one("noise", mps.noise);
  visit.list("gauges", mps.gauges);
  visit.one("time", mps.time);
  visit.one("output", mps.output);
}

}  // namespace sazare::cases
