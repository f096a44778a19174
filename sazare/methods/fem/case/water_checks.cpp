#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/methods/fem/case/fields.hpp"
#include "sazare/methods/fem/case/format.hpp"

/// What can be wrong with still water on faces and in joints.
namespace sazare::cases {
namespace {

/// The pressure follows from gravity, which must be there and vertical.
void check_gravity_of_water(const CheckContext& context, const FemCase& fem, const Place& water, bool may_be_none) {
  const Entry gravity = context.entries_of("gravity").front();
  if (!gravity.is_sound("acceleration")) return;
  const int up = fem.mesh.dimension - 1;
  const std::string help =
      fmt::format("set acceleration = [0.0, {}] in [gravity], in m/s2", up == 1 ? "-9.81, 0.0" : "0.0, -9.81");
  if (may_be_none && gravity.has("acceleration") && fem.gravity.acceleration.norm() == 0) return;
  if (fem.gravity.acceleration.norm() == 0) return context.problems.error(water, "the pressure of water requires gravity", help);
  Vector3 across = fem.gravity.acceleration;
  across[up] = 0;
  if (across.norm() == 0 && fem.gravity.acceleration[up] < 0) return;
  context.problems.error(gravity.place("acceleration"),
                         fmt::format("the level of water is horizontal where gravity acts along -{}; here it acts along {}",
                                     "xyz"[up], vector_text(fem.gravity.acceleration.normalized())),
                         help + ", or remove the water");
}

void check_place(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemWater& water) {
  if (entry.has("group") == entry.has("joint"))
    return context.problems.error(entry.header(),
                                  fmt::format("the water has {} group and joint", entry.has("group") ? "both" : "neither of"),
                                  "give exactly one of them: a group of outer faces, or the name of one of the [[joints]]");
  if (!entry.gives("joint")) return;
  std::vector<std::string> names;
  for (const FemJoint& joint : fem.joints) names.push_back(joint.name);
  if (std::ranges::find(names, water.joint) == names.end())
    context.problems.error(entry.place("joint"), fmt::format("there is no joint \"{}\"", water.joint),
                           full_suggestion(water.joint, names, "joints"));
}

void check_uplift(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemWater& water) {
  if (!entry.has("far_level"))
    return check_keys(context, entry, "water without a far_level", {}, {"direction"}, "give far_level, or remove it");
  if (!entry.has("direction")) return;
  check_flat(context, entry, "direction", water.direction, fem.mesh.dimension, "mesh");
  if (water.direction[fem.mesh.dimension - 1] != 0 || water.direction.norm() == 0)
    context.problems.error(entry.place("direction"), "the direction is not horizontal",
                           "give a direction along the base, from the end with level to the one with far_level, such as "
                           "[1.0, 0.0, 0.0]");
}

void check_added_mass(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemWater& water) {
  if (entry.has("added_mass") && !entry.gives("added_mass")) return;
  if (water.added_mass == AddedMass::none)
    return check_keys(context, entry, "water without added_mass", {}, {"bed"}, "set added_mass = \"westergaard\", or remove it");
  const Place place = entry.place("added_mass");
  for (const std::string_view key : {"joint", "far_level"})
    if (entry.has(key))
      context.problems.error(place, fmt::format("added_mass is for walls beside open water, not with {}", key), "remove it");
  if (water.bed && entry.gives("bed") && entry.gives("level") && *water.bed >= water.level)
    context.problems.error(entry.place("bed"),
                           fmt::format("the bed at {} m is not below the level of the water at {} m", short_number(*water.bed),
                                       short_number(water.level)),
                           "give the elevation of the ground under the water");
  if (fem.time.analysis == Analysis::statics)
    context.problems.warning(place, "added_mass has no effect in a static analysis, where nothing accelerates",
                             "remove it, or set analysis = \"dynamic\" in [time]");
}

}  // namespace

namespace {

/// Below the table the pores hold no more water than they have room for.
void check_content_of_pores(const CheckContext& context, const Entry& entry, const FemMaterial& material) {
  if (!entry.gives("saturated_density") || !entry.gives("density") || !entry.gives("porosity")) return;
  const Real full = material.density + material.porosity * material.pore_water_density;
  if (material.saturated_density <= 1.01 * full) return;
  context.problems.warning(
      entry.place("saturated_density"),
      fmt::format("saturated ground of {} kg/m3 is heavier than dry ground of {} kg/m3 with {} kg/m3 of water in its pores",
                  short_number(material.saturated_density), short_number(material.density),
                  short_number(material.porosity * material.pore_water_density)),
      fmt::format("with this density and porosity it is {} kg/m3 at most", short_number(full)));
}

/// A skeleton that hardly changes its volume leaves the water nothing to carry.
void check_skeleton(const CheckContext& context, const Entry& entry, const FemMaterial& material) {
  if (!entry.gives("poisson_ratio") || !entry.gives("youngs_modulus") || !entry.gives("porosity")) return;
  if (!(material.poisson_ratio > 0.45)) return;
  const Real water = material.water_bulk_modulus / material.porosity;
  context.problems.warning(
      entry.place("poisson_ratio"),
      fmt::format("the skeleton with a Poisson's ratio of {} hardly changes its volume: of a sudden load the water takes {} %",
                  short_number(material.poisson_ratio), short_number(100 * water / (water + material.constrained_modulus()), 2)),
      "give the Poisson's ratio of the drained skeleton, 0.2 to 0.4; the water adds its own stiffness");
}

void check_drainage(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemMaterial& material) {
  if (entry.has("drainage") && !entry.gives("drainage")) return;  // which keys belong to it is not known
  const auto what = fmt::format("drainage \"{}\"", word(material.drainage));
  if (material.drainage == Drainage::drained)
    return check_keys(context, entry, what, {}, {"porosity", "water_bulk_modulus", "hydraulic_conductivity"},
                      "remove it, or set drainage = \"undrained\" or \"flow\"");
  if (material.drainage == Drainage::undrained)
    check_keys(context, entry, what, {"porosity"}, {"hydraulic_conductivity"}, "remove it, or set drainage = \"flow\"");
  else
    check_keys(context, entry, what, {"porosity", "hydraulic_conductivity"}, {});
  if (material.dilation_angle > 0)
    context.problems.warning(entry.place("dilation_angle"),
                             "ground that dilates while its water cannot leave bears more and more by suction, without limit",
                             "give dilation_angle = 0, or compare the pore pressure with -100 kPa, at which water cavitates");
  if (fem.gravity.acceleration.norm() == 0 && material.drainage == Drainage::flow)
    context.problems.warning(entry.place("hydraulic_conductivity"), "without gravity no water flows",
                             "the hydraulic conductivity counts by the weight of the water: give gravity an acceleration");
  if (entry.gives("saturated_density") && entry.gives("porosity") &&
      material.saturated_density < material.porosity * material.pore_water_density)
    context.problems.error(entry.place("saturated_density"), "the saturated ground is lighter than the water in its pores",
                           "check saturated_density and porosity");
  check_content_of_pores(context, entry, material);
  check_skeleton(context, entry, material);
}

}  // namespace

void check_pore_water(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemMaterial& material) {
  if (!material.water_table)
    return check_keys(
        context, entry, "a material without a water_table", {},
        {"saturated_density", "pore_water_density", "drainage", "porosity", "water_bulk_modulus", "hydraulic_conductivity"},
        "give the material a water_table, or remove it");
  check_keys(context, entry, "a material with a water_table", {"saturated_density"}, {});
  check_drainage(context, fem, entry, material);
  check_gravity_of_water(context, fem, entry.place("water_table"), true);
  if (entry.gives("saturated_density") && entry.gives("density") && material.saturated_density < material.density)
    context.problems.warning(
        entry.place("saturated_density"),
        fmt::format("saturated ground of {} kg/m3 is lighter than the ground above the water table, {} kg/m3",
                    short_number(material.saturated_density), short_number(material.density)),
        "density is that above the water table; saturated_density includes the water in the pores");
}

namespace {

/// Waters on the same faces add up, which is rarely meant.
void check_doubles(const CheckContext& context, const std::vector<Entry>& list, const FemCase& fem, std::size_t number) {
  const auto& own = fem.waters[number];
  const std::string_view key = own.in_joint() ? "joint" : "group";
  for (std::size_t other = 0; other < number; ++other) {
    const auto& before = fem.waters[other];
    if (!list[number].gives(key) || before.in_joint() != own.in_joint() || before.group != own.group || before.joint != own.joint)
      continue;
    return context.problems.warning(
        list[number].place(key),
        fmt::format("the waters \"{}\" and \"{}\" act on the same faces: their pressures add up", before.name, own.name),
        "keep one of them, unless one is a rise that the other does not contain");
  }
}

/// Water in the pores and the water before the ground are the same water.
void check_pore_density(const CheckContext& context, const FemCase& fem) {
  const auto materials = context.entries_of("materials");
  for (std::size_t m = 0; m < fem.materials.size() && m < materials.size(); ++m) {
    const Real density = fem.materials[m].pore_water_density;
    const bool is_known = std::ranges::any_of(fem.waters, [&](const auto& water) { return water.density == density; });
    if (!fem.materials[m].water_table || fem.waters.empty() || is_known) continue;
    context.problems.warning(
        materials[m].place("water_table"),
        fmt::format("the water in the pores has {} kg/m3, and no entry of [[water_pressures]] has", short_number(density)),
        "give pore_water_density the density of the water before the ground, or their pressures do not agree");
  }
}

}  // namespace

void check_water(const CheckContext& context, const FemCase& fem) {
  const auto list = context.entries_of("water_pressures");
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].exists()) continue;
    if (i == 0) check_gravity_of_water(context, fem, list[i].header(), false);
    check_place(context, fem, list[i], fem.waters[i]);
    check_uplift(context, fem, list[i], fem.waters[i]);
    check_added_mass(context, fem, list[i], fem.waters[i]);
    check_doubles(context, list, fem, i);
  }
  check_pore_density(context, fem);
}

}  // namespace sazare::cases
