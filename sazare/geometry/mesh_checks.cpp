#include "sazare/geometry/mesh_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "sazare/core/error.hpp"
#include "sazare/geometry/place_cells.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {
namespace {

constexpr std::size_t listed_at_most = 10;

/// An element is degenerate below this share of its longest edge cubed (a regular tetrahedron has 0.118).
constexpr Real least_volume_share = 1e-9;

Real longest_edge(const Tetrahedron& corners) {
  Real longest = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) longest = std::max(longest, (corners[a] - corners[b]).norm());
  }
  return longest;
}

/// "12 (volume -0.5 m3), 13 (volume ...), ... and 3 more".
std::string list(const std::vector<std::string>& items) {
  const std::size_t shown = std::min(items.size(), listed_at_most);
  std::string text = fmt::format("{}", fmt::join(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return shown < items.size() ? fmt::format("{} and {} more", text, items.size() - shown) : text;
}

std::string elements(std::size_t count) { return count == 1 ? "1 element" : fmt::format("{} elements", count); }

void check_volumes(const TetraMesh& mesh) {
  std::vector<std::string> inverted;
  std::vector<std::string> degenerate;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    const Tetrahedron corners = corners_of(mesh, element);
    const Real size = volume(corners);
    const Real edge = longest_edge(corners);
    const Real least = least_volume_share * edge * edge * edge;
    if (size > least && std::isfinite(size)) continue;
    auto& bad = size < -least ? inverted : degenerate;
    bad.push_back(fmt::format("{} (volume {:g} m3)", element_tag(mesh, element), size));
  }
  if (!inverted.empty()) {
    throw UserError(
        fmt::format("{} inverted, with a negative volume: {}. Reverse the node order, or mesh again (gmsh Plugin "
                    "AnalyseMeshQuality shows them)",
                    elements(inverted.size()), list(inverted)));
  }
  if (!degenerate.empty()) {
    throw UserError(
        fmt::format("{} degenerate, with almost no volume: {}. Mesh again with another size or "
                    "Mesh.Optimize = 1",
                    elements(degenerate.size()), list(degenerate)));
  }
}

/// Two elements on one side of the face they share: seen from each, the face must turn the other way round.
void check_overlaps(const TetraMesh& mesh, const FaceMap& faces) {
  std::vector<std::string> overlapping;
  for (const InteriorFace& face : faces.interior) {
    const Tetrahedron other = corners_of(mesh, face.element_j);
    const Vector3 outward_j = face_area_vector(other, face.face_j);
    const Vector3 outward_i = face_area_vector(corners_of(mesh, face.element_i), face.face_i);
    if (outward_i.dot(outward_j) < 0) continue;
    overlapping.push_back(fmt::format("{} and {}", element_tag(mesh, face.element_i), element_tag(mesh, face.element_j)));
  }
  if (overlapping.empty()) return;
  throw UserError(fmt::format("{} of elements lie on the same side of the face they share, so they overlap: {}. Mesh again",
                              overlapping.size() == 1 ? "1 pair" : fmt::format("{} pairs", overlapping.size()),
                              list(overlapping)));
}

/// For each outer face whether a named surface group holds it.
std::vector<char> faces_with_name(const TetraMesh& mesh, const FaceMap& faces) {
  std::vector<char> named(faces.outer.size(), 0);
  for (const SurfaceFaces& surface : find_surface_faces(mesh, faces)) {
    for (const std::int32_t face : surface.outer) named[static_cast<std::size_t>(face)] = 1;
  }
  return named;
}

void check_interfaces(const TetraMesh& mesh, const FaceMap& faces) {
  const std::vector<char> named = faces_with_name(mesh, faces);
  std::set<std::pair<std::int64_t, std::int64_t>> pairs;
  for (const auto& [a, b] : find_touching_outer_faces(mesh, faces)) {
    if (named[static_cast<std::size_t>(a)] != 0 && named[static_cast<std::size_t>(b)] != 0) continue;
    const auto tag = [&](std::int32_t face) { return element_tag(mesh, faces.outer[static_cast<std::size_t>(face)].element); };
    pairs.emplace(std::min(tag(a), tag(b)), std::max(tag(a), tag(b)));
  }
  if (pairs.empty()) return;
  std::vector<std::string> names;
  for (const auto& [a, b] : pairs) names.push_back(fmt::format("{} and {}", a, b));
  throw UserError(
      fmt::format("{} of elements touch along a face without sharing its nodes (the interface does not "
                  "conform), so no joint can "
                  "hold them: {}. Let the volumes share the surface (BooleanFragments, or Coherence and "
                  "Coherence Mesh) and mesh "
                  "again; where a gap is intended, put the surfaces of both sides into physical surface groups "
                  "(a crack inside one "
                  "volume needs no double nodes: its joint is bonded = false)",
                  names.size() == 1 ? "1 pair" : fmt::format("{} pairs", names.size()), list(names)));
}

constexpr Real same_place = 1e-4;  // of the shortest distance of two nodes of an element

/// For every node the shortest distance to another one of its elements [m]; -1 for a node of no element, which is nobody's double.
std::vector<Real> shortest_distances(const ElementMesh& mesh) {
  std::vector<Real> shortest(mesh.nodes.size(), std::numeric_limits<Real>::infinity());
  for (const MeshElement& element : mesh.elements) {
    const auto nodes = element.node_list();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = a + 1; b < nodes.size(); ++b) {
        const auto i = static_cast<std::size_t>(nodes[a]), j = static_cast<std::size_t>(nodes[b]);
        const Real distance = (mesh.nodes[i] - mesh.nodes[j]).norm();
        shortest[i] = std::min(shortest[i], distance);
        shortest[j] = std::min(shortest[j], distance);
      }
  }
  std::ranges::replace(shortest, std::numeric_limits<Real>::infinity(), -1);
  return shortest;
}

