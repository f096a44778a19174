#include <algorithm>
#include <cmath>
#include <map>

#include "sazare/geometry/mesh_checks.hpp"
#include "sazare/geometry/place_cells.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {
namespace {

/// Lengths below this share of the smaller face's size count as none.
constexpr Real tolerance = 1e-6;

struct Face {
  std::array<Vector3, 3> corners;
  Vector3 center;  ///< of its bounding box
  Vector3 normal;
  Real size;  ///< longest side of its bounding box [m]
};

Face make_face(const TetraMesh& mesh, const OuterFace& outer) {
  const auto at = [&](std::size_t corner) { return mesh.nodes[static_cast<std::size_t>(outer.nodes[corner])]; };
  Face face;
  face.corners = {at(0), at(1), at(2)};
  const Vector3 low = at(0).cwiseMin(at(1)).cwiseMin(at(2));
  const Vector3 high = at(0).cwiseMax(at(1)).cwiseMax(at(2));
  face.center = (low + high) / 2;
  face.size = (high - low).maxCoeff();
  face.normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  return face;
}

/// Whether the triangles, in one plane, overlap by more than `least` in every direction across one of their
/// sides.
bool overlap_in_plane(const Face& a, const Face& b, Real least) {
  for (const Face* owner : {&a, &b}) {
    for (std::size_t side = 0; side < 3; ++side) {
      const Vector3 edge = owner->corners[(side + 1) % 3] - owner->corners[side];
      const Vector3 across = edge.cross(owner->normal).normalized();
      const auto range = [&](const Face& face) {
        const Vector3 at(face.corners[0].dot(across), face.corners[1].dot(across), face.corners[2].dot(across));
        return std::pair(at.minCoeff(), at.maxCoeff());
      };
      const auto [low_a, high_a] = range(a);
      const auto [low_b, high_b] = range(b);
      if (std::min(high_a, high_b) - std::max(low_a, low_b) <= least) return false;
    }
  }
  return true;
}

bool touch(const Face& a, const Face& b) {
  const Real least = tolerance * std::min(a.size, b.size);
  if (((a.center - b.center).cwiseAbs().array() > (a.size + b.size) / 2 + least).any()) return false;
  if (a.normal.dot(b.normal) > -1 + tolerance) return false;
  const auto in_plane = [&](const Vector3& corner) { return std::abs((corner - a.corners[0]).dot(a.normal)) <= least; };
  if (!std::all_of(b.corners.begin(), b.corners.end(), in_plane)) return false;
  return overlap_in_plane(a, b, least);
}

/// Faces by magnitude of their size (a power of two) and by the cell of their centre; cells are as long as the largest of a
/// magnitude. A face looks for its like and for larger ones only, so each search is short however much the sizes differ.
std::map<int, PlaceCells> make_grids(const std::vector<Face>& faces) {
  std::map<int, PlaceCells> grids;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int magnitude = std::ilogb(faces[i].size);
    PlaceCells& grid = grids.try_emplace(magnitude, std::ldexp(2 * (1 + tolerance), magnitude)).first->second;
    grid.add(static_cast<Index>(i), faces[i].center);
  }
  return grids;
}

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> find_touching_outer_faces(const TetraMesh& mesh, const FaceMap& map) {
  std::vector<Face> faces;
  faces.reserve(map.outer.size());
  for (const OuterFace& outer : map.outer) faces.push_back(make_face(mesh, outer));
  const std::map<int, PlaceCells> grids = make_grids(faces);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto own = static_cast<std::int32_t>(i);
    for (auto grid = grids.find(std::ilogb(faces[i].size)); grid != grids.end(); ++grid) {
      grid->second.visit_near(faces[i].center, [&](std::int32_t other) {
        if (other == own || !touch(faces[i], faces[static_cast<std::size_t>(other)])) return;
        pairs.emplace_back(std::min(own, other), std::max(own, other));
      });
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace sazare::geometry
