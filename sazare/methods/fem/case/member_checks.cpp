#include <fmt/format.h>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/fields.hpp"
#include "sazare/methods/fem/case/format.hpp"

namespace sazare::cases {
namespace {

void check_ends(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemMember& member) {
  if (entry.has("group")) {
    check_keys(context, entry, "a member along a group", {}, {"from", "to"});
    return;
  }
  check_keys(context, entry, "a member without group", {"from", "to"}, {});
  for (const auto& [key, place] : {std::pair{"from", member.from}, std::pair{"to", member.to}})
    if (entry.gives(key)) check_flat(context, entry, key, place, fem.mesh.dimension, "mesh");
}

void check_section(const CheckContext& context, const Entry& entry, const FemMember& member) {
  const std::string chosen = fmt::format("kind {}", EnumWords<FemMemberKind>::words.at(static_cast<std::size_t>(member.kind)));
  switch (member.kind) {
    case FemMemberKind::beam:
      check_keys(context, entry, chosen, {"youngs_modulus", "area", "second_moment", "density"},
                 {"prestress", "stiffness", "damping", "yield_force", "compression_force"});
      if (entry.gives("density") && !(member.density > 0))
        context.problems.error(entry.place("density"), "a beam needs a density above 0", "its rotations have no other inertia");
      break;
    case FemMemberKind::bar:
      check_keys(context, entry, chosen, {"youngs_modulus", "area"}, {"second_moment", "stiffness", "damping", "yield_moment"});
      break;
    case FemMemberKind::spring:
      check_keys(context, entry, chosen, {"stiffness"},
                 {"youngs_modulus", "area", "second_moment", "density", "damping_ratio", "prestress", "damping", "yield_moment"});
      break;
    case FemMemberKind::dashpot:
      check_keys(context, entry, chosen, {"damping"},
                 {"youngs_modulus", "area", "second_moment", "density", "damping_ratio", "prestress", "stiffness", "yield_force",
                  "compression_force", "yield_moment"});
      break;
  }
}

void check_limits(const CheckContext& context, const Entry& entry, const FemMember& member) {
  if (entry.gives("yield_force") && entry.gives("compression_force") && *member.compression_force > *member.yield_force)
    context.problems.error(entry.place("compression_force"),
                           fmt::format("it yields at {} N, before it gives way at {} N", short_number(*member.yield_force),
                                       short_number(*member.compression_force)),
                           "remove it: in compression too it yields at yield_force");
  if (!entry.gives("prestress")) return;
  const auto beyond = [&](std::string_view key, Real force, const std::string& help) {
    context.problems.error(
        entry.place("prestress"),
        fmt::format("a prestress of {} N is beyond the {} of {} N", short_number(member.prestress), key, short_number(force)),
        help);
  };
  if (entry.gives("yield_force") && std::abs(member.prestress) > *member.yield_force)
    beyond("yield_force", *member.yield_force, "a bar cannot begin with more than it bears");
  else if (entry.gives("compression_force") && -member.prestress > *member.compression_force)
    beyond("compression_force", *member.compression_force, "a bar cannot begin with more than it bears; tension is positive");
}

}  // namespace

void check_members(const CheckContext& context, const FemCase& fem) {
  const auto list = context.entries_of("members");
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].exists()) continue;
    check_ends(context, fem, list[i], fem.members[i]);
    if (list[i].gives("kind")) check_section(context, list[i], fem.members[i]);
    check_limits(context, list[i], fem.members[i]);
    if (fem.mesh.dimension == 3 && list[i].has("spacing"))
      context.problems.error(list[i].place("spacing"), "spacing is for members of a plane", "remove it");
  }
}

}  // namespace sazare::cases
