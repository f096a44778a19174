#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/methods/blocks/case/checks.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 15> bond_keys{"law",
                                                     "rate_law",
                                                     "rate_energy_exponent",
                                                     "joint_normal_stiffness",
                                                     "joint_shear_stiffness",
                                                     "joint_normal_damping",
                                                     "joint_shear_damping",
                                                     "damping_ratio",
                                                     "cohesion",
                                                     "friction_angle",
                                                     "friction_coefficient",
                                                     "fracture_energy",
                                                     "tensile_strength",
                                                     "weibull_modulus",
                                                     "scatter_seed"};
constexpr std::array<std::string_view, 3> keys_of_bonded{"cohesion", "tensile_strength", "fracture_energy"};
constexpr std::array<std::string_view, 2> stiffness_keys{"joint_normal_stiffness", "joint_shear_stiffness"};

/// Whether a key is one that only a bonded joint has.
bool is_bond_key(std::string_view key) {
  const auto has_name = [&](const laws::LawParameter& parameter) { return parameter.name == key; };
  return std::ranges::find(bond_keys, key) != bond_keys.end() ||
         std::ranges::any_of(laws::parameters_of_laws<laws::JointLaws>, has_name) ||
         std::ranges::any_of(laws::parameters_of_laws<laws::RateLaws>, has_name);
}

std::string header_of(const Entry& entry) { return table_header(*entry.table); }

void check_place(const CheckContext& context, const Entry& entry) {
  const bool between = entry.has("between");
  const bool surface = entry.has("surface");
  if (between && surface)
    context.problems.error(entry.place("surface"), "a joint has either between or surface, not both",
                           "keep between for the faces of two materials, or surface for one group of faces");
  if (!between && !surface)
    context.problems.error(entry.header(), "[[joints]] has neither between nor surface",
                           "add between = [\"material\", \"material\"], or surface = \"group\"");
}

void check_friction(const CheckContext& context, const Entry& entry) {
  const bool angle = entry.has("friction_angle");
  const bool coefficient = entry.has("friction_coefficient");
  if (angle && coefficient)
    context.problems.error(entry.place("friction_angle"),
                           "friction is given twice, as friction_coefficient and as friction_angle", "keep one");
  if (!angle && !coefficient)
    context.problems.error(entry.header(), header_of(entry) + " has no friction",
                           "add friction_coefficient = ..., or friction_angle = ... (deg)");
}

void check_unbonded(const CheckContext& context, const Entry& entry) {
  std::vector<std::string> given;
  for (const Member& member : *entry.value->members())
    if (is_bond_key(member.key)) given.push_back(member.key);
  if (given.empty()) return;
  context.problems.error(
      *entry.value->key_place(given.front()),
      fmt::format("{} ha{} no effect when bonded = false", fmt::join(given, ", "), given.size() == 1 ? "s" : "ve"),
      "remove the keys of a bonded joint, or set bonded = true; free faces have the properties of [contact]");
}

/// Softening must end beyond the elastic limit: 2 G / s >= s / k, for the strongest of faces that scatter.
void check_strength(const CheckContext& context, const Entry& entry, const Joint& joint) {
  const Real strength = joint.tensile_strength;
  const Real energy = joint.fracture_energy;
  const Real stiffness = joint.normal_stiffness.value() / joint.largest_factor();
  const Real largest = std::sqrt(2 * energy * stiffness);
  if (strength <= largest) return;
  const auto rounded = [](Real value, Real direction) {
    if (!(value > 0) || !std::isfinite(value)) return short_number(value);
    const Real unit = std::pow(10, std::floor(std::log10(value)) - 3);
    return short_number((direction > 0 ? std::ceil(value / unit) : std::floor(value / unit)) * unit, 4);
  };
  context.problems.error(
      entry.place("tensile_strength"),
      fmt::format("tensile_strength {} Pa is too large for this fracture_energy and joint_normal_stiffness",
                  short_number(strength)),
      fmt::format("softening would end at an opening of {} m, before the strength is reached at {} m; the largest "
                  "strength that does is sqrt(2 fracture_energy joint_normal_stiffness) = {} Pa, the smallest "
                  "fracture_energy for this strength {} N/m",
                  short_number(2 * energy / strength, 4), short_number(strength / stiffness, 4), rounded(largest, -1),
                  rounded(strength * strength / (2 * stiffness), +1)));
}