void check_double_nodes(const ElementMesh& mesh) {
  const std::vector<Real> shortest = shortest_distances(mesh);
  PlaceCells cells(same_place * *std::ranges::max_element(shortest));
  std::vector<std::string> pairs;
  for (std::size_t one = 0; one < mesh.nodes.size(); ++one) {
    cells.visit_near(mesh.nodes[one], [&](Index number) {
      const auto other = static_cast<std::size_t>(number);
      if ((mesh.nodes[other] - mesh.nodes[one]).norm() > same_place * std::min(shortest[one], shortest[other])) return;
      const auto [first, second] = std::minmax(mesh.node_tags[one], mesh.node_tags[other]);
      pairs.push_back(fmt::format("{} and {}", first, second));
    });
    cells.add(static_cast<Index>(one), mesh.nodes[one]);
  }
  if (pairs.empty()) return;
  throw UserError(fmt::format(
      "$Nodes: {} of nodes stand in one place: {}. The parts of the body on their two sides would not hold together: let them "
      "share the nodes (BooleanFragments, or Coherence and Coherence Mesh) and mesh again; a joint or a crack between them is "
      "the "
      "physical group of an interface, named in [[joints]]",
      pairs.size() == 1 ? "1 pair" : fmt::format("{} pairs", pairs.size()), list(pairs)));
}

void check_double_elements(const ElementMesh& mesh) {
  std::map<std::vector<Index>, std::int64_t> seen;
  std::vector<std::string> pairs;
  for (const MeshElement& element : mesh.elements) {
    std::vector<Index> nodes(element.node_list().begin(), element.node_list().end());
    std::ranges::sort(nodes);
    const auto [other, is_new] = seen.try_emplace(std::move(nodes), element.tag);
    if (!is_new) pairs.push_back(fmt::format("{} and {}", other->second, element.tag));
  }
  if (pairs.empty()) return;
  throw UserError(
      fmt::format("$Elements: {} of elements have the same nodes, so their material would count twice: {}. Mesh again",
                  pairs.size() == 1 ? "1 pair" : fmt::format("{} pairs", pairs.size()), list(pairs)));
}

}  // namespace

void check_conforming(const ElementMesh& mesh) {
  check_double_nodes(mesh);
  check_double_elements(mesh);
}

void check_mesh(const TetraMesh& mesh) {
  check_volumes(mesh);
  const FaceMap faces = build_face_map(mesh);
  check_overlaps(mesh, faces);
  check_interfaces(mesh, faces);
}

}  // namespace sazare::geometry
