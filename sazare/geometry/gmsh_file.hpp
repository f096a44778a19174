#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
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

/// What a Gmsh file says, before anything is looked up or checked.
struct GmshFile {
  using Key = std::pair<int, std::int32_t>;  ///< dimension, number

  std::map<Key, std::string> physical_names;                 ///< by dimension and physical number
  std::map<Key, std::vector<std::int32_t>> physical_groups;  ///< physical numbers of an entity
  std::vector<std::int64_t> node_tags;
  std::vector<Vector3> nodes;  ///< the file's unit
  GmshElements<3> triangles;
  GmshElements<4> tetrahedra;
};

/// Reads the sections of a Gmsh mesh, format 4.1, ASCII or binary. Throws UserError.
GmshFile read_gmsh_file(const std::filesystem::path& file);

}  // namespace sazare::geometry
