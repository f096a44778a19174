#include "sazare/geometry/gmsh/file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>

#include "sazare/core/error.hpp"
#include "sazare/geometry/element_shape.hpp"
#include "sazare/geometry/gmsh/scanner.hpp"

namespace sazare::geometry {
namespace {

constexpr int point_type = 15;
constexpr int line_type = 1;
constexpr int triangle_type = 2;
constexpr int tetrahedron_type = 4;

void read_format(GmshScanner& in) {
  const std::string version(in.read_word("the format's version"));
  if (version != "4.1") {
    in.fail(fmt::format("Gmsh format {}: Sazare reads 4.1. Convert it: gmsh OLD.msh -save -format msh41 -o NEW.msh", version));
  }
  const std::int64_t binary = in.read_text_integer("the file type (0 text, 1 binary)");
  const std::int64_t size = in.read_text_integer("the size of numbers");
  if (binary != 0 && binary != 1) in.fail(fmt::format("file type {}: should be 0 (text) or 1 (binary)", binary));
  if (size != 8) in.fail(fmt::format("numbers of {} bytes: Sazare reads 8. Write the file with a 64-bit gmsh", size));
  if (binary == 1) {
    in.skip_bytes(1);  // the line's end
    in.set_binary();
    if (in.read_integer("the byte order mark") != 1) {
      in.fail(
          "written in another byte order. Write it as text: gmsh OLD.msh -save -format msh41 -bin 0 -o "
          "NEW.msh");
    }
  }
}

void read_physical_names(GmshScanner& in, GmshFile& file) {
  const std::int64_t count = in.read_text_integer("the number of physical groups");
  for (std::int64_t i = 0; i < count; ++i) {
    const auto dimension = static_cast<int>(in.read_text_integer("a physical group's dimension"));
    const auto number = static_cast<std::int32_t>(in.read_text_integer("a physical group's number"));
    file.physical_names[{dimension, number}] = in.read_quoted("a physical group's name");
  }
}

void read_entity(GmshScanner& in, GmshFile& file, int dimension) {
  const std::int32_t tag = in.read_integer("an entity's number");
  const int box_numbers = dimension == 0 ? 3 : 6;
  for (int i = 0; i < box_numbers; ++i) in.read_real("an entity's extent");
  const std::int64_t groups = in.read_count("the number of an entity's physical groups", sizeof(std::int32_t));
  auto& numbers = file.physical_groups[{dimension, tag}];
  for (std::int64_t i = 0; i < groups; ++i) {
    const std::int64_t number = in.read_integer("a physical group's number");
    numbers.push_back(static_cast<std::int32_t>(std::abs(number)));  // negative: the orientation is reversed
  }
  if (dimension == 0) return;
  const std::int64_t bounds = in.read_count("the number of an entity's bounds", sizeof(std::int32_t));
  for (std::int64_t i = 0; i < bounds; ++i) in.read_integer("an entity's bound");
}

void read_entities(GmshScanner& in, GmshFile& file) {
  std::array<std::int64_t, 4> counts{};
  for (auto& count : counts) count = in.read_count("the number of entities", sizeof(std::int32_t));
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) read_entity(in, file, dimension);
  }
}

void read_node_block(GmshScanner& in, GmshFile& file) {
  const std::int32_t dimension = in.read_integer("a node block's dimension");
  in.read_integer("a node block's entity");
  const bool parametric = in.read_integer("a node block's parametric mark") != 0;
  const std::int64_t count = in.read_count("the number of nodes in a block", sizeof(std::int64_t));
  for (std::int64_t i = 0; i < count; ++i) file.node_tags.push_back(in.read_long("a node's number"));
  for (std::int64_t i = 0; i < count; ++i) {
    Vector3 node;
    for (int axis = 0; axis < 3; ++axis) node[axis] = in.read_real("a node's coordinate");
    const std::size_t index = file.nodes.size();
    if (!node.allFinite()) {
      in.fail(fmt::format("node {} has a coordinate that is not a finite number: ({}, {}, {}). Write the file again",
                          file.node_tags[index], node.x(), node.y(), node.z()));
    }
    file.nodes.push_back(node);
    for (int parameter = 0; parametric && parameter < dimension; ++parameter) in.read_real("a node's parameter");
  }
}

