#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/cases/clocks.hpp"
#include "sazare/cases/number_text.hpp"
#include "sazare/cases/structure_check.hpp"
#include "sazare/cases/suggest.hpp"

namespace sazare::cases {
namespace {

std::vector<std::string> overrides_of(std::string_view side, std::span<const std::string> all) {
  std::vector<std::string> own;
  const std::string head = std::string(side) + ".";
  for (const std::string& setting : all)
    if (setting.starts_with(head)) own.push_back(setting.substr(head.size()));
  return own;
}

/// The case of a side, as it was typed in messages; nothing where it is of another method.
template <class Case>
std::shared_ptr<const CaseFile> read_side(const CheckContext& context, std::string_view key, std::string_view method,
                                          std::span<const std::string> overrides) {
  const Entry sides = context.entries_of("sides").front();
  if (!sides.gives(key)) return nullptr;
  const std::filesystem::path shown = context.shown_folder / *sides.value->find(key)->text();
  auto side = std::make_shared<CaseFile>(read_case(shown, overrides_of(key, overrides)));
  if (std::holds_alternative<Case>(side->content)) return side;
  context.problems.error(
      sides.place(key), fmt::format("{} is no case of method {}", shown.string(), method),
      fmt::format("the {} of a hybrid case are of method {}", key == "bodies" ? "bodies" : "finite elements", method));
  return nullptr;
}

void check_material(const CheckContext& context, const HybridCase& hybrid) {
  const Entry entry = context.entries_of("surface").front();
  if (!entry.gives("material") || !hybrid.bodies) return;
  std::vector<std::string> names;
  for (const SphereMaterial& material : hybrid.bodies->spheres().materials) names.push_back(material.name);
  if (std::ranges::find(names, hybrid.surface.material) != names.end()) return;
  context.problems.error(entry.place("material"), fmt::format("the bodies have no material \"{}\"", hybrid.surface.material),
                         full_suggestion(hybrid.surface.material, names, "materials"));
}

void check_width(const CheckContext& context, const HybridCase& hybrid) {
  const Entry entry = context.entries_of("surface").front();
  if (!hybrid.continuum) return;
  if (hybrid.continuum->fem().mesh.dimension == 3) return check_keys(context, entry, "a continuum in 3-D", {}, {"width"});
  check_keys(context, entry, "a continuum in 2-D", {"width"}, {});
  if (!entry.gives("width") || !hybrid.bodies) return;
  const Domain& domain = hybrid.bodies->spheres().domain;
  const Real length = domain.upper.z() - domain.lower.z();
  if (domain.periodic[2] && std::abs(length - hybrid.surface.width) > 1e-9 * length)
    context.problems.error(entry.place("width"),
                           fmt::format("the bodies repeat themselves along z every {} m, not {} m", short_number(length),
                                       short_number(hybrid.surface.width)),
                           "the width is that of the slab of bodies");
}

/// Both sides walk together, window by window.
void check_times(const HybridCase& hybrid) {
  const FemTime& continuum = hybrid.continuum->fem().time;
  const LeapfrogTime& bodies = hybrid.bodies->spheres().time;
  const auto must_equal = [&](std::string_view key, Real one, Real other) {
    if (one == other) return;
    refuse(*hybrid.bodies, fmt::format("time.{}", key),
           fmt::format("{} is {} s in {} and {} s in {}", key, short_number(other, 12), hybrid.bodies->path.string(),
                       short_number(one, 12), hybrid.continuum->path.string()),
           "both sides of a hybrid case have the same end, history_interval and snapshot_interval");
  };
  must_equal("end", continuum.end, bodies.end);
  must_equal("history_interval", continuum.history_interval, bodies.history_interval);
  must_equal("snapshot_interval", continuum.snapshot_interval, bodies.snapshot_interval);
  if (bodies.step && !whole_multiple(*continuum.step, *bodies.step))
    refuse(*hybrid.bodies, "time.step",
           fmt::format("the step of the finite elements, {} s in {}, is not a whole multiple of that of the bodies, {} s in {}",
                       short_number(*continuum.step, 12), hybrid.continuum->path.string(), short_number(*bodies.step, 12),
                       hybrid.bodies->path.string()),
           fmt::format("the nearest step that fits is {}; without a step one is chosen",
                       number_text(nearest_fraction(*continuum.step, *bodies.step))));
}

}  // namespace

void check_hybrid(const CheckContext& context, HybridCase& hybrid, std::span<const std::string> overrides) {
  const Entry sides = context.entries_of("sides").front();
  bool there = true;
  for (const auto& [key, path] : {std::pair{"continuum", hybrid.sides.continuum}, {"bodies", hybrid.sides.bodies}})
    there = there && sides.gives(key) && check_file(context, sides.place(key), "case", path, *sides.value->find(key)->text());
  if (!there || context.problems.has_errors()) return;
  hybrid.continuum = read_side<FemCase>(context, "continuum", "fem", overrides);
  hybrid.bodies = read_side<SpheresCase>(context, "bodies", "spheres", overrides);
  check_material(context, hybrid);
  check_width(context, hybrid);
  if (!context.problems.has_errors() && hybrid.continuum && hybrid.bodies) check_times(hybrid);
}

}  // namespace sazare::cases
