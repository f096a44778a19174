#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "sazare/core/error.hpp"
#include "sazare/geometry/element_mesh.hpp"
#include "sazare/geometry/gmsh/file.hpp"
#include "sazare/geometry/mesh_checks.hpp"

namespace sazare::geometry {
namespace {

/// Names of the physical groups of an entity.
std::vector<std::string> groups_of(const GmshFile& file, const GmshBlock& block) {
  std::set<std::string> names;
  const auto found = file.physical_groups.find({block.dimension, block.entity});
  if (found != file.physical_groups.end())
    for (const std::int32_t number : found->second) names.insert(group_name(file, block.dimension, number));
  return {names.begin(), names.end()};
}

/// A mesh from what a file says.
class MeshMaker {
public:
  MeshMaker(const GmshFile& file, int dimension, Real scale) : file_(file), scale_(scale) { mesh_.dimension = dimension; }

  ElementMesh make() {
    find_nodes();
    for (const GmshBlock& block : file_.blocks)
      if (!groups_of(file_, block).empty()) check_dimension(block);
    for (const GmshBlock& block : file_.blocks)
      if (block.dimension == mesh_.dimension) add_body(block);
    if (mesh_.elements.empty()) refuse_empty();
    for (const GmshBlock& block : file_.blocks)
      if (block.dimension < mesh_.dimension)
        for (const std::string& name : groups_of(file_, block)) add_group(block, name);
    return std::move(mesh_);
  }

private:
  void find_nodes() {
    for (std::size_t i = 0; i < file_.node_tags.size(); ++i)
      if (!in_file_.emplace(file_.node_tags[i], i).second)
        throw UserError(fmt::format("$Nodes: node {} occurs twice. Write the file again", file_.node_tags[i]));
  }

  void check_dimension(const GmshBlock& block) const {
    if (block.dimension <= mesh_.dimension) return;
    throw UserError(
        fmt::format("$Elements: the group '{}' holds elements of {} dimensions, such as element {}, and the case is "
                    "in {}-D: set mesh.dimension = {}, or remove the group from the mesh",
                    groups_of(file_, block).front(), block.dimension, block.tags.empty() ? 0 : block.tags.front(),
                    mesh_.dimension, block.dimension));
  }

  [[noreturn]] void refuse_empty() const {
    int highest = 0;
    for (const GmshBlock& block : file_.blocks)
      if (!groups_of(file_, block).empty()) highest = std::max(highest, block.dimension);
    if (mesh_.dimension == 3 && highest == 2)
      throw UserError(
          "$Elements: the case is in 3-D, and the physical groups of the mesh hold elements of 2 dimensions at most: set "
          "mesh.dimension = 2, or mesh in three dimensions (gmsh -3) and give every volume a Physical Volume");
    throw UserError(
        fmt::format("$Elements: there are no elements of {0} dimensions in a physical group. Mesh with gmsh -{0} and "
                    "add to the geometry: Physical {1}(\"NAME\") = {{...}};",
                    mesh_.dimension, mesh_.dimension == 3 ? "Volume" : "Surface"));
  }

  void add_body(const GmshBlock& block) {
    const std::vector<std::string> names = groups_of(file_, block);
    if (names.empty())
      throw UserError(fmt::format(
          "$Elements: the elements of entity {} (the first is element {}) are in no physical group, so "
          "they have no material. Add to the geometry: Physical {}(\"NAME\") = {{{}}};",
          block.entity, block.tags.empty() ? 0 : block.tags.front(), mesh_.dimension == 3 ? "Volume" : "Surface", block.entity));
    if (names.size() > 1)
      throw UserError(
          fmt::format("$Entities: entity {} is in the physical groups '{}' and '{}'. It has one material: leave it in "
                      "one group",
                      block.entity, names[0], names[1]));
    const Index region = place_of_region(names.front());
    for (std::size_t i = 0; i < block.tags.size(); ++i) {
      mesh_.elements.push_back(element_of(block, i, true));
      mesh_.region.push_back(region);
    }
  }

  void add_group(const GmshBlock& block, const std::string& name) {
    ElementGroup* group = nullptr;
    for (ElementGroup& known : mesh_.groups)
      if (known.name == name) group = &known;
    if (group == nullptr) group = &mesh_.groups.emplace_back(ElementGroup{name, block.dimension, {}});
    if (group->dimension != block.dimension)
      throw UserError(fmt::format("$Elements: the group '{}' holds elements of {} and of {} dimensions. Give them two names",
                                  name, group->dimension, block.dimension));
    for (std::size_t i = 0; i < block.tags.size(); ++i) {
      group->elements.push_back(element_of(block, i, false));
      for (const Index node : group->elements.back().node_list())
        if (node < 0)
          throw UserError(
              fmt::format("$Elements: element {} of the group '{}' touches no element of the body. Make the group part of it, or "
                          "remove the group; members, too, run along the body alone",
                          block.tags[i], name));
    }
  }

  Index place_of_region(const std::string& name) {
    for (std::size_t i = 0; i < mesh_.region_names.size(); ++i)
      if (mesh_.region_names[i] == name) return static_cast<Index>(i);
    mesh_.region_names.push_back(name);
    return static_cast<Index>(mesh_.region_names.size()) - 1;
  }

  /// Nodes get their place when the body first names them.
  MeshElement element_of(const GmshBlock& block, std::size_t number, bool of_body) {
    MeshElement element{*shape_of_gmsh_type(block.type), {}, block.tags[number]};
    const auto count = static_cast<std::size_t>(facts(element.shape).nodes);
    for (std::size_t i = 0; i < count; ++i)
      element.nodes[i] = place_of_node(block.nodes[number * count + i], element.tag, of_body);
    return element;
  }

  Index place_of_node(std::int64_t tag, std::int64_t element, bool of_body) {
    if (const auto found = places_.find(tag); found != places_.end()) return found->second;
    if (!of_body) return -1;
    const auto in_file = in_file_.find(tag);
    if (in_file == in_file_.end())
      throw UserError(
          fmt::format("$Elements: element {} names node {}, which is not in $Nodes. Write the file again", element, tag));
    mesh_.nodes.push_back(scale_ * file_.nodes[in_file->second]);
    mesh_.node_tags.push_back(tag);
    return places_[tag] = static_cast<Index>(mesh_.nodes.size()) - 1;
  }

  const GmshFile& file_;
  Real scale_;
  ElementMesh mesh_;
  std::unordered_map<std::int64_t, std::size_t> in_file_;
  std::unordered_map<std::int64_t, Index> places_;
};

void check_flat(const ElementMesh& mesh) {
  if (mesh.dimension != 2) return;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].z() != 0)
      throw UserError(fmt::format("$Nodes: node {} lies at z = {} m; in 2-D the body lies in the plane z = 0", mesh.node_tags[i],
                                  mesh.nodes[i].z()));
}

}  // namespace

ElementMesh read_element_mesh(const std::filesystem::path& path, int dimension, Real scale) {
  const GmshFile file = read_gmsh_file(path, GmshContent::every_shape);
  try {
    ElementMesh mesh = MeshMaker(file, dimension, scale).make();
    check_flat(mesh);
    check_conforming(mesh);
    return mesh;
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace sazare::geometry
