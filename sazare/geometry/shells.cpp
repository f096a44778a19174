#include "sazare/geometry/shells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "sazare/geometry/triangle_tree.hpp"

namespace sazare::geometry {

namespace {

constexpr Real rounding = 1e-6;  // of the surface's size: numbers of files are floats, so shells that touch do so within it
constexpr Real sample_depth =
    1e-5;  // of the surface's size: how far beside a triangle it is asked how often the surface goes around
constexpr std::size_t most_angles = 4'000'000;  // of one shell seen from triangles of another

struct Shell {
  std::vector<std::size_t> triangles;
  TriangleBox box;
  Real volume = 0;
};

struct LessByPlace {
  bool operator()(const Vector3& a, const Vector3& b) const { return std::ranges::lexicographical_compare(a, b); }
};

/// For every triangle the number of the first triangle of its shell: those that share a corner hang together.
std::vector<std::size_t> first_of_shell(std::span<const Triangle> surface) {
  std::vector<std::size_t> parent(surface.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  struct Edge {
    Vector3 from, to;
    bool operator<(const Edge& other) const {
      const LessByPlace less;
      return less(from, other.from) || (from == other.from && less(to, other.to));
    }
  };
  std::map<Edge, std::size_t> seen;
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (std::size_t n = 0; n < 3; ++n) {
      Edge edge{surface[i][n], surface[i][(n + 1) % 3]};
      if (LessByPlace{}(edge.to, edge.from)) std::swap(edge.from, edge.to);
      const auto [other, is_new] = seen.try_emplace(edge, i);
      if (is_new) continue;
      const std::size_t a = root(i), b = root(other->second);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
  return parent;
}

std::vector<Shell> shells_of(std::span<const Triangle> surface) {
  const std::vector<std::size_t> first = first_of_shell(surface);
  std::map<std::size_t, Shell> by_first;
  const Vector3 origin = surface.front().front();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const TriangleBox box = box_of(surface[i]);
    const auto [found, is_new] = by_first.try_emplace(first[i], Shell{{}, box, 0});
    Shell& shell = found->second;
    shell.box.lower = shell.box.lower.cwiseMin(box.lower);
    shell.box.upper = shell.box.upper.cwiseMax(box.upper);
    shell.triangles.push_back(i);
    const Vector3 a = surface[i][0] - origin, b = surface[i][1] - origin, c = surface[i][2] - origin;
    shell.volume += a.dot(b.cross(c)) / 6;
  }
  std::vector<Shell> shells;
  for (auto& [number, shell] : by_first) shells.push_back(std::move(shell));
  return shells;
}

/// Whether an edge goes through the face of a triangle, and not only touches it.
bool crosses(const Triangle& face, const Vector3& from, const Vector3& to, Real margin) {
  const Vector3 normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
  const Real before = normal.dot(from - face[0]), after = normal.dot(to - face[0]);
  if (!(std::min(before, after) < -margin && std::max(before, after) > margin)) return false;
  const Vector3 place = from + before / (before - after) * (to - from);
  for (std::size_t n = 0; n < 3; ++n) {
    const Vector3 side = face[(n + 1) % 3] - face[n];
    if (!(normal.dot(side.cross(place - face[n])) > margin * side.norm())) return false;
  }
  return true;
}

std::optional<ShellFault> find_crossing(std::span<const Triangle> surface, Real margin) {
  const TriangleTree tree(surface, 0);
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (const std::int32_t number : tree.meeting(box_of(surface[i]))) {
      const auto other = static_cast<std::size_t>(number);
      if (other == i) continue;
      for (std::size_t n = 0; n < 3; ++n)
        if (crosses(surface[other], surface[i][n], surface[i][(n + 1) % 3], margin))
          return ShellFault{ShellFault::Kind::crossing, i, other};
    }
  return {};
}

/// Solid angle of a triangle seen from a place, positive from behind; van Oosterom and Strackee (1983).
Real solid_angle(const Triangle& triangle, const Vector3& place) {
  const Vector3 a = triangle[0] - place, b = triangle[1] - place, c = triangle[2] - place;
  const Real la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
}

/// How often a shell goes around a place.
int turns_around(std::span<const Triangle> surface, const Shell& shell, const Vector3& place) {
  if (!shell.box.meets({place, place})) return 0;
  Real angle = 0;
  for (const std::size_t i : shell.triangles) angle += solid_angle(surface[i], place);
  return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

/// Looks on both sides of triangles of a shell how often all shells go around the place there: 0 or 1 times.
std::optional<ShellFault> find_wrong_turn(std::span<const Triangle> surface, std::span<const Shell> shells, const Shell& shell,
                                          int outward, Real depth) {
  std::vector<const Shell*> others;
  std::size_t angles = 0;
  for (const Shell& other : shells)
    if (&other != &shell && other.box.meets(shell.box)) {
      others.push_back(&other);
      angles += other.triangles.size();
    }
  const int own = outward * (shell.volume < 0 ? -1 : 1);
  const std::size_t stride = 1 + angles * shell.triangles.size() / most_angles;
  for (std::size_t n = 0; n < shell.triangles.size(); n += stride) {
    const std::size_t number = shell.triangles[n];
    const Triangle& triangle = surface[number];
    const Vector3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3, normal = area_vector(triangle).normalized();
    for (const int side : {-1, 1}) {
      const bool is_behind = (side < 0) == (shell.volume > 0);  // within the shell
      const Vector3 place = middle + side * depth * normal;
      int turns = is_behind ? own : 0;
      for (const Shell* other : others) turns += outward * turns_around(surface, *other, place);
      if (turns > 1) return ShellFault{ShellFault::Kind::doubled, number, number};
      if (turns < 0) return ShellFault{ShellFault::Kind::inside_out, number, number};
    }
  }
  return {};
}

}  // namespace

std::optional<ShellFault> find_shell_fault(std::span<const Triangle> surface) {
  const std::vector<Shell> shells = shells_of(surface);
  TriangleBox all = shells.front().box;
  for (const Shell& shell : shells) {
    all.lower = all.lower.cwiseMin(shell.box.lower);
    all.upper = all.upper.cwiseMax(shell.box.upper);
  }
  const Real size = (all.upper - all.lower).norm();
  if (const auto crossing = find_crossing(surface, rounding * size)) return crossing;
  if (shells.size() == 1) return {};
  const Shell& largest = *std::ranges::max_element(shells, {}, [](const Shell& shell) { return std::abs(shell.volume); });
  for (const Shell& shell : shells)
    if (const auto fault = find_wrong_turn(surface, shells, shell, largest.volume < 0 ? -1 : 1, sample_depth * size))
      return fault;
  return {};
}

}  // namespace sazare::geometry