/// What the law of a list that is chosen takes beside what all take is given, and what only others take is not.
template <class Laws, class Name>
void check_parameters_of(const CheckContext& context, const Entry& entry, std::string_view key, Name chosen) {
  laws::visit_law_at<Laws>(static_cast<std::size_t>(chosen), [&]<class Law>(Law) {
    std::vector<std::string_view> needed, foreign;
    for (const laws::LawParameter& parameter : laws::parameters_of_laws<Laws>) {
      if (!laws::takes<Law>(parameter.name))
        foreign.push_back(parameter.name);
      else if (!parameter.may_be_absent)
        needed.push_back(parameter.name);
    }
    check_keys(context, entry, fmt::format("{} {}", key, Law::word), needed, foreign);
  });
}

/// Stress becomes strain by Young's modulus, and a strain rate is what a rate law asks for.
void check_rate_law(const CheckContext& context, const Entry& entry, const Joint& joint, const BlocksCase& blocks) {
  if (!entry.is_sound("rate_law")) return;
  check_parameters_of<laws::RateLaws>(context, entry, "rate_law", joint.by_rate.law);
  if (!joint.follows_rate()) {
    if (entry.has("rate_energy_exponent"))
      context.problems.error(entry.place("rate_energy_exponent"), "rate_energy_exponent without a rate_law",
                             "choose a rate_law, or remove rate_energy_exponent");
    return;
  }
  for (const Material& material : blocks.materials) {
    const bool is_beside = joint.on_surface() || std::ranges::find(joint.between, material.name) != joint.between.end();
    if (!is_beside || material.youngs_modulus) continue;
    context.problems.error(
        entry.place("rate_law"),
        fmt::format("rate_law needs the strain rate, but the material \"{}\" has no youngs_modulus", material.name),
        "give the material youngs_modulus and poisson_ratio, or take rate_law = \"none\"");
    return;
  }
}

/// What the numbers of a law must fulfil together; a law with no more conditions than its keys have is content with this one.
template <class Law>
void check_numbers_of(Law, const CheckContext&, const Entry&, const Joint&) {}

/// Slip must go on to soften beyond the elastic limit, 2 G_II / c >= c / k_s, take more energy than opening, and not gain
/// friction.
void check_numbers_of(laws::MixedMode law, const CheckContext& context, const Entry& entry, const Joint& joint) {
  const Real energy = joint.law_parameter(law.shear_energy).value_or(0),
             residual = joint.law_parameter("residual_friction_coefficient").value_or(joint.friction_coefficient);
  const Real stiffness = joint.shear_stiffness.value_or(0) / joint.largest_factor(),
             needed = joint.cohesion * joint.cohesion / (2 * stiffness);
  const auto error = [&](std::string_view key, const std::string& what, const std::string& help) {
    context.problems.error(entry.place(key), what, help);
  };
  if (entry.gives("cohesion") && joint.cohesion == 0)
    error("cohesion", "law mixed_mode needs a cohesion above 0, which slip uses up",
          "give a cohesion, or use law linear_softening");
  if (entry.gives("joint_shear_stiffness") && joint.shear_stiffness == Real{0})
    error("joint_shear_stiffness", "law mixed_mode needs a joint_shear_stiffness above 0: without it no slip loads the joint",
          "give a joint_shear_stiffness, or use law linear_softening");
  else if (entry.gives("shear_fracture_energy") && entry.gives("joint_shear_stiffness") && energy < needed)
    error(
        "shear_fracture_energy",
        fmt::format("shear_fracture_energy {} N/m is too small for this cohesion and joint_shear_stiffness",
                    short_number(energy)),
        fmt::format(
            "cohesion would be used up at a slip of {} m, before it is reached at a shear displacement of {} m; the smallest "
            "shear_fracture_energy is cohesion^2 / (2 joint_shear_stiffness) = {} N/m",
            short_number(2 * energy / joint.cohesion, 4), short_number(joint.cohesion / stiffness, 4), short_number(needed, 4)));
  if (entry.gives("shear_fracture_energy") && entry.gives("fracture_energy") && energy < joint.fracture_energy)
    error("shear_fracture_energy",
          fmt::format("shear_fracture_energy {} N/m is below the fracture_energy {} N/m", short_number(energy),
                      short_number(joint.fracture_energy)),
          "rock and concrete need more energy in shear than in tension: check the two");
  const bool has_friction = entry.gives("friction_coefficient") || entry.gives("friction_angle");
  if (has_friction && entry.gives("residual_friction_coefficient") && residual > joint.friction_coefficient)
    error("residual_friction_coefficient",
          fmt::format("the residual friction {} is above the friction at the peak, {}", short_number(residual),
                      short_number(joint.friction_coefficient)),
          "a joint does not gain friction when it fails: exchange the two, or leave residual_friction_coefficient out");
}

