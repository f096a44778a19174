#include "sazare/runs/spheres_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/cases/number_text.hpp"
#include "sazare/geometry/surface_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/motion_of_case.hpp"
#include "sazare/runs/sphere_bonding.hpp"

namespace sazare::runs {

namespace {

using cases::ContactModel;
using cases::SpheresCase;
using methods::spheres::Wall;

constexpr Real wall_margin = 0.5;  // of the smallest diameter; near walls there are few spheres, so that more costs little

const cases::MaterialPair* find_pair(const SpheresCase& spheres, const std::string& one, const std::string& other) {
  for (const cases::MaterialPair& pair : spheres.pairs)
    if ((pair.between[0] == one && pair.between[1] == other) || (pair.between[0] == other && pair.between[1] == one))
      return &pair;
  return nullptr;
}

laws::ContactConstants<Real> constants_of(const SpheresCase& spheres, std::size_t one, std::size_t other) {
  const cases::GranularContact& contact = spheres.contact;
  const cases::SphereMaterial &a = spheres.materials[one], &b = spheres.materials[other];
  const cases::MaterialPair none, *found = find_pair(spheres, a.name, b.name);
  const cases::MaterialPair& pair = found == nullptr ? none : *found;
  const Real restitution = pair.restitution.value_or(contact.restitution),
             friction = pair.friction_coefficient.value_or(contact.friction_coefficient),
             rolling = pair.rolling_friction.value_or(contact.rolling_friction);
  if (contact.model == ContactModel::linear)
    return laws::linear_constants(pair.normal_stiffness.value_or(contact.normal_stiffness),
                                  pair.shear_stiffness.value_or(contact.shear_stiffness), restitution, friction, rolling);
  return laws::hertz_constants({a.youngs_modulus, a.poisson_ratio}, {b.youngs_modulus, b.poisson_ratio}, restitution, friction,
                               rolling);
}

Wall plane(const cases::WallRules& rules, const Vector3& point, const Vector3& normal) {
  Wall wall;
  wall.name = rules.name;
  wall.point = point;
  wall.normal = normal.normalized();
  return wall;
}

/// The walls of one entry of a case: six for a box.
std::vector<Wall> walls_of(const cases::WallRules& rules) {
  std::vector<Wall> walls;
  if (rules.shape == cases::WallShape::plane) walls.push_back(plane(rules, rules.point, rules.normal));
  if (rules.shape == cases::WallShape::box)
    for (int axis = 0; axis < 3; ++axis) {
      walls.push_back(plane(rules, rules.lower, Vector3::Unit(axis)));
      walls.push_back(plane(rules, rules.upper, -Vector3::Unit(axis)));
    }
  if (rules.shape == cases::WallShape::mesh) {
    walls.emplace_back().name = rules.name;
    walls.back().triangles = geometry::read_surface(rules.file, rules.group, rules.scale);
  }
  return walls;
}

void add_walls(const SpheresCase& spheres, SpheresModel& model, std::vector<Wall>& walls) {
  for (std::size_t i = 0; i < spheres.walls.size(); ++i) {
    const cases::WallRules& rules = spheres.walls[i];
    const auto material = std::ranges::find(spheres.materials, rules.material, &cases::SphereMaterial::name);
    for (Wall& wall : walls_of(rules)) {
      wall.material = static_cast<Index>(material - spheres.materials.begin());
      wall.motion.pivot = rules.pivot;
      wall.motion.spin = rules.spin;
      for (int axis = 0; axis < 3; ++axis)
        for (const cases::Motion& motion : spheres.motions)
          if (!motion.name.empty() && motion.name == rules.motion[static_cast<std::size_t>(axis)])
            wall.motion.histories.emplace_back(axis, motion_of_case(motion));
      walls.push_back(std::move(wall));
      model.case_wall.push_back(static_cast<Index>(i));
    }
  }
}

std::uint64_t hash_of(const Placement& placement, const std::vector<Wall>& walls) {
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(placement.bonded)));
  hash.add(std::as_bytes(std::span(placement.spheres.place)));
  hash.add(std::as_bytes(std::span(placement.group)));
  for (const Wall& wall : walls) hash.add(std::as_bytes(std::span(wall.triangles)));
  return hash.value();
}

/// How far a sphere reaches through a wall, over its radius; below 0 where it does not.
Real share_within(const Wall& wall, const geometry::TriangleGrid& grid, const Vector3& centre, Real radius) {
  if (wall.is_plane()) return 1 - (centre - wall.point).dot(wall.normal) / radius;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const std::int32_t t : grid.near(centre))
    nearest = std::min(nearest, (geometry::nearest_point(wall.triangles[static_cast<std::size_t>(t)], centre) - centre).norm());
  return 1 - nearest / radius;
}

