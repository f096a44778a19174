#include "sazare/methods/spheres/run/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/motion_of_case.hpp"
#include "sazare/geometry/closed_surface.hpp"
#include "sazare/geometry/surface_file.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/wall_images.hpp"

namespace sazare::runs {

namespace {

using cases::SpheresCase;
using methods::spheres::Wall;

Real largest_radius(const state::Spheres& placed) {
  Real largest = 0;
  for (const auto& place : placed.place) largest = std::max(largest, place.radius);
  return largest;
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

bool move_alike(const cases::WallRules& one, const cases::WallRules& other) {
  const bool turn_alike = one.spin == other.spin && (one.spin.isZero(0) || one.pivot == other.pivot);
  return one.motion == other.motion && turn_alike;
}

/// The first entry of a case whose walls are one surface with those of another entry.
std::size_t joined_with(const std::vector<cases::WallRules>& walls, std::size_t entry) {
  for (std::size_t first = 0; first < entry; ++first)
    if (walls[first].material == walls[entry].material && move_alike(walls[first], walls[entry])) return first;
  return entry;
}

void add_walls(const SpheresCase& spheres, CaseWalls& made) {
  for (std::size_t i = 0; i < spheres.walls.size(); ++i) {
    const cases::WallRules& rules = spheres.walls[i];
    const auto material = std::ranges::find(spheres.materials, rules.material, &cases::SphereMaterial::name);
    for (Wall& wall : walls_of(rules)) {
      wall.material = static_cast<Index>(material - spheres.materials.begin());
      wall.motion.pivot = rules.pivot;
      wall.motion.spin = rules.spin;
      for (int axis = 0; axis < 3; ++axis)
        if (const auto motion = cases::motion_named(spheres.motions, rules.motion[static_cast<std::size_t>(axis)]))
          wall.motion.histories.emplace_back(axis, *motion);
      wall.joined = static_cast<Index>(joined_with(spheres.walls, i));
      made.walls.push_back(std::move(wall));
      made.entry.push_back(static_cast<Index>(i));
    }
  }
}

/// A surface may be open, as a plate is; it may also lack triangles.
void note_edges(const Wall& wall, std::vector<std::string>& notes) {
  const geometry::SurfaceEdges edges = geometry::edges_of(wall.triangles);
  if (edges.open > 0)
    notes.push_back(
        fmt::format("\"{}\" has {} open edges, of one triangle each: it ends there, or has holes", wall.name, edges.open));
}

/// A surface that ends at a periodic side, or before it, goes on in its images.
void repeat_walls(const cases::CaseFile& file, CaseWalls& made, const state::Spheres& placed) {
  const Real reach = largest_radius(placed);
  for (std::size_t w = 0; w < made.walls.size(); ++w) {
    Wall& wall = made.walls[w];
    std::array<methods::spheres::WallSides, 3> sides;
    for (int axis = 0; axis < 3; ++axis) {
      auto& of = sides[static_cast<std::size_t>(axis)] = methods::spheres::sides_of(wall, placed.box, axis, reach);
      if (of.can) continue;
      refuse(file, fmt::format("walls.{}.angular_velocity", made.entry[w]),
             fmt::format("the wall \"{}\" turns across the periodic axis {}, ends at its sides, and comes within {} m of them",
                         wall.name, "xyz"[axis], cases::short_number(reach, 4)),
             "it cannot continue periodically there: let it turn about that axis, keep it away from the sides, or let it reach "
             "beyond both");
    }
    const auto repeats = methods::spheres::repeat_wall(wall, placed.box, reach);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!repeats[axis]) continue;
      const Real gap = sides[axis].gap;
      made.notes.push_back(fmt::format("\"{}\" continues periodically along {}{}", wall.name, "xyz"[axis],
                                       gap > 1e-9 * placed.box.length[static_cast<int>(axis)]
                                           ? fmt::format(", with a gap of {} m", cases::short_number(gap, 4))
                                           : ""));
    }
  }
}

/// How far a sphere reaches through a wall, over its radius; below 0 where it does not.
Real share_within(const Wall& wall, const geometry::TriangleTree& tree, const Vector3& centre, Real radius) {
  if (wall.is_plane()) return 1 - (centre - wall.point).dot(wall.normal) / radius;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const std::int32_t t : tree.near(centre))
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
void check_walls(const cases::CaseFile& file, const CaseWalls& made, const Placement& placement) {
  const std::vector<Wall>& walls = made.walls;
  const SpheresCase& spheres = file.as<cases::SpheresCase>();
  const state::Spheres& placed = placement.spheres;
  const Real largest = largest_radius(placed);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].nodal.exists()) continue;
    const geometry::TriangleTree tree(walls[w].triangles, largest);
    std::vector<std::size_t> beyond;
    Real deepest = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const Real share = share_within(walls[w], tree, placed.box.wrapped(placed.place[i].centre()), placed.place[i].radius);
      if (share > spheres.contact.overlap_limit) beyond.push_back(i);
      deepest = std::max(deepest, share);
    }
    if (beyond.empty()) continue;
    refuse(file, fmt::format("walls.{}", made.entry[w]),
           fmt::format("{} spheres begin within the wall \"{}\", by {} of their radius or less: {}", beyond.size(), walls[w].name,
                       cases::short_number(deepest, 3), some_of(beyond, spheres, placement)),
           walls[w].is_plane()
               ? "the normal of a plane has to point towards the spheres; overlap_limit in [contact] says how much is allowed"
               : "a sphere's surface must not reach through the mesh; overlap_limit in [contact] says how much is allowed");
  }
}

}  // namespace

CaseWalls make_walls(const cases::CaseFile& file, const Placement& placement) {
  CaseWalls made;
  add_walls(file.as<cases::SpheresCase>(), made);
  for (const Wall& wall : made.walls)
    if (wall.is_surface()) note_edges(wall, made.notes);
  repeat_walls(file, made, placement.spheres);
  check_walls(file, made, placement);
  return made;
}

}  // namespace sazare::runs
