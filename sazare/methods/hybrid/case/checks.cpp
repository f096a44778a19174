#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/clocks.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/hybrid/case/continuum.hpp"
#include "sazare/methods/hybrid/case/format.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::cases {
namespace {

std::vector<std::string> overrides_of(std::string_view side, std::span<const std::string> all) {
  std::vector<std::string> own;
  const std::string head = std::string(side) + ".";
  for (const std::string& setting : all)
    if (setting.starts_with(head)) own.push_back(setting.substr(head.size()));
  return own;
}

/// The case of a side, as it was typed in messages; nothing where it is of none of these methods, which words name.
template <class... Case>
std::shared_ptr<const CaseFile> read_side(const CheckContext& context, std::string_view key, std::string_view methods) {
  const Entry sides = context.entries_of("sides").front();
  if (!sides.gives(key)) return nullptr;
  const std::filesystem::path shown = context.shown_folder / *sides.value->find(key)->text();
  const std::shared_ptr<CaseFile> side =
      std::make_shared<CaseFile>(context.read_side(shown, overrides_of(key, context.overrides), std::string(key) + "."));
  if ((side->template holds<Case>() || ...)) return side;
  context.problems.error(
      sides.place(key), fmt::format("{} is not a case of method {}", shown.string(), methods),
      fmt::format("the {} of a hybrid case are of method {}", key == "bodies" ? "bodies" : "finite elements", methods));
  return nullptr;
}

void check_material(const CheckContext& context, const SpheresCase& spheres, const std::string& material) {
  const Entry entry = context.entries_of("surface").front();
  check_keys(context, entry, "method spheres", {"material"}, {"friction_coefficient"});
  if (!entry.gives("material")) return;
  std::vector<std::string> names;
  for (const SphereMaterial& one : spheres.materials) names.push_back(one.name);
  if (std::ranges::find(names, material) != names.end()) return;
  context.problems.error(entry.place("material"), fmt::format("the bodies have no material \"{}\"", material),
                         full_suggestion(material, names, "materials"));
}

/// Checks the width of the slab of bodies that a continuum in 2-D needs.
void check_width(const CheckContext& context, const HybridCase& hybrid) {
  const Entry entry = context.entries_of("surface").front();
  if (continuum_of(hybrid).mesh.dimension == 3) return check_keys(context, entry, "a continuum in 3-D", {}, {"width"});
  check_keys(context, entry, "a continuum in 2-D", {"width"}, {});
  const auto* spheres = std::any_cast<SpheresCase>(&hybrid.bodies->content);
  if (!entry.gives("width") || spheres == nullptr) return;
  const Domain& domain = spheres->domain;
  const Real length = domain.upper.z() - domain.lower.z();
  if (domain.periodic[2] && std::abs(length - hybrid.surface.width) > 1e-9 * length)
    context.problems.error(entry.place("width"),
                           fmt::format("the bodies are periodic along z with the length {} m, not {} m", short_number(length),
                                       short_number(hybrid.surface.width)),
                           "the width is that of the slab of bodies");
}

/// Elements of rectangles have one contact law, and a thickness; they lie in the plane.
void check_rectangles_surface(const CheckContext& context, const HybridCase& hybrid) {
  check_keys(context, context.entries_of("surface").front(), "method rectangles", {},
             {"material", "width", "friction_coefficient"});
  if (continuum_of(hybrid).mesh.dimension == 2) return;
  context.problems.error(context.entries_of("sides").front().place("bodies"),
                         "bodies of method rectangles are two-dimensional, and the continuum is in 3-D",
                         "take a continuum with dimension = 2, or bodies of another method");
}

/// Ground has the dimension of the continuum. What its method can do alone and not beside a surface is refused.
void check_ground_surface(const CheckContext& context, const HybridCase& hybrid) {
  check_keys(context, context.entries_of("surface").front(), "method mps", {"friction_coefficient"}, {"material", "width"});
  const auto& ground = hybrid.bodies->as<MpsCase>();
  const int dimension = continuum_of(hybrid).mesh.dimension;
  if (ground.particles.dimension != dimension)
    context.problems.error(context.entries_of("sides").front().place("bodies"),
                           fmt::format("the ground is in {}-D, and the continuum in {}-D", ground.particles.dimension, dimension),
                           "give both the same dimension");
  if (context.problems.has_errors()) return;
  const auto& periodic = ground.particles.periodic;
  if (periodic[0] || periodic[1] || periodic[2])
    refuse(*hybrid.bodies, "particles.periodic", "ground of a hybrid case cannot be periodic: the surface is not",
           "remove periodic, and give its sides boundaries");
  if (ground.time.integrator == Integrator::euler)
    refuse(*hybrid.bodies, "time.integrator", "ground of a hybrid case cannot take Euler's steps, which have no energy balance",
           "set integrator = \"verlet\"");
  if (ground.particles.rotation_torque == RotationTorque::whole)
    refuse(*hybrid.bodies, "particles.rotation_torque", "the torque of ground that meets a surface keeps its angular momentum",
           "set rotation_torque = \"half\"");
}

void check_surface(const CheckContext& context, const HybridCase& hybrid) {
  if (!hybrid.continuum || !hybrid.bodies) return;
  if (hybrid.bodies->holds<MpsCase>()) return check_ground_surface(context, hybrid);
  if (hybrid.bodies->holds<RectanglesCase>()) return check_rectangles_surface(context, hybrid);
  if (hybrid.bodies->holds<BlocksCase>())
    check_keys(context, context.entries_of("surface").front(), "method blocks", {}, {"material", "friction_coefficient"});
  else
    check_material(context, hybrid.bodies->as<cases::SpheresCase>(), hybrid.surface.material);
  check_width(context, hybrid);
}

/// Clocks of bodies of any method [s].
struct BodiesClocks {
  std::string step_key;
  std::optional<Real> step;
  Real end, history_interval, snapshot_interval;
};

BodiesClocks clocks_of(const CaseFile& bodies) {
  const auto of = [](const std::string& key, const std::optional<Real>& step, const auto& time) {
    return BodiesClocks{key, step, time.end, time.history_interval, time.snapshot_interval};
  };
  if (const auto* blocks = std::any_cast<BlocksCase>(&bodies.content))
    return of("base_step", blocks->time.base_step, blocks->time);
  if (const auto* rectangles = std::any_cast<RectanglesCase>(&bodies.content))
    return of("step", rectangles->time.step, rectangles->time);
  if (const auto* ground = std::any_cast<MpsCase>(&bodies.content)) return of("step", ground->time.step, ground->time);
  return of("step", bodies.as<cases::SpheresCase>().time.step, bodies.as<cases::SpheresCase>().time);
}

/// Both sides walk together, window by window.
void check_times(const HybridCase& hybrid) {
  const auto& continuum = continuum_of(hybrid).time;
  const BodiesClocks bodies = clocks_of(*hybrid.bodies);
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
    refuse(*hybrid.bodies, "time." + bodies.step_key,
           fmt::format("the step of the finite elements, {} s in {}, is not a whole multiple of that of the bodies, {} s in {}",
                       short_number(*continuum.step, 12), hybrid.continuum->path.string(), short_number(*bodies.step, 12),
                       hybrid.bodies->path.string()),
           fmt::format("the nearest step that fits is {}; without a step one is chosen",
                       number_text(nearest_fraction(*continuum.step, *bodies.step))));
}

/// Bodies that settle would do so without the continuum.
void check_rest(const HybridCase& hybrid) {
  const auto* blocks = std::any_cast<BlocksCase>(&hybrid.bodies->content);
  if (blocks == nullptr || !blocks->settles()) return;
  refuse(*hybrid.bodies, blocks->gravity.settle ? "gravity.settle" : "initial_stress.settle",
         "blocks of a hybrid case do not settle: without the continuum nothing holds them at the surface", "remove settle");
}

/// The water of the bodies is that before the surface.
void check_waters(const CheckContext& context, const HybridCase& hybrid) {
  const auto* spheres = std::any_cast<SpheresCase>(&hybrid.bodies->content);
  if (spheres == nullptr || !spheres->water.is_there()) return;
  for (const auto& water : continuum_of(hybrid).waters)
    if (water.group == hybrid.surface.group && (water.level != *spheres->water.level || water.density != spheres->water.density))
      context.problems.warning(
          context.entries_of("surface").front().place("group"),
          fmt::format("the bodies are in water of {} kg/m3 up to {} m, and \"{}\" on the surface has {} kg/m3 up to {} m",
                      short_number(spheres->water.density), short_number(*spheres->water.level), water.name,
                      short_number(water.density), short_number(water.level)),
          "give [water] of the bodies and [[water_pressures]] of the finite elements the same level and density");
}

}  // namespace

void check_hybrid(const CheckContext& context, HybridCase& hybrid) {
  const Entry sides = context.entries_of("sides").front();
  bool there = true;
  for (const auto& [key, path] : {std::pair{"continuum", hybrid.sides.continuum}, {"bodies", hybrid.sides.bodies}})
    there = there && sides.gives(key) && check_file(context, sides.place(key), "case", path, *sides.value->find(key)->text());
  if (!there || context.problems.has_errors()) return;
  hybrid.continuum = read_side<ContinuumCase>(context, "continuum", continuum_method);
  hybrid.bodies =
      read_side<SpheresCase, RectanglesCase, BlocksCase, MpsCase>(context, "bodies", "spheres, rectangles, blocks or mps");
  check_surface(context, hybrid);
  if (!context.problems.has_errors() && hybrid.continuum && hybrid.bodies) {
    check_times(hybrid);
    check_rest(hybrid);
    check_waters(context, hybrid);
  }
}

}  // namespace sazare::cases
