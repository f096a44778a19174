#include "sazare/geometry/face_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "sazare/core/error.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {
namespace {

using Triple = std::array<std::int32_t, 3>;

/// A face as one element has it, under the node numbers in increasing order. `side` = 4 element + local face.
struct HalfFace {
  std::int32_t middle_node;
  std::int32_t largest_node;
  std::int64_t side;
};

constexpr std::int64_t no_side = -1;

Triple nodes_of_side(const TetraMesh& mesh, std::int64_t side) {
  const auto& corners = mesh.tetrahedra[static_cast<std::size_t>(side / 4)];
  const auto& [a, b, c] = tetrahedron_faces[static_cast<std::size_t>(side % 4)];
  return {corners[static_cast<std::size_t>(a)], corners[static_cast<std::size_t>(b)], corners[static_cast<std::size_t>(c)]};
}

Triple sorted(Triple nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// All half faces, in buckets of their smallest node: bucket n is [start[n], start[n + 1]).
struct Buckets {
  std::vector<HalfFace> half_faces;
  std::vector<std::int64_t> start;
};

Buckets fill_buckets(const TetraMesh& mesh) {
  const auto sides = static_cast<std::int64_t>(4 * mesh.tetrahedra.size());
  Buckets buckets;
  buckets.start.assign(mesh.nodes.size() + 1, 0);
  for (std::int64_t side = 0; side < sides; ++side) {
    ++buckets.start[static_cast<std::size_t>(sorted(nodes_of_side(mesh, side))[0]) + 1];
  }
  for (std::size_t node = 1; node < buckets.start.size(); ++node) buckets.start[node] += buckets.start[node - 1];
  buckets.half_faces.resize(static_cast<std::size_t>(sides));
  std::vector<std::int64_t> next(buckets.start.begin(), buckets.start.end() - 1);
  for (std::int64_t side = 0; side < sides; ++side) {
    const Triple nodes = sorted(nodes_of_side(mesh, side));
    const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(nodes[0])]++);
    buckets.half_faces[place] = {nodes[1], nodes[2], side};
  }
  return buckets;
}

[[noreturn]] void refuse_third_element(const TetraMesh& mesh, std::int64_t a, std::int64_t b, std::int64_t c) {
  const auto tag = [&](std::int64_t side) { return element_tag(mesh, static_cast<std::int32_t>(side / 4)); };
  throw UserError(
      fmt::format("elements {}, {} and {} share one face: elements overlap or occur twice in the mesh. Let "
                  "volumes that touch "
                  "share their faces (BooleanFragments, Coherence) and mesh again",
                  tag(a), tag(b), tag(c)));
}

/// For each side the side of the other element there, or no_side.
std::vector<std::int64_t> match_sides(const TetraMesh& mesh) {
  Buckets buckets = fill_buckets(mesh);
  std::vector<std::int64_t> partner(buckets.half_faces.size(), no_side);
  const auto order = [](const HalfFace& a, const HalfFace& b) {
    return std::tie(a.middle_node, a.largest_node, a.side) < std::tie(b.middle_node, b.largest_node, b.side);
  };
  const auto same = [](const HalfFace& a, const HalfFace& b) {
    return a.middle_node == b.middle_node && a.largest_node == b.largest_node;
  };
  for (std::size_t node = 0; node + 1 < buckets.start.size(); ++node) {
    const auto begin = buckets.half_faces.begin() + buckets.start[node];
    const auto end = buckets.half_faces.begin() + buckets.start[node + 1];
    std::sort(begin, end, order);
    for (auto half = begin; end - half >= 2; ++half) {
      if (!same(half[0], half[1])) continue;
      if (end - half >= 3 && same(half[0], half[2])) {
        refuse_third_element(mesh, half[0].side, half[1].side, half[2].side);
      }
      partner[static_cast<std::size_t>(half[0].side)] = half[1].side;
      partner[static_cast<std::size_t>(half[1].side)] = half[0].side;
    }
  }
  return partner;
}

struct TripleHash {
  std::size_t operator()(const Triple& nodes) const {
    std::uint64_t hash = 0;
    for (const std::int32_t node : nodes) {
      hash = (hash ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Where a triangle is: an index into the interior or into the outer faces; at most one of them is set.
struct FacePlace {
  std::int32_t interior = -1;
  std::int32_t outer = -1;
};

using FacePlaces = std::unordered_map<Triple, FacePlace, TripleHash>;

FacePlaces locate_triangles(const TetraMesh& mesh, const FaceMap& faces) {
  FacePlaces places;
  for (const auto& surface : mesh.surfaces) {
    for (const Triple& triangle : surface.triangles) places.emplace(sorted(triangle), FacePlace{});
  }
  if (places.empty()) return places;
  for (std::size_t i = 0; i < faces.interior.size(); ++i) {
    const auto found = places.find(sorted(faces.interior[i].nodes));
    if (found != places.end()) found->second.interior = static_cast<std::int32_t>(i);
  }
  for (std::size_t i = 0; i < faces.outer.size(); ++i) {
    const auto found = places.find(sorted(faces.outer[i].nodes));
    if (found != places.end()) found->second.outer = static_cast<std::int32_t>(i);
  }
  return places;
}

[[noreturn]] void refuse_stray_triangle(const TetraMesh& mesh, const std::string& name, const Triple& triangle) {
  const Vector3 center = (mesh.nodes[static_cast<std::size_t>(triangle[0])] + mesh.nodes[static_cast<std::size_t>(triangle[1])] +
                          mesh.nodes[static_cast<std::size_t>(triangle[2])]) /
                         3;
  throw UserError(
      fmt::format("a triangle of the surface group '{}', with its centre at ({:g}, {:g}, {:g}), is not a face of any "
                  "tetrahedron: the surface does not bound a meshed volume and is not embedded in one. Make it part of a volume "
                  "(Surface{{..}} In Volume{{..}}, BooleanFragments), or take it out of the group",
                  name, center.x(), center.y(), center.z()));
}

void sort_unique(std::vector<std::int32_t>& indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

}  // namespace

FaceMap build_face_map(const TetraMesh& mesh) {
  const std::vector<std::int64_t> partner = match_sides(mesh);
  FaceMap faces;
  for (std::size_t index = 0; index < partner.size(); ++index) {
    const auto side = static_cast<std::int64_t>(index);
    const std::int64_t other = partner[index];
    const auto element = static_cast<std::int32_t>(side / 4);
    const auto face = static_cast<std::int32_t>(side % 4);
    if (other == no_side) {
      faces.outer.push_back({element, face, nodes_of_side(mesh, side)});
    } else if (side < other) {
      faces.interior.push_back(
          {element, static_cast<std::int32_t>(other / 4), face, static_cast<std::int32_t>(other % 4), nodes_of_side(mesh, side)});
    }
  }
  return faces;
}

std::vector<SurfaceFaces> find_surface_faces(const TetraMesh& mesh, const FaceMap& faces) {
  const FacePlaces places = locate_triangles(mesh, faces);
  std::vector<SurfaceFaces> result;
  for (const auto& surface : mesh.surfaces) {
    SurfaceFaces& found = result.emplace_back();
    for (const Triple& triangle : surface.triangles) {
      const FacePlace place = places.at(sorted(triangle));
      if (place.interior < 0 && place.outer < 0) refuse_stray_triangle(mesh, surface.name, triangle);
      if (place.interior >= 0) found.interior.push_back(place.interior);
      if (place.outer >= 0) found.outer.push_back(place.outer);
    }
    sort_unique(found.interior);
    sort_unique(found.outer);
  }
  return result;
}

}  // namespace sazare::geometry
