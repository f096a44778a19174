#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/soil/checks.hpp"
#include "sazare/methods/fem/case/fields.hpp"
#include "sazare/methods/fem/case/format.hpp"

namespace sazare::cases {
namespace {

template <class Enum>
std::string word(Enum value) {
  return std::string(EnumWords<Enum>::words.at(static_cast<std::size_t>(value)));
}

bool lets_waves_leave(GroupKind kind) { return kind == GroupKind::viscous || kind == GroupKind::free_field; }

void check_materials(const CheckContext& context, FemCase& fem) {
  std::map<std::string, Place> seen;
  const auto list = context.entries_of("materials");
  for (std::size_t i = 0; i < list.size(); ++i) {
    FemMaterial& material = fem.materials[i];
    for (std::size_t k = 0; list[i].gives("regions") && k < material.regions.size(); ++k)
      if (const Place place = list[i].place("regions", k); !seen.try_emplace(material.regions[k], place).second)
        context.problems.error(place, fmt::format("region \"{}\" has two materials", material.regions[k]),
                               "name each region once");
    const bool has_modulus = list[i].gives("youngs_modulus") && list[i].gives("poisson_ratio");
    check_soil(context, list[i], {material.shear_modulus(), has_modulus, material.yields}, material);
    check_pore_water(context, fem, list[i], material);
    if (!material.yields) {
      check_keys(
          context, list[i], "a material without cohesion", {},
          {"friction_angle", "dilation_angle", "tensile_strength", "blow_count", "contraction_rate", "contraction_threshold"},
          "give the material a cohesion, 0.0 where it has none, or remove it");
      continue;
    }
    check_contraction(context, fem, list[i], material);
    check_keys(context, list[i], "a material with a cohesion", {"friction_angle"}, {});
    check_strength(context, list[i],
                   {material.cohesion, material.friction_angle, material.dilation_angle, material.tensile_strength.value_or(0)});
  }
}

void check_joints(const CheckContext& context) {
  for (const Entry& entry : context.entries_of("joints")) {
    if (!entry.exists() || entry.has("between") != entry.has("group")) continue;
    context.problems.error(entry.header(),
                           fmt::format("the joint has {} between and group", entry.has("group") ? "both" : "neither of"),
                           "give exactly one of them: the two regions on its sides, or a group of faces inside the body");
  }
}

/// A tie is one, whichever side it names first.
void check_ties(const CheckContext& context, const FemCase& fem) {
  const auto list = context.entries_of("ties");
  const auto pair_of = [](const FemTie& tie) { return std::minmax(tie.group, tie.opposite); };
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t other = 0; other < i; ++other)
      if (list[i].gives("group") && list[i].gives("opposite") && pair_of(fem.ties[i]) == pair_of(fem.ties[other])) {
        context.problems.error(
            list[i].header(), fmt::format("the groups \"{}\" and \"{}\" are tied twice", fem.ties[i].group, fem.ties[i].opposite),
            "remove one of the two [[ties]]");
        break;
      }
}

void check_boundaries(const CheckContext& context, const FemCase& fem) {
  std::vector<std::string> names;
  for (const Motion& motion : fem.motions) names.push_back(motion.name);
  const auto list = context.entries_of("boundaries");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    const GroupBoundary& boundary = fem.boundaries[i];
    if (!entry.gives("group") || !entry.gives("kind")) continue;
    const bool moves = boundary.kind == GroupKind::prescribed || boundary.kind == GroupKind::viscous;
    const bool takes_axes = boundary.kind == GroupKind::roller || boundary.kind == GroupKind::prescribed;
    if (!moves)
      check_keys(context, entry, "kind " + word(boundary.kind), {}, {motion_name_keys.begin(), motion_name_keys.end()});
    check_keys(context, entry, "kind " + word(boundary.kind),
               boundary.kind == GroupKind::roller ? std::vector<std::string_view>{"axes"} : std::vector<std::string_view>{},
               takes_axes ? std::vector<std::string_view>{} : std::vector<std::string_view>{"axes"});
    if (fem.mesh.dimension == 2 && (boundary.axes[2] || !boundary.motion[2].empty()))
      context.problems.error(entry.header(), "there is no axis z in 2-D", "set dimension = 3 in [mesh], or remove z");
    check_motion_names(context, entry, boundary.motion, names);
    if (fem.time.analysis == Analysis::statics && lets_waves_leave(boundary.kind))
      context.problems.error(entry.place("kind"),
                             fmt::format("a boundary of kind {} requires a dynamic analysis", word(boundary.kind)),
                             "hold the group in another way, or set analysis = \"dynamic\" in [time]");
  }
}

void check_gravity(const CheckContext& context, const FemCase& fem) {
  const Entry entry = context.entries_of("gravity").front();
  check_flat(context, entry, "acceleration", fem.gravity.acceleration, fem.mesh.dimension, "mesh");
  const bool none = fem.gravity.acceleration.norm() == 0;
  if (fem.gravity.settle && none)
    context.problems.error(entry.place("settle"), "settle requires gravity", "give gravity an acceleration");
  const bool sides = std::ranges::count(fem.boundaries, GroupKind::free_field, &GroupBoundary::kind) > 0;
  Vector3 along = fem.gravity.acceleration;
  along[fem.mesh.dimension - 1] = 0;
  if (sides && !along.isZero())
    context.problems.error(entry.place("acceleration"), "beside free-field sides gravity must be vertical",
                           "turn the model, so that gravity acts along its last axis");
  if (fem.gravity.settle || none) return;
  for (const GroupBoundary& boundary : fem.boundaries)
    if (lets_waves_leave(boundary.kind))
      context.problems.error(entry.header(),
                             fmt::format("under gravity a boundary of kind {} yields without limit", word(boundary.kind)),
                             "add settle = true to [gravity]: the boundary then carries its reactions in equilibrium");
}

}  // namespace

void check_fem(const CheckContext& context, FemCase& fem) {
  check_mesh_file(context, fem.mesh);
  check_unique(context, "materials", fem.materials);
  check_unique(context, "joints", fem.joints);
  check_unique(context, "motions", fem.motions);
  check_unique(context, "loads", fem.loads);
  check_unique(context, "members", fem.members);
  check_unique(context, "water_pressures", fem.waters);
  check_unique(context, "gauges", fem.gauges);
  check_materials(context, fem);
  check_joints(context);
  check_ties(context, fem);
  std::vector<Real> ratios;
  for (const FemMaterial& material : fem.materials) ratios.push_back(material.damping_ratio);
  for (const FemMember& member : fem.members) ratios.push_back(member.damping_ratio);
  check_damping(context, fem.damping, ratios);
  check_motions(context, fem.motions, fem.time.end);
  check_boundaries(context, fem);
  check_incident_wave(context, fem);
  check_gravity(context, fem);
  check_water(context, fem);
  check_members(context, fem);
  const auto loads = context.entries_of("loads");
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (loads[i].exists()) check_flat(context, loads[i], "traction", fem.loads[i].traction, fem.mesh.dimension, "mesh");
  const auto gauges = context.entries_of("gauges");
  for (std::size_t i = 0; i < gauges.size(); ++i)
    if (gauges[i].exists()) check_flat(context, gauges[i], "point", fem.gauges[i].point, fem.mesh.dimension, "mesh");
  const Entry time = context.entries_of("time").front();
  if (fem.time.analysis == Analysis::statics && time.has("alpha"))
    context.problems.error(time.place("alpha"), "alpha requires a dynamic analysis", "remove it");
}

}  // namespace sazare::cases
