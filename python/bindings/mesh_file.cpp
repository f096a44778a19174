#include "python/bindings/mesh_file.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "sazare/geometry/gmsh/file.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace sazare::python {

namespace {

/// An array that owns its numbers.
template <class Number>
nb::ndarray<nb::numpy, Number> array_of(std::vector<Number> numbers, std::initializer_list<std::size_t> shape) {
  auto* const kept = new std::vector<Number>(std::move(numbers));
  const nb::capsule owner(kept, [](void* of) noexcept { delete static_cast<std::vector<Number>*>(of); });
  return nb::ndarray<nb::numpy, Number>(kept->data(), shape, owner);
}

nb::list group_names(const geometry::GmshFile& file, const geometry::GmshBlock& block) {
  nb::list names;
  const auto found = file.physical_groups.find({block.dimension, block.entity});
  if (found == file.physical_groups.end()) return names;
  for (const std::int32_t number : found->second) names.append(geometry::group_name(file, block.dimension, number));
  return names;
}

nb::tuple mesh_file(const std::filesystem::path& path) {
  const geometry::GmshFile file = geometry::read_gmsh_file(path, geometry::GmshContent::every_shape);
  std::vector<double> points;
  std::unordered_map<std::int64_t, std::int64_t> row;
  for (std::size_t i = 0; i < file.nodes.size(); ++i) {
    points.insert(points.end(), file.nodes[i].begin(), file.nodes[i].end());
    row.emplace(file.node_tags[i], static_cast<std::int64_t>(i));
  }
  nb::list blocks;
  for (const geometry::GmshBlock& block : file.blocks) {
    std::vector<std::int64_t> nodes;
    for (const std::int64_t tag : block.nodes) nodes.push_back(row.at(tag));
    const std::size_t count = block.tags.size(), width = count == 0 ? 0 : nodes.size() / count;
    blocks.append(nb::make_tuple(block.dimension, group_names(file, block), block.type, array_of(block.tags, {count}),
                                 array_of(std::move(nodes), {count, width})));
  }
  return nb::make_tuple(array_of(std::move(points), {file.nodes.size(), 3}), blocks);
}

}  // namespace

void add_mesh_file(nb::module_& module) {
  module.def(
      "mesh_file", &mesh_file, "path"_a,
      "A Gmsh mesh: coordinates (n, 3) in the unit of the file, and elements of one type in one entity: dimension, names of "
      "its groups, Gmsh's type, numbers (k,), rows of their nodes (k, nodes).");
}

}  // namespace sazare::python
