#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/format/suggest.hpp"
#include "sazare/methods/fem/case/fields.hpp"
#include "sazare/methods/fem/case/format.hpp"

/// What can be wrong with a wave that comes in at an angle.
namespace sazare::cases {
namespace {

void check_names(const CheckContext& context, const FemCase& fem, const Entry& entry) {
  std::vector<std::string> names;
  for (const Motion& motion : fem.motions) names.push_back(motion.name);
  const std::string& name = fem.incident_wave.motion;
  if (entry.gives("motion") && std::ranges::find(names, name) == names.end())
    context.problems.error(entry.place("motion"), fmt::format("there is no motion \"{}\"", name),
                           full_suggestion(name, names, "motions"));
  for (const Motion& motion : fem.motions)
    if (entry.gives("motion") && motion.name == name && motion.type == MotionShape::function)
      context.problems.error(entry.place("motion"), "the motion of an incident wave must be known before the run",
                             "write the values of the function into a file, and give the motion type = \"record\"");
}

void check_ties_under_wave(const CheckContext& context) {
  for (const Entry& tie : context.entries_of("ties"))
    if (tie.exists())
      context.problems.error(tie.header(), "tied sides move at the same time, and a wave at an angle reaches one after the other",
                             "remove the ties: sides of kind free_field take their place");
}

void check_dimension(const CheckContext& context, const FemCase& fem, const Entry& entry) {
  if (fem.mesh.dimension == 3) return;
  if (fem.incident_wave.kind == IncidentWaveKind::sh)
    context.problems.error(entry.place("kind"), "the motion of an sh wave is along z, which there is not in 2-D",
                           "set dimension = 3 in [mesh], or kind = \"sv\"");
  if (fem.incident_wave.azimuth != 0)
    context.problems.error(entry.place("azimuth"), "in 2-D a wave travels in the plane", "remove it");
}

/// The wave comes through all boundaries that let waves leave, and through no other.
void check_other_motions(const CheckContext& context, const FemCase& fem) {
  const auto list = context.entries_of("boundaries");
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!fem.boundaries[i].motion[axis].empty())
        context.problems.error(list[i].place(motion_name_keys[axis]),
                               "with an [incident_wave] no boundary has a motion of its own",
                               "remove it: the wave comes through all viscous and free-field boundaries");
}

void check_way_in(const CheckContext& context, const FemCase& fem, const Entry& entry) {
  for (const GroupKind kind : {GroupKind::viscous, GroupKind::free_field})
    if (std::ranges::count(fem.boundaries, kind, &GroupBoundary::kind) == 0)
      context.problems.error(entry.header(),
                             fmt::format("an incident wave requires a boundary of kind {}",
                                         EnumWords<GroupKind>::words.at(static_cast<std::size_t>(kind))),
                             "it comes in through a level viscous base and vertical free_field sides: give the body both");
}

}  // namespace

void check_incident_wave(const CheckContext& context, const FemCase& fem) {
  const Entry entry = context.entries_of("incident_wave").front();
  if (!entry.exists()) return;
  check_names(context, fem, entry);
  check_dimension(context, fem, entry);
  check_other_motions(context, fem);
  check_way_in(context, fem, entry);
  check_ties_under_wave(context);
}

}  // namespace sazare::cases
