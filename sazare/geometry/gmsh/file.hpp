#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

/// Elements of one type as the file has them: numbers and nodes of the file.
template <std::size_t Nodes>
struct GmshElements {
  std::vector<std::int64_t> tags;
  std::vector<std::int32_t> entities;
  std::vector<std::array<std::int64_t, Nodes>> nodes;
};

/// Elements of one type in one entity, of any shape.
struct GmshBlock {
  int type = 0;
  int dimension = 0;
  std::int32_t entity = 0;
  std::vector<std::int64_t> tags;
  std::vector<std::int64_t> nodes;  ///< (elements, nodes of the type)
};

/// Which elements are read; others are refused.
enum class GmshContent { simplices, every_shape };

/// What a Gmsh file says, before anything is looked up or checked.
struct GmshFile {
  using Key = std::pair<int, std::int32_t>;  ///< dimension, number

  std::map<Key, std::string> physical_names;                 ///< by dimension and physical number
  std::map<Key, std::vector<std::int32_t>> physical_groups;  ///< physical numbers of an entity
  std::vector<std::int64_t> node_tags;
  std::vector<Vector3> nodes;  ///< the file's unit
  GmshElements<3> triangles;
  GmshElements<4> tetrahedra;
  std::vector<GmshBlock> blocks;  ///< where every shape is read: all elements, and the two lists above stay empty
};

/// The name of a physical group; one without a name goes by its number.
std::string group_name(const GmshFile& file, int dimension, std::int32_t number);

/// The numbers of all physical groups of a dimension, whether they have names or not.
std::set<std::int32_t> group_numbers(const GmshFile& file, int dimension);

/// Reads the sections of a Gmsh mesh, format 4.1, ASCII or binary. Throws UserError.
GmshFile read_gmsh_file(const std::filesystem::path& file, GmshContent content = GmshContent::simplices);

}  // namespace sazare::geometry
