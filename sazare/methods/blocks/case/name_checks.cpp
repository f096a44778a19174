#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/cases/seen_names.hpp"
#include "sazare/methods/blocks/case/checks.hpp"
#include "sazare/methods/blocks/case/fields.hpp"

namespace sazare::cases {
namespace {

void check_materials(const CheckContext& context, const BlocksCase& blocks) {
  SeenNames seen;
  const auto list = context.entries_of("materials");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& regions = blocks.materials[i].regions;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const Place place = list[i].place("regions", k);
      if (const Place* before = seen.before(regions[k], place))
        context.problems.error(place, fmt::format("region \"{}\" has two materials", regions[k]),
                               fmt::format("name each region once; {}", other_line(*before)));
    }
  }
}

/// Only deformable elements have what needs moduli, and Poisson's ratios beyond those of rigid ones.
void check_deformable(const CheckContext& context, const BlocksCase& blocks) {
  const auto list = context.entries_of("materials");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    if (!entry.exists()) continue;
    const Material& material = blocks.materials[i];
    if (material.deformable && !entry.has("youngs_modulus") && !entry.has("poisson_ratio"))
      context.problems.error(entry.place("deformable"), "deformable elements without youngs_modulus and poisson_ratio",
                             how_to_add(*find_key(*entry.table, "youngs_modulus")));
    if (!material.deformable && entry.has("bulk_damping_ratio"))
      context.problems.error(entry.place("bulk_damping_ratio"), "bulk_damping_ratio of rigid elements",
                             "add deformable = true, or remove bulk_damping_ratio");
    if (!material.deformable && entry.is_sound("poisson_ratio") && material.poisson_ratio.value_or(0) > laws::most_poisson_ratio)
      context.problems.error(
          entry.place("poisson_ratio"),
          fmt::format("rigid elements can have a poisson_ratio of at most {}, found {}", laws::most_poisson_ratio,
                      *material.poisson_ratio),
          fmt::format("add deformable = true, with which it may be up to {}", laws::most_poisson_ratio_of_deformable));
  }
}

/// Young's modulus and Poisson's ratio stand together.
void check_moduli(const CheckContext& context) {
  for (const Entry& entry : context.entries_of("materials"))
    for (const auto& [given, missing] : {std::pair{"youngs_modulus", "poisson_ratio"}, {"poisson_ratio", "youngs_modulus"}})
      if (entry.exists() && entry.has(given) && !entry.has(missing))
        context.problems.error(*entry.value->key_place(given), fmt::format("{} without {}", given, missing),
                               how_to_add(*find_key(*entry.table, missing)));
}

void check_joined_materials(const CheckContext& context, const BlocksCase& blocks) {
  std::vector<std::string> names;
  for (const Material& material : blocks.materials)
    if (!material.name.empty()) names.push_back(material.name);
  const auto list = context.entries_of("joints");
  for (std::size_t i = 0; i < list.size() && !names.empty(); ++i) {
    if (!list[i].gives("between") || list[i].has("surface")) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string& name = blocks.joints[i].between[k];
      if (std::ranges::find(names, name) != names.end()) continue;
      context.problems.error(list[i].place("between", k), fmt::format("there is no material \"{}\"", name),
                             full_suggestion(name, names, "materials"));
    }
  }
}

void check_boundaries(const CheckContext& context, const BlocksCase& blocks) {
  SeenNames seen;
  const auto list = context.entries_of("boundaries");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string& surface = blocks.boundaries[i].surface;
    if (surface.empty()) continue;
    const Place place = list[i].place("surface");
    if (const Place* before = seen.before(surface, place))
      context.problems.error(place, fmt::format("surface \"{}\" has two boundaries", surface),
                             fmt::format("keep one; {}", other_line(*before)));
  }
}

void check_boundary_motions(const CheckContext& context, const BlocksCase& blocks) {
  std::vector<std::string> names;
  for (const Motion& motion : blocks.motions) names.push_back(motion.name);
  const auto list = context.entries_of("boundaries");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Boundary& boundary = blocks.boundaries[i];
    if (!list[i].exists() || !list[i].is_sound("kind")) continue;
    if (!boundary.can_move())
      check_keys(context, list[i], fmt::format("kind {}", word(boundary.kind)), {},
                 {motion_name_keys.begin(), motion_name_keys.end()});
    check_motion_names(context, list[i], boundary.motion, names);
    const auto is_empty = [](const std::string& name) { return name.empty(); };
    if (boundary.kind == BoundaryKind::prescribed && std::ranges::all_of(boundary.motion, is_empty))
      context.problems.error(list[i].place("kind"), "a prescribed boundary has no motion",
                             "add motion_x, motion_y or motion_z with the name of one of [[motions]], or make it \"fixed\"");
  }
}

void check_initial_velocities(const CheckContext& context, const BlocksCase& blocks) {
  SeenNames seen;
  const auto list = context.entries_of("initial_velocities");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& regions = blocks.initial_velocities[i].regions;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const Place place = list[i].place("regions", k);
      if (const Place* before = seen.before(regions[k], place))
        context.problems.error(place, fmt::format("region \"{}\" has two initial velocities", regions[k]),
                               fmt::format("keep one; {}", other_line(*before)));
    }
  }
}

}  // namespace

void check_names(const CheckContext& context, const BlocksCase& blocks) {
  check_unique(context, "materials", blocks.materials);
  check_unique(context, "joints", blocks.joints);
  check_unique(context, "blasts", blocks.blasts);
  check_unique(context, "charges", blocks.charges);
  check_unique(context, "motions", blocks.motions);
  check_unique(context, "gauges", blocks.gauges);
  check_materials(context, blocks);
  check_moduli(context);
  check_deformable(context, blocks);
  check_joined_materials(context, blocks);
  check_boundaries(context, blocks);
  check_boundary_motions(context, blocks);
  check_initial_velocities(context, blocks);
}

void check_constraints(const CheckContext& context, const BlocksCase& blocks) {
  const auto list = context.entries_of("constraints");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    if (!entry.exists() || !entry.is_sound("translation") || !entry.is_sound("rotation")) continue;
    const Constraint& constraint = blocks.constraints[i];
    const auto none = [](const std::array<bool, 3>& axes) { return !axes[0] && !axes[1] && !axes[2]; };
    if (!none(constraint.translation) || !none(constraint.rotation)) continue;
    context.problems.error(entry.header(), "this constraint has no axes",
                           "add translation = [\"z\"] or rotation = [\"z\"] with the axes to hold, or remove it");
  }
}

}  // namespace sazare::cases