void check_missing_stiffness(const CheckContext& context, const Entry& entry, std::string_view key, const std::string& help) {
  context.problems.error(entry.header(), fmt::format("[[joints]] has no \"{}\"", key),
                         how_to_add(*find_key(*entry.table, key)) + " " + help);
}

/// A joint has both stiffnesses of its own, or none: then all materials beside it have moduli.
void check_stiffness(const CheckContext& context, const Entry& entry, const Joint& joint, const BlocksCase& blocks) {
  const auto given = std::ranges::count_if(stiffness_keys, [&](std::string_view key) { return entry.has(key); });
  const auto is_beside = [&](const Material& material) {
    return joint.on_surface() || std::ranges::find(joint.between, material.name) != joint.between.end();
  };
  const auto names_moduli = [](const Material& material) { return material.youngs_modulus || material.poisson_ratio; };
  const auto lacks_moduli = [&](const Material& material) { return is_beside(material) && !names_moduli(material); };
  const auto without = std::ranges::find_if(blocks.materials, lacks_moduli);
  const bool some_have = std::ranges::any_of(blocks.materials, names_moduli);
  const bool inside = !joint.on_surface() && joint.between[0] == joint.between[1];
  if (given == 2) {
    if (inside && without == blocks.materials.end() && std::ranges::any_of(blocks.materials, is_beside))
      context.problems.error(
          entry.place(stiffness_keys[0]),
          fmt::format("the stiffness of the material \"{}\" is given twice, by youngs_modulus and by this joint",
                      joint.between[0]),
          "remove joint_normal_stiffness and joint_shear_stiffness here, or youngs_modulus and poisson_ratio of the "
          "material");
    return;
  }
  if (given == 0 && (without == blocks.materials.end() || some_have)) {
    if (without != blocks.materials.end())
      check_missing_stiffness(context, entry, stiffness_keys[0],
                              fmt::format("Or give the material \"{}\" youngs_modulus and poisson_ratio.", without->name));
    return;
  }
  if (given == 1) {
    const bool has_normal = entry.has(stiffness_keys[0]);
    const std::string_view has = stiffness_keys[has_normal ? 0 : 1], lacks = stiffness_keys[has_normal ? 1 : 0];
    context.problems.error(*entry.value->key_place(has), fmt::format("{} without {}", has, lacks),
                           how_to_add(*find_key(*entry.table, lacks)) +
                               (without == blocks.materials.end()
                                    ? fmt::format(" Or remove {}: the materials beside the joint have youngs_modulus.", has)
                                    : ""));
    return;
  }
  for (std::string_view key : stiffness_keys)
    if (!entry.has(key))
      check_missing_stiffness(context, entry, key,
                              "Needed unless bonded = false or its materials have youngs_modulus and poisson_ratio.");
}

void check_damping(const CheckContext& context, const Entry& entry) {
  for (std::string_view key : {"joint_normal_damping", "joint_shear_damping"})
    if (entry.has("damping_ratio") && entry.has(key))
      context.problems.error(
          *entry.value->key_place(key), fmt::format("the joint has both damping_ratio and {}", key),
          "keep damping_ratio, which suits elements of any size, or joint_normal_damping and joint_shear_damping");
}

