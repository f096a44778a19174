#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/cases/soil/checks.hpp"
#include "sazare/methods/mps/case/fields.hpp"
#include "sazare/methods/mps/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr Real fit_tolerance = 1e-6;  // of a spacing

template <class Enum>
std::string word(Enum value) {
  return std::string(EnumWords<Enum>::words.at(static_cast<std::size_t>(value)));
}

/// The dimension is a key of [particles].
void check_flat(const CheckContext& context, const Entry& entry, std::string_view key, const Vector3& value, int dimension) {
  check_flat(context, entry, key, value, dimension, "particles");
}

void check_rectangle(const CheckContext& context, const Entry& entry, const ParticleRegion& region, const ParticleRules& rules) {
  if (!entry.gives("lower") || !entry.gives("upper")) return;
  check_flat(context, entry, "lower", region.lower, rules.dimension);
  check_flat(context, entry, "upper", region.upper, rules.dimension);
  for (int axis = 0; axis < rules.dimension; ++axis) {
    const Real length = region.upper[axis] - region.lower[axis];
    if (!(length > 0)) {
      context.problems.error(entry.place("upper"), fmt::format("upper must be above lower on the axis {}", "xyz"[axis]),
                             "lower is the corner with the smallest coordinates");
      continue;
    }
    const Real count = length / rules.spacing;
    if (rules.fit == ParticleFit::inside || !(rules.spacing > 0)) continue;
    if (std::abs(count - std::round(count)) <= fit_tolerance && count > 0.5) continue;
    const Real whole = std::max(std::round(count), Real{1});
    context.problems.error(
        entry.place("upper"),
        fmt::format("the spacing does not fit the region: {} m on the axis {} is {} times {} m", short_number(length, 12),
                    "xyz"[axis], short_number(count), short_number(rules.spacing, 12)),
        fmt::format("the nearest spacing that fits is {} m; fit = \"inside\" in [particles] takes as many particles as fit",
                    short_number(length / whole, 12)));
  }
}

void check_polygon(const CheckContext& context, const Entry& entry, const ParticleRegion& region, const ParticleRules& rules) {
  if (rules.dimension == 3)
    context.problems.error(entry.place("shape"), "a polygon requires 2-D", "in 3-D use a rectangle or a mesh");
  if (!entry.gives("points")) return;
  const auto& points = region.points;
  if (points.front() != points.back())
    context.problems.error(entry.place("points"),
                           fmt::format("the region \"{}\" is not closed: it begins at ({}, {}) and ends at ({}, {})", region.name,
                                       short_number(points.front()[0]), short_number(points.front()[1]),
                                       short_number(points.back()[0]), short_number(points.back()[1])),
                           "write the first point again at the end");
}

void check_regions(const CheckContext& context, const MpsCase& mps) {
  const auto list = context.entries_of("regions");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    const ParticleRegion& region = mps.regions[i];
    if (!entry.exists() || !entry.is_sound("shape")) continue;
    const std::string chosen = "a " + word(region.shape);
    if (region.shape == RegionShape::rectangle) {
      check_keys(context, entry, chosen, {"lower", "upper"}, {"points", "file", "group"});
      check_rectangle(context, entry, region, mps.particles);
    } else if (region.shape == RegionShape::polygon) {
      check_keys(context, entry, chosen, {"points"}, {"lower", "upper", "file", "group"});
      check_polygon(context, entry, region, mps.particles);
    } else {
      check_keys(context, entry, chosen, {"file", "group"}, {"lower", "upper", "points"});
      if (entry.gives("file"))
        check_file(context, entry.place("file"), "mesh file", region.file, *entry.value->find("file")->text());
    }
  }
}

