#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sazare/core/vector.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sazare::geometry::test {

using sazare::test::read_text;
using sazare::test::TemporaryFolder;

/// A Gmsh file in the making; what a test spoils in it, a reader must notice.
struct MshWriter {
  struct Group {
    int dimension;
    int number;
    std::string name;
  };
  struct Element {
    int type;
    int dimension;
    int entity;
    std::vector<std::int64_t> nodes;
  };

  std::string version = "4.1";
  std::vector<Group> names;
  std::map<int, std::vector<int>> surface_groups;  ///< physical numbers of a surface
  std::map<int, std::vector<int>> volume_groups;   ///< physical numbers of a volume
  std::vector<Vector3> nodes;                      ///< numbered 1, 2, ...
  std::vector<Element> elements;                   ///< numbered 101, 102, ...
  bool parametric = false;

  std::string text() const;
  std::string binary() const;
};

/// Two tetrahedra that share a face, in the groups "left" and "right", with the surface "floor" (2
/// triangles): nodes 1..5, elements 101 and 102 are the triangles, 103 and 104 the tetrahedra.
MshWriter two_tetrahedra();

}  // namespace sazare::geometry::test