void read_nodes(GmshScanner& in, GmshFile& file) {
  const std::int64_t blocks = in.read_count("the number of node blocks", sizeof(std::int32_t));
  const std::int64_t nodes = in.read_count("the number of nodes", sizeof(std::int64_t));
  if (nodes >= INT32_MAX) in.fail(fmt::format("{} nodes: Sazare can number {} at most", nodes, INT32_MAX - 1));
  in.read_long("the smallest node number");
  in.read_long("the largest node number");
  for (std::int64_t i = 0; i < blocks; ++i) read_node_block(in, file);
  if (file.nodes.size() != static_cast<std::size_t>(nodes)) {
    in.fail(fmt::format("the section announces {} nodes but has {}. Write the file again", nodes, file.nodes.size()));
  }
}

/// How a user calls an element type of Gmsh that Sazare does not read, and what to do about it.
struct ElementType {
  int number;
  std::string_view name;
  bool higher_order;
};

constexpr std::array<ElementType, 20> element_types = {{
    {3, "4-node quadrangle", false},
    {5, "8-node hexahedron", false},
    {6, "6-node prism", false},
    {7, "5-node pyramid", false},
    {8, "3-node line, second order", true},
    {9, "6-node triangle, second order", true},
    {10, "9-node quadrangle, second order", true},
    {11, "10-node tetrahedron, second order", true},
    {12, "27-node hexahedron, second order", true},
    {13, "18-node prism, second order", true},
    {14, "14-node pyramid, second order", true},
    {16, "8-node quadrangle, second order", true},
    {17, "20-node hexahedron, second order", true},
    {18, "15-node prism, second order", true},
    {19, "13-node pyramid, second order", true},
    {21, "10-node triangle, third order", true},
    {23, "15-node triangle, fourth order", true},
    {26, "4-node line, third order", true},
    {29, "20-node tetrahedron, third order", true},
    {30, "35-node tetrahedron, fourth order", true},
}};

[[noreturn]] void refuse_type(const GmshScanner& in, std::int32_t type, std::int64_t first_tag) {
  for (const ElementType& known : element_types) {
    if (known.number != type) continue;
    const std::string_view advice = known.higher_order
                                        ? "Mesh with first-order elements: gmsh -order 1, or Mesh.ElementOrder = 1"
                                        : "Mesh with tetrahedra only: remove Recombine and Layers{..}; Recombine, and set "
                                          "Mesh.RecombineAll = 0 and Mesh.SubdivisionAlgorithm = 0";
    in.fail(fmt::format("element {} is of type {} ({}); Sazare reads first-order tetrahedra and triangles. {}", first_tag, type,
                        known.name, advice));
  }
  in.fail(
      fmt::format("element {} is of type {}, which Sazare does not read; it reads first-order tetrahedra (4) and "
                  "triangles (2). Mesh with gmsh -3 -order 1, without Recombine",
                  first_tag, type));
}

template <std::size_t Nodes>
void read_elements_of_block(GmshScanner& in, GmshElements<Nodes>& elements, std::int32_t entity, std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    elements.tags.push_back(in.read_long("an element's number"));
    elements.entities.push_back(entity);
    auto& nodes = elements.nodes.emplace_back();
    for (auto& node : nodes) node = in.read_long("an element's node");
  }
}

/// Returns the number of elements in the block.
std::int64_t read_block_of_any_shape(GmshScanner& in, GmshFile& file) {
  GmshBlock block;
  block.dimension = in.read_integer("an element block's dimension");
  block.entity = in.read_integer("an element block's entity");
  block.type = in.read_integer("an element block's type");
  const std::int64_t count = in.read_count("the number of elements in a block", 2 * sizeof(std::int64_t));
  const ElementShape* shape = shape_of_gmsh_type(block.type);
  if (shape == nullptr)
    in.fail(
        fmt::format("elements of type {}, which Sazare does not read: it reads points, lines, triangles, quadrilaterals, "
                    "tetrahedra and hexahedra of first and second order. Mesh without prisms and pyramids, of order 1 or 2",
                    block.type));
  for (std::int64_t i = 0; i < count; ++i) {
    block.tags.push_back(in.read_long("an element's number"));
    for (int node = 0; node < facts(*shape).nodes; ++node) block.nodes.push_back(in.read_long("an element's node"));
  }
  file.blocks.push_back(std::move(block));
  return count;
}