void check_velocities(const CheckContext& context, const Entry& entry, const Ground& ground) {
  if (!entry.exists()) return;
  int given = 0;
  bool sound = true;
  for (std::string_view key : {"s_wave_velocity", "p_wave_velocity", "poisson_ratio"}) {
    given += entry.has(key) ? 1 : 0;
    sound = sound && entry.is_sound(key);
  }
  if (given != 2) {
    context.problems.error(entry.header(),
                           fmt::format("[[materials]] gives {} of s_wave_velocity, p_wave_velocity and poisson_ratio", given),
                           "give exactly two of them");
    return;
  }
  if (!sound ||
      ground.p_wave_velocity * ground.p_wave_velocity >= 2 * ground.s_wave_velocity * ground.s_wave_velocity * (1 - 1e-12))
    return;
  context.problems.error(entry.place("p_wave_velocity"),
                         fmt::format("p_wave_velocity must be at least sqrt(2) times s_wave_velocity, found {} and {} m/s",
                                     short_number(ground.p_wave_velocity), short_number(ground.s_wave_velocity)),
                         "otherwise Poisson's ratio would be negative");
}

void check_materials(const CheckContext& context, const MpsCase& mps) {
  std::vector<std::string> names;
  for (const ParticleRegion& region : mps.regions) names.push_back(region.name);
  std::map<std::string, Place> seen;
  const auto list = context.entries_of("materials");
  for (std::size_t i = 0; i < list.size(); ++i) {
    check_velocities(context, list[i], mps.materials[i]);
    if (!list[i].gives("regions")) continue;
    const auto& regions = mps.materials[i].regions;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const Place place = list[i].place("regions", k);
      if (std::ranges::find(names, regions[k]) == names.end())
        context.problems.error(place, fmt::format("there is no region \"{}\"", regions[k]),
                               full_suggestion(regions[k], names, "regions"));
      if (!seen.try_emplace(regions[k], place).second)
        context.problems.error(place, fmt::format("region \"{}\" has two materials", regions[k]), "name each region once");
    }
  }
  const auto regions = context.entries_of("regions");
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (!names[i].empty() && !seen.contains(names[i]))
      context.problems.error(regions[i].place("name"), fmt::format("region \"{}\" has no material", names[i]),
                             "name it in the regions of one of the [[materials]]");
}

/// A residual value that is larger than the one at the peak is an error.
void check_fall(const CheckContext& context, const Entry& entry, const std::string& key, Real residual, Real peak,
                const char* unit) {
  if (!entry.is_sound("residual_" + key) || !entry.is_sound(key) || residual <= peak) return;
  context.problems.error(
      entry.place("residual_" + key),
      fmt::format("residual_{} must be at most {} = {} {}, found {}", key, key, short_number(peak), unit, short_number(residual)),
      "the strength of ground does not rise with shear");
}

/// Whether the particles can resolve it, the model says.
void check_softening(const CheckContext& context, const Entry& entry, const Ground& ground) {
  if (!ground.residual_cohesion && !ground.residual_friction_angle) {
    check_keys(context, entry, "a strength that stays", {}, {"softening_displacement"},
               "give a residual_cohesion or a residual_friction_angle, or remove it");
    return;
  }
  check_keys(context, entry, ground.residual_cohesion ? "a residual_cohesion" : "a residual_friction_angle",
             {"softening_displacement"}, {});
  check_fall(context, entry, "cohesion", ground.residual_cohesion.value_or(0), ground.cohesion, "Pa");
  check_fall(context, entry, "friction_angle", ground.residual_friction_angle.value_or(0), ground.friction_angle, "deg");
}

void check_strengths(const CheckContext& context, MpsCase& mps) {
  const auto list = context.entries_of("materials");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    Ground& ground = mps.materials[i];
    check_soil(context, entry, {ground.shear_modulus(), entry.gives("density") && ground.s_wave_velocity > 0, ground.yields},
               ground);
    if (!ground.yields) {
      check_keys(context, entry, "a material without cohesion", {},
                 {"friction_angle", "dilation_angle", "tensile_strength", "rupture_strain", "residual_cohesion",
                  "residual_friction_angle", "softening_displacement"},
                 "give the material a cohesion, 0.0 where it has none, or remove it");
      continue;
    }
    check_keys(context, entry, "a material with a cohesion", {"friction_angle"}, {});
    check_strength(context, entry, {ground.cohesion, ground.friction_angle, ground.dilation_angle, ground.tensile_strength.value_or(0)});
    check_softening(context, entry, ground);
  }
}