/// The first of them, with their groups and places.
std::string some_of(std::span<const std::size_t> which, const SpheresCase& spheres, const Placement& placement) {
  constexpr std::size_t most = 3;
  std::string text;
  for (const std::size_t i : which.first(std::min(most, which.size()))) {
    const auto& place = placement.spheres.place[i];
    text += fmt::format("{}sphere {} of \"{}\" at ({}, {}, {})", text.empty() ? "" : ", ", i + 1,
                        spheres.spheres[static_cast<std::size_t>(placement.group[i])].name, cases::short_number(place.x, 4),
                        cases::short_number(place.y, 4), cases::short_number(place.z, 4));
  }
  return which.size() > most ? text + ", and others" : text;
}

/// Spheres that begin beyond a wall by more than contact.overlap_limit are refused.
void check_walls(const cases::CaseFile& file, const SpheresModel& model, const std::vector<Wall>& walls,
                 const Placement& placement) {
  const SpheresCase& spheres = file.spheres();
  const state::Spheres& placed = placement.spheres;
  Real largest = 0;
  for (const auto& place : placed.place) largest = std::max(largest, place.radius);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].nodal.exists()) continue;
    const geometry::TriangleGrid grid(walls[w].triangles, largest);
    std::vector<std::size_t> beyond;
    Real deepest = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const Real share = share_within(walls[w], grid, placed.box.wrapped(placed.place[i].centre()), placed.place[i].radius);
      if (share > spheres.contact.overlap_limit) beyond.push_back(i);
      deepest = std::max(deepest, share);
    }
    if (beyond.empty()) continue;
    refuse(file, fmt::format("walls.{}", model.case_wall[w]),
           fmt::format("{} spheres begin within the wall \"{}\", by {} of their radius or less: {}", beyond.size(), walls[w].name,
                       cases::short_number(deepest, 3), some_of(beyond, spheres, placement)),
           walls[w].is_plane()
               ? "the normal of a plane points into the room for spheres; overlap_limit in [contact] says how much is allowed"
               : "a sphere's surface must not reach through the mesh; overlap_limit in [contact] says how much is allowed");
  }
}

/// A base step of finer levels goes farther and costs less, so that searches weigh more: by the root of both the margin that is
/// best grows.
Real margin_growth(const SphereSteps& steps) {
  constexpr Real most = 4;
  return steps.level.empty() ? 1 : std::min(most, std::sqrt(steps.step / steps.smallest()));
}

}  // namespace

methods::spheres::ContactTable contact_table(const SpheresCase& spheres) {
  const auto model = spheres.contact.model == ContactModel::hertz ? laws::ContactModel::hertz : laws::ContactModel::linear;
  methods::spheres::ContactTable table(model, static_cast<Index>(spheres.materials.size()));
  for (std::size_t a = 0; a < spheres.materials.size(); ++a)
    for (std::size_t b = a; b < spheres.materials.size(); ++b)
      table.set(static_cast<Index>(a), static_cast<Index>(b), constants_of(spheres, a, b));
  return table;
}

SpheresModel build_spheres(const cases::CaseFile& file, std::optional<Real> window) {
  const SpheresCase& spheres = file.spheres();
  SpheresModel model;
  Placement placement = place_spheres(file);
  std::vector<Wall> walls;
  add_walls(spheres, model, walls);
  check_walls(file, model, walls, placement);
  const methods::spheres::ContactTable table = contact_table(spheres);
  methods::spheres::Bonds bonds = bond_spheres(file, placement);
  model.clumps = static_cast<std::int64_t>(placement.clumps.clumps.size());
  model.bonds = static_cast<std::int64_t>(bonds.bonds().size());
  model.steps = choose_steps(file, placement, {table, bonds}, window);
  model.start = hash_of(placement, walls);
  methods::spheres::BondedBodies bodies;
  if (placement.bonded_bodies > 0) {
    bodies = methods::spheres::BondedBodies(std::move(placement.bonded_body), bonds);
    for (const auto& place : placement.spheres.place) model.placed.push_back(place.centre());
    for (const cases::SphereMaterial& material : spheres.materials) model.density.push_back(material.density);
  }
  model.share_error = placement.share_error;
  model.group = std::move(placement.group);
  model.body = std::move(placement.body);
  const Real margin = margin_growth(model.steps) * search_margin(spheres, placement.spheres);
  const engine::SphereRules rules{model.steps.step, spheres.gravity.acceleration, margin,
                                  wall_margin / spheres.contact.margin * margin, model.steps.level};
  model.stepper = std::make_unique<engine::SphereStepper>(std::move(placement.spheres), table, std::move(walls), rules,
                                                          std::move(bonds), std::move(placement.clumps), std::move(bodies));
  return model;
}

}  // namespace sazare::runs
