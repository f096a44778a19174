#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/explanation.hpp"
#include "sazare/methods/fem/case/contraction.hpp"
#include "sazare/methods/fem/case/fields.hpp"
#include "sazare/methods/fem/case/format.hpp"

namespace sazare::cases {
namespace {

/// The compression wave of ground whose water moves with it is that of both.
std::string drainage_text(const FemMaterial& material) {
  if (material.drainage == Drainage::drained) return ", drained";
  const Real constrained = material.constrained_modulus(), water = material.water_bulk_modulus / material.porosity;
  std::string text =
      fmt::format("\n  {:<12}  {}: porosity {}, bulk modulus of the water {} Pa, P waves at {} m/s where no water flows", "",
                  word(material.drainage), number(material.porosity), number(material.water_bulk_modulus),
                  number(std::sqrt((constrained + water) / material.saturated_density)));
  const Real room = material.porosity * material.pore_water_density,
             moist = 1 - (material.saturated_density - material.density) / room;
  if (moist > 0.01 && moist <= 1)
    text += fmt::format("\n  {:<12}  above the table its density is that of ground whose pores are {} % full of water", "",
                        number(100 * moist, 2));
  if (material.drainage == Drainage::flow)
    text += fmt::format("\n  {:<12}  hydraulic conductivity {} m/s", "", number(material.hydraulic_conductivity));
  return text;
}

std::string contraction_text(const FemMaterial& material) {
  const laws::CyclicContraction law = contraction_of(material);
  Real lost = 0;
  for (int half = 0; half < 20; ++half) lost += law.half_cycle(1e-3, lost);
  return fmt::format(
      "\n  {:<12}  contracts under cycles: C1 {}, C2 {}; ten cycles of a shear strain of 0.001 take {} % of its volume", "",
      number(law.rate()), number(law.decay()), number(100 * lost, 2));
}

std::string material_text(const FemMaterial& material) {
  std::string text = fmt::format("{}: {} kg/m3, E {} Pa, Poisson's ratio {}, damping ratio {}, regions {}", material.name,
                                 number(material.density), number(material.youngs_modulus), number(material.poisson_ratio),
                                 number(material.damping_ratio), fmt::join(material.regions, ", "));
  if (material.yields)
    text += fmt::format("\n  {:<12}  yields: cohesion {} Pa, friction angle {} deg, dilation angle {} deg, tension cut-off {}", "",
                        number(material.cohesion), number(material.friction_angle), number(material.dilation_angle),
                        cut_off_text(material.tensile_strength));
  if (material.contracts()) text += contraction_text(material);
  if (material.water_table)
    text += fmt::format("\n  {:<12}  below {} m saturated: {} kg/m3, with water of {} kg/m3", "", number(*material.water_table),
                        number(material.saturated_density), number(material.pore_water_density));
  if (material.water_table) text += drainage_text(material);
  if (material.degrades) text += soil_text(material, material.shear_modulus());
  return text;
}

std::string boundary_text(const GroupBoundary& boundary) {
  std::string text = fmt::format("{}: {}", boundary.group, word(boundary.kind));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (boundary.axes[axis]) text += fmt::format(" {}", "xyz"[axis]);
  return text + motion_names_text(boundary.motion, boundary.kind == GroupKind::viscous);
}

std::string wave_text(const FemIncidentWave& wave) {
  std::string text = fmt::format("{} of {}, at {} deg from the vertical", word(wave.kind), wave.motion, number(wave.angle));
  if (wave.azimuth != 0) text += fmt::format(" towards {} deg from x", number(wave.azimuth));
  return text + ", through all viscous and free-field boundaries";
}

std::string water_text(const FemWater& water) {
  std::string text =
      fmt::format("{}: {} kg/m3 {} {}, level {} m", water.name, number(water.density), water.in_joint() ? "in joint" : "on",
                  water.in_joint() ? water.joint : water.group, number(water.level));
  if (water.far_level) text += fmt::format(" to {} m along {}", number(*water.far_level), vector_text(water.direction));
  if (water.ramp > 0) text += fmt::format(", full pressure after {} s", number(water.ramp));
  if (water.added_mass == AddedMass::westergaard) text += ", Westergaard's added mass";
  if (water.bed) text += fmt::format(" above a bed at {} m", number(*water.bed));
  return text;
}

std::string limits_text(const FemMember& member) {
  std::string text;
  if (member.yield_force)
    text += fmt::format(", yields at {} N{}", number(*member.yield_force), member.compression_force ? " in tension" : "");
  if (member.compression_force)
    text += *member.compression_force > 0 ? fmt::format(", gives way in compression at {} N", number(*member.compression_force))
                                          : ", goes slack in compression";
  if (member.yield_moment) text += fmt::format(", yields at {} N m", number(*member.yield_moment));
  return text;
}

std::string member_text(const FemMember& member) {
  std::string text = fmt::format(
      "{}: {} {}", member.name, word(member.kind),
      member.on_group() ? "along " + member.group : "from " + vector_text(member.from) + " to " + vector_text(member.to) + " m");
  if (member.kind == FemMemberKind::spring) return text + fmt::format(", {} N/m", number(member.stiffness)) + limits_text(member);
  if (member.kind == FemMemberKind::dashpot) return text + fmt::format(", {} N s/m", number(member.damping));
  text += fmt::format(", E {} Pa, area {} m2", number(member.youngs_modulus), number(member.area));
  if (member.kind == FemMemberKind::beam) text += fmt::format(", second moment {} m4", number(member.second_moment));
  if (member.prestress != 0) text += fmt::format(", prestress {} N", number(member.prestress));
  text += limits_text(member);
  if (member.spacing != 1) text += fmt::format(", every {} m", number(member.spacing));
  return text;
}

}  // namespace

std::string explain(const FemCase& fem) {
  std::string text = fem.title + "\n";
  text += line("mesh", fmt::format("{}, {}-D, {} mass, {} integration", fem.mesh.file.filename().string(), fem.mesh.dimension,
                                   word(fem.elements.mass), word(fem.elements.integration)));
  for (const FemMaterial& material : fem.materials) text += line("materials", material_text(material));
  for (const FemJoint& joint : fem.joints)
    text += line("joints",
                 fmt::format("{}: {}, springs {} and {} Pa/m, cohesion {} Pa, friction angle {} deg", joint.name,
                             joint.on_group() ? "on " + joint.group : "between " + joint.between[0] + " and " + joint.between[1],
                             number(joint.normal_stiffness), number(joint.shear_stiffness), number(joint.cohesion),
                             number(joint.friction_angle)));
  if (fem.damping.f2 > 0) text += line("damping", fmt::format("at {} and {} Hz", number(fem.damping.f1), number(fem.damping.f2)));
  text += explain_motions(fem.motions, fem.time.end);
  for (const GroupBoundary& boundary : fem.boundaries) text += line("boundaries", boundary_text(boundary));
  if (fem.incident_wave.is_there()) text += line("wave", wave_text(fem.incident_wave));
  for (const FemTie& tie : fem.ties) text += line("ties", tie.group + " moves with " + tie.opposite);
  for (const FemLoad& load : fem.loads)
    text += line("loads", fmt::format("{}: {} Pa on {}, full value after {} s", load.name, vector_text(load.traction), load.group,
                                      number(load.ramp)));
  for (const FemWater& water : fem.waters) text += line("water", water_text(water));
  for (const FemMember& member : fem.members) text += line("members", member_text(member));
  for (const FemDrain& drain : fem.drains) text += line("drains", drain.group);
  text += explain_gravity(fem.gravity.acceleration, fem.gravity.settle ? ", from equilibrium under gravity" : "");
  for (const Gauge& gauge : fem.gauges) text += line("gauges", fmt::format("{}: {} m", gauge.name, vector_text(gauge.point)));
  const auto count = [&](Real interval) { return whole_multiple(fem.time.end, interval).value_or(0); };
  text += line("time", fmt::format("to {} s in steps of {} s, {}, alpha {}, {} history rows, {} snapshots", number(fem.time.end),
                                   number(fem.time.step.value_or(0)), word(fem.time.analysis), number(fem.time.alpha),
                                   count(fem.time.history_interval), count(fem.time.snapshot_interval)));
  return text;
}

}  // namespace sazare::cases