void check_gravity(const CheckContext& context, const MpsCase& mps) {
  const Entry entry = context.entries_of("gravity").front();
  check_flat(context, entry, "acceleration", mps.gravity.acceleration, mps.particles.dimension);
  if (mps.gravity.settle && mps.gravity.acceleration.norm() == 0)
    context.problems.error(entry.place("settle"), "settle requires gravity", "give gravity an acceleration");
  if (mps.gravity.settle && mps.noise.velocity > 0)
    context.problems.error(entry.place("settle"), "noise and settle cannot be combined", "remove [noise], or settle");
  const bool sides = std::ranges::count(mps.boundaries, SideKind::free_field, &SideBoundary::kind) > 0;
  Vector3 along = mps.gravity.acceleration;
  along[mps.particles.dimension - 1] = 0;
  if (sides && !along.isZero())
    context.problems.error(entry.place("acceleration"), "beside free-field sides gravity must be vertical",
                           "turn the model, so that gravity acts along its last axis");
  if (mps.gravity.settle || mps.gravity.acceleration.norm() == 0) return;
  const auto leaks = [](const SideBoundary& one) { return one.kind == SideKind::viscous || one.kind == SideKind::free_field; };
  if (const auto first = std::ranges::find_if(mps.boundaries, leaks); first != mps.boundaries.end())
    context.problems.error(entry.header(),
                           fmt::format("under gravity a {} boundary yields without limit",
                                       first->kind == SideKind::viscous ? "viscous" : "free-field"),
                           "add settle = true to [gravity]: the boundary then carries its reactions in equilibrium");
}

/// The ground and the columns beside it stand on something that holds or moves them.
void check_base_of_sides(const CheckContext& context, const MpsCase& mps) {
  const auto list = context.entries_of("boundaries");
  const auto is_side = [](const SideBoundary& one) { return one.kind == SideKind::free_field; };
  const auto is_base = [&](const SideBoundary& one) {
    return !is_side(one) && (one.side == Side::bottom || one.side == Side::all || !one.region.empty());
  };
  const auto first = std::ranges::find_if(mps.boundaries, is_side);
  if (first == mps.boundaries.end() || std::ranges::any_of(mps.boundaries, is_base)) return;
  const Entry& entry = list[static_cast<std::size_t>(first - mps.boundaries.begin())];
  if (!entry.gives("side")) return;
  context.problems.error(entry.place("side"),
                         "free-field sides require a base: nothing holds or moves the ground and the columns beside it",
                         "add a boundary of side \"bottom\", of kind viscous, prescribed or fixed");
}

/// A column of layers stands beside the side; what it cannot see of the particles, the model refuses.
void check_free_field(const CheckContext& context, const Entry& entry, const MpsCase& mps, const SideBoundary& boundary) {
  check_keys(context, entry, "kind free_field", {}, {"extent", "region", "axes"});
  const auto is_free = [&](Side side) {
    return std::ranges::any_of(mps.boundaries,
                               [&](const SideBoundary& one) { return one.kind == SideKind::free_field && one.side == side; });
  };
  const bool across_x = boundary.side == Side::left || boundary.side == Side::right;
  if (!across_x && boundary.side != Side::front && boundary.side != Side::back) {
    context.problems.error(entry.place("side"), fmt::format("no column can stand beside side \"{}\"", word(boundary.side)),
                           "kind free_field is for left, right, front and back");
    return;
  }
  const auto same = [&](const SideBoundary& one) { return one.kind == SideKind::free_field && one.side == boundary.side; };
  if (&*std::ranges::find_if(mps.boundaries, same) != &boundary)
    context.problems.error(entry.place("side"), fmt::format("side \"{}\" has two columns", word(boundary.side)), "give it one");
  const std::size_t axis = across_x ? 0 : 1, along = 1 - axis;
  if (mps.particles.periodic[axis])
    context.problems.error(entry.place("side"), fmt::format("the body is periodic along {} and has no side there", "xyz"[axis]),
                           "remove the axis from periodic in [particles]");
  const bool both = across_x ? is_free(Side::front) && is_free(Side::back) : is_free(Side::left) && is_free(Side::right);
  if (mps.particles.dimension == 3 && !mps.particles.periodic[along] && !both)
    context.problems.error(entry.place("side"), fmt::format("the layers of a column do not end along {}", "xyz"[along]),
                           fmt::format("make the body periodic along {}, or both of its sides there free_field", "xyz"[along]));
}