/// Returns the number of elements in the block.
std::int64_t read_block_of_simplices(GmshScanner& in, GmshFile& file) {
  in.read_integer("an element block's dimension");
  const std::int32_t entity = in.read_integer("an element block's entity");
  const std::int32_t type = in.read_integer("an element block's type");
  const std::int64_t count = in.read_count("the number of elements in a block", 2 * sizeof(std::int64_t));
  GmshElements<1> points;
  GmshElements<2> lines;
  if (type == point_type) {
    read_elements_of_block(in, points, entity, count);
  } else if (type == line_type) {
    read_elements_of_block(in, lines, entity, count);
  } else if (type == triangle_type) {
    read_elements_of_block(in, file.triangles, entity, count);
  } else if (type == tetrahedron_type) {
    read_elements_of_block(in, file.tetrahedra, entity, count);
  } else {
    refuse_type(in, type, in.read_long("an element's number"));
  }
  return count;
}

using ReadBlock = std::int64_t (*)(GmshScanner&, GmshFile&);

void read_elements(GmshScanner& in, GmshFile& file, ReadBlock read_element_block) {
  const std::int64_t blocks = in.read_count("the number of element blocks", sizeof(std::int32_t));
  const std::int64_t elements = in.read_count("the number of elements", 2 * sizeof(std::int64_t));
  if (elements >= INT32_MAX / 4) {
    in.fail(fmt::format("{} elements: Sazare can number {} at most", elements, INT32_MAX / 4 - 1));
  }
  in.read_long("the smallest element number");
  in.read_long("the largest element number");
  std::int64_t found = 0;
  for (std::int64_t i = 0; i < blocks; ++i) found += read_element_block(in, file);
  if (found != elements) {
    in.fail(fmt::format("the section announces {} elements but has {}. Write the file again", elements, found));
  }
}

void read_simplices(GmshScanner& in, GmshFile& file) { read_elements(in, file, read_block_of_simplices); }
void read_every_shape(GmshScanner& in, GmshFile& file) { read_elements(in, file, read_block_of_any_shape); }

using ReadSection = void (*)(GmshScanner&, GmshFile&);

std::map<std::string, ReadSection> sections_to_read(GmshContent content) {
  return {{"PhysicalNames", read_physical_names},
          {"Entities", read_entities},
          {"Nodes", read_nodes},
          {"Elements", content == GmshContent::simplices ? read_simplices : read_every_shape}};
}

}  // namespace

std::string group_name(const GmshFile& file, int dimension, std::int32_t number) {
  const auto found = file.physical_names.find({dimension, number});
  return found == file.physical_names.end() || found->second.empty() ? std::to_string(number) : found->second;
}

std::set<std::int32_t> group_numbers(const GmshFile& file, int dimension) {
  std::set<std::int32_t> numbers;
  for (const auto& [key, name] : file.physical_names)
    if (key.first == dimension) numbers.insert(key.second);
  for (const auto& [key, groups] : file.physical_groups)
    if (key.first == dimension) numbers.insert(groups.begin(), groups.end());
  return numbers;
}

GmshFile read_gmsh_file(const std::filesystem::path& path, GmshContent content) {
  const auto sections = sections_to_read(content);
  GmshScanner in(path);
  GmshFile file;
  in.next_section();
  if (in.section() != "MeshFormat") in.fail("not a Gmsh mesh: it should begin with $MeshFormat. Name a .msh file");
  read_format(in);
  in.end_section();
  std::set<std::string> found;
  while (in.next_section()) {
    if (in.section() == "PartitionedEntities") in.fail("the mesh is partitioned. Mesh again without -part");
    const auto known = sections.find(in.section());
    if (known == sections.end()) {
      in.skip_section();
      continue;
    }
    if (!found.insert(in.section()).second) in.fail("the section occurs twice in the file. Write the file again");
    known->second(in, file);
    in.end_section();
  }
  for (const std::string name : {"Nodes", "Elements"}) {
    if (found.contains(name)) continue;
    in.fail(fmt::format("the section ${} is missing: the file is truncated. Write or copy it again", name));
  }
  return file;
}

}  // namespace sazare::geometry