/// What every joint with strength gives.
void check_strengths(const CheckContext& context, const Entry& entry, const Joint& joint, const BlocksCase& blocks) {
  for (std::string_view key : keys_of_bonded) {
    if (entry.has(key)) continue;
    const bool half_strength = key == "fracture_energy" && entry.has("tensile_strength");
    if (half_strength)
      context.problems.error(*entry.value->key_place("tensile_strength"), "tensile_strength without fracture_energy",
                             how_to_add(*find_key(*entry.table, key)));
    else
      context.problems.error(entry.header(), fmt::format("[[joints]] has no \"{}\"", key),
                             how_to_add(*find_key(*entry.table, key)) + " Needed unless bonded = false.");
  }
  check_friction(context, entry);
  check_rate_law(context, entry, joint, blocks);
}

void check_bonded(const CheckContext& context, const Entry& entry, const Joint& joint, const BlocksCase& blocks) {
  if (!entry.is_sound("law")) return;  // what else it takes depends on it
  if (!joint.is_natural()) check_strengths(context, entry, joint, blocks);
  check_stiffness(context, entry, joint, blocks);
  check_damping(context, entry);
  check_parameters_of<laws::JointLaws>(context, entry, "law", joint.law);
  if (joint.is_natural()) return check_natural_joint(context, entry, joint);
  if (entry.has("scatter_seed") && !entry.has("weibull_modulus"))
    context.problems.error(entry.place("scatter_seed"), "scatter_seed without weibull_modulus",
                           "add weibull_modulus, with which strengths scatter, or remove scatter_seed");
  laws::visit_joint_law(joint.law, [&](auto law) { check_numbers_of(law, context, entry, joint); });
  if (entry.gives("tensile_strength") && entry.gives("fracture_energy") && entry.gives("joint_normal_stiffness"))
    check_strength(context, entry, joint);
}

bool same_faces(const Joint& a, const Joint& b) {
  if (a.on_surface() || b.on_surface()) return a.surface == b.surface;
  const auto swapped = std::array{b.between[1], b.between[0]};
  return !a.between[0].empty() && (a.between == b.between || a.between == swapped);
}

/// The last entry that matches a face wins, so an entry can be of no effect at all.
void check_order(const CheckContext& context, const std::vector<Entry>& list, const BlocksCase& blocks) {
  const auto& joints = blocks.joints;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = i + 1; j < list.size(); ++j) {
      const bool covers_all = blocks.materials.size() == 1 && joints[i].on_surface() && !joints[j].on_surface() &&
                              joints[j].between[0] == blocks.materials[0].name;
      if (!covers_all && !same_faces(joints[i], joints[j])) continue;
      context.problems.error(list[i].header(),
                             fmt::format("joint \"{}\" is never used: joint \"{}\" below it applies to the same faces",
                                         joints[i].name, joints[j].name),
                             "where several joints match a face the last one applies; put the more specific one last");
      break;
    }
  }
}

}  // namespace

void check_joints(const CheckContext& context, const BlocksCase& blocks) {
  const auto list = context.entries_of("joints");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    if (!entry.exists()) continue;
    check_place(context, entry);
    if (!entry.is_sound("bonded")) continue;
    if (blocks.joints[i].bonded)
      check_bonded(context, entry, blocks.joints[i], blocks);
    else
      check_unbonded(context, entry);
  }
  check_order(context, list, blocks);
}

void check_contact(const CheckContext& context, const BlocksCase& blocks) {
  const Entry entry = context.entries_of("contact").front();
  if (!entry.exists()) return;
  check_friction(context, entry);
  if (!entry.is_sound("contact_shape")) return;
  if (blocks.contact.shape == ContactShape::faces)
    check_keys(context, entry, "contact_shape faces", {"face_contact_stiffness"}, {});
  else
    check_keys(context, entry, "contact_shape spheres", {"contact_stiffness"},
               {"face_contact_stiffness", "face_contact_damping"});
}

}  // namespace sazare::cases