void check_boundaries(const CheckContext& context, const MpsCase& mps) {
  std::vector<std::string> names;
  for (const Motion& motion : mps.motions) names.push_back(motion.name);
  const auto list = context.entries_of("boundaries");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    const SideBoundary& boundary = mps.boundaries[i];
    if (!entry.gives("side") || !entry.gives("kind")) continue;
    const bool moves = boundary.kind == SideKind::prescribed || boundary.kind == SideKind::viscous;
    check_keys(context, entry, "kind " + word(boundary.kind), {},
               moves ? std::vector<std::string_view>{"axes"} : std::vector<std::string_view>(motion_name_keys.begin(), motion_name_keys.end()));
    if (mps.particles.dimension == 2 &&
        (boundary.side == Side::front || boundary.side == Side::back || !boundary.motion[2].empty()))
      context.problems.error(entry.place("side"), "there is no front, back or motion_z in 2-D",
                             "set dimension = 3 in [particles]");
    const auto& held = boundary.axes;
    if (boundary.side == Side::all && (boundary.kind != SideKind::roller || !(held[0] || held[1] || held[2])))
      context.problems.error(entry.place("side"), "side \"all\" requires kind roller with axes",
                             "add axes = [\"y\"], for example");
    if (boundary.kind == SideKind::free_field) check_free_field(context, entry, mps, boundary);
    check_motion_names(context, entry, boundary.motion, names);
    std::vector<std::string> regions;
    for (const ParticleRegion& region : mps.regions) regions.push_back(region.name);
    if (!boundary.region.empty() && std::ranges::find(regions, boundary.region) == regions.end())
      context.problems.error(entry.place("region"), fmt::format("there is no region \"{}\"", boundary.region),
                             full_suggestion(boundary.region, regions, "regions"));
  }
  check_base_of_sides(context, mps);
}

}  // namespace

void check_mps(const CheckContext& context, MpsCase& mps) {
  check_unique(context, "regions", mps.regions);
  check_unique(context, "materials", mps.materials);
  check_unique(context, "motions", mps.motions);
  check_unique(context, "gauges", mps.gauges);
  const Entry particles = context.entries_of("particles").front();
  if (mps.particles.dimension == 3 && mps.particles.rotation == RotationRemoval::mean_angle)
    context.problems.error(particles.place("rotation"), "rotation \"mean_angle\" is for 2-D", "in 3-D use \"mean_rotation\"");
  if (mps.particles.rotation == RotationRemoval::mean_angle &&
      std::ranges::any_of(mps.materials, [](const Ground& ground) { return ground.fails(); }))
    context.problems.error(particles.place("rotation"), "rotation \"mean_angle\" is for elastic ground",
                           "with a cohesion or a backbone use \"mean_rotation\"");
  if (mps.particles.rotation_torque == RotationTorque::whole &&
      std::ranges::any_of(mps.materials, [](const Ground& ground) { return ground.fails(); }))
    context.problems.error(particles.place("rotation_torque"), "rotation_torque \"whole\" is for elastic ground",
                           "with a cohesion or a backbone use \"half\"");
  if (const Entry time = context.entries_of("time").front();
      time.has("euler_damping") && time.is_sound("integrator") && mps.time.integrator != Integrator::euler)
    context.problems.error(time.place("euler_damping"), "euler_damping is for integrator euler", "remove it");
  check_regions(context, mps);
  check_materials(context, mps);
  check_strengths(context, mps);
  std::vector<Real> ratios;
  for (const Ground& ground : mps.materials) ratios.push_back(ground.damping_ratio);
  check_damping(context, mps.damping, ratios);
  check_motions(context, mps.motions, mps.time.end);
  check_boundaries(context, mps);
  check_gravity(context, mps);
  const auto gauges = context.entries_of("gauges");
  for (std::size_t i = 0; i < gauges.size(); ++i)
    if (gauges[i].exists()) check_flat(context, gauges[i], "point", mps.gauges[i].point, mps.particles.dimension);
}

}  // namespace sazare::cases
