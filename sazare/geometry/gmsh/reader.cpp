#include "sazare/geometry/gmsh/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "sazare/core/error.hpp"
#include "sazare/geometry/gmsh/file.hpp"
#include "sazare/geometry/mesh_checks.hpp"

namespace sazare::geometry {
namespace {

constexpr int surface_dimension = 2;
constexpr int volume_dimension = 3;

/// Names of all groups of one dimension, in the order of their numbers, each with its place.
class GroupNames {
public:
  GroupNames(const GmshFile& file, int dimension) {
    for (const std::int32_t number : group_numbers(file, dimension)) {
      const std::string name = group_name(file, dimension, number);
      const auto [place, added] = places_.emplace(name, static_cast<std::int32_t>(names_.size()));
      if (added) names_.push_back(name);
      by_number_[number] = place->second;
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  std::int32_t place(std::int32_t number) const { return by_number_.at(number); }

private:
  std::vector<std::string> names_;
  std::map<std::string, std::int32_t> places_;
  std::map<std::int32_t, std::int32_t> by_number_;
};

const std::vector<std::int32_t>& groups_of(const GmshFile& file, int dimension, std::int32_t entity) {
  static const std::vector<std::int32_t> none;
  const auto found = file.physical_groups.find({dimension, entity});
  return found == file.physical_groups.end() ? none : found->second;
}

/// From the node numbers of the file to the nodes of the mesh; only nodes of tetrahedra are kept, in file
/// order.
class NodeMap {
public:
  NodeMap(const GmshFile& file, Real scale, TetraMesh& mesh) {
    std::unordered_map<std::int64_t, std::size_t> in_file;
    in_file.reserve(file.node_tags.size());
    for (std::size_t i = 0; i < file.node_tags.size(); ++i) {
      if (!in_file.emplace(file.node_tags[i], i).second) {
        throw UserError(fmt::format("$Nodes: node {} occurs twice. Write the file again", file.node_tags[i]));
      }
    }
    std::vector<char> used(file.nodes.size(), 0);
    for (std::size_t i = 0; i < file.tetrahedra.nodes.size(); ++i) {
      for (const std::int64_t tag : file.tetrahedra.nodes[i]) {
        const auto found = in_file.find(tag);
        if (found == in_file.end()) refuse_node(file.tetrahedra.tags[i], tag);
        used[found->second] = 1;
      }
    }
    places_.reserve(file.nodes.size());
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      if (used[i] == 0) continue;
      places_.emplace(file.node_tags[i], static_cast<std::int32_t>(mesh.nodes.size()));
      mesh.nodes.push_back(file.nodes[i] * scale);
    }
  }

  /// The index of a node of the mesh, -1 when no tetrahedron uses it.
  std::int32_t find(std::int64_t tag) const {
    const auto found = places_.find(tag);
    return found == places_.end() ? -1 : found->second;
  }

private:
  [[noreturn]] static void refuse_node(std::int64_t element, std::int64_t node) {
    throw UserError(
        fmt::format("$Elements: element {} names node {}, which is not in $Nodes. Write the file again", element, node));
  }

  std::unordered_map<std::int64_t, std::int32_t> places_;
};

[[noreturn]] void refuse_ungrouped(const GmshFile& file, std::int32_t volume) {
  const auto count = std::count(file.tetrahedra.entities.begin(), file.tetrahedra.entities.end(), volume);
  const auto first = std::find(file.tetrahedra.entities.begin(), file.tetrahedra.entities.end(), volume);
  const auto index = static_cast<std::size_t>(first - file.tetrahedra.entities.begin());
  throw UserError(
      fmt::format("$Elements: the {} tetrahedra of volume {} (the first is element {}) are in no physical "
                  "group, so they have no "
                  "material. Add to the geometry: Physical Volume(\"NAME\") = {{{}}};",
                  count, volume, file.tetrahedra.tags[index], volume));
}

/// The region of a volume, -1 for a volume in no group.
std::int32_t region_of(const GmshFile& file, const GroupNames& groups, std::int32_t volume) {
  std::vector<std::int32_t> regions;
  for (const std::int32_t number : groups_of(file, volume_dimension, volume)) regions.push_back(groups.place(number));
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  if (regions.size() > 1) {
    std::vector<std::string> names;
    for (const std::int32_t region : regions) names.push_back("'" + groups.names()[static_cast<std::size_t>(region)] + "'");
    throw UserError(
        fmt::format("$Entities: volume {} is in {} physical groups: {}. A volume has one material: leave it in one group", volume,
                    names.size(), fmt::join(names, ", ")));
  }
  return regions.empty() ? -1 : regions.front();
}

void add_tetrahedra(const GmshFile& file, const NodeMap& nodes, TetraMesh& mesh) {
  const GroupNames groups(file, volume_dimension);
  mesh.region_names = groups.names();
  std::map<std::int32_t, std::int32_t> regions;
  for (std::size_t i = 0; i < file.tetrahedra.nodes.size(); ++i) {
    const std::int32_t volume = file.tetrahedra.entities[i];
    if (!regions.contains(volume)) regions[volume] = region_of(file, groups, volume);
    if (regions[volume] < 0) refuse_ungrouped(file, volume);
    auto& corners = mesh.tetrahedra.emplace_back();
    for (std::size_t corner = 0; corner < 4; ++corner) corners[corner] = nodes.find(file.tetrahedra.nodes[i][corner]);
    mesh.region.push_back(regions[volume]);
  }
  mesh.tags = file.tetrahedra.tags;
  auto numbers = mesh.tags;
  std::ranges::sort(numbers);
  if (const auto twice = std::ranges::adjacent_find(numbers); twice != numbers.end())
    throw UserError(
        fmt::format("$Elements: two tetrahedra have the number {}, by which messages and results name them. Save the mesh from "
                    "gmsh again, which renumbers them",
                    *twice));
}

void add_surfaces(const GmshFile& file, const NodeMap& nodes, TetraMesh& mesh) {
  const GroupNames groups(file, surface_dimension);
  for (const std::string& name : groups.names()) mesh.surfaces.push_back({name, {}});
  for (std::size_t i = 0; i < file.triangles.nodes.size(); ++i) {
    for (const std::int32_t number : groups_of(file, surface_dimension, file.triangles.entities[i])) {
      auto& surface = mesh.surfaces[static_cast<std::size_t>(groups.place(number))];
      auto& triangle = surface.triangles.emplace_back();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle[corner] = nodes.find(file.triangles.nodes[i][corner]);
        if (triangle[corner] >= 0) continue;
        throw UserError(
            fmt::format("$Elements: triangle {} of the surface group '{}' is on no tetrahedron (node {}). "
                        "Make the surface part "
                        "of a volume, or remove it from the group",
                        file.triangles.tags[i], surface.name, file.triangles.nodes[i][corner]));
      }
    }
  }
}

}  // namespace

TetraMesh read_gmsh(const std::filesystem::path& path, Real scale) {
  const GmshFile file = read_gmsh_file(path);
  try {
    if (!(scale > 0) || !std::isfinite(scale)) {
      throw UserError(fmt::format("the scale is {}; it should be a finite number above zero", scale));
    }
    if (file.tetrahedra.nodes.empty()) {
      throw UserError(
          "$Elements: there are no tetrahedra. Mesh in three dimensions (gmsh -3) and give every volume a "
          "Physical Volume");
    }
    TetraMesh mesh;
    const NodeMap nodes(file, scale, mesh);
    add_tetrahedra(file, nodes, mesh);
    add_surfaces(file, nodes, mesh);
    check_mesh(mesh);
    return mesh;
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace sazare::geometry
