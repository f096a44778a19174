#pragma once

/// Shapes of finite elements, with Gmsh's order of nodes.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::geometry {

enum class ElementShape : std::uint8_t {
  point,
  line2,
  line3,
  triangle3,
  triangle6,
  quadrilateral4,
  quadrilateral8,
  quadrilateral9,
  tetrahedron4,
  tetrahedron10,
  hexahedron8,
  hexahedron20,
  hexahedron27,
};

inline constexpr std::size_t element_shape_count = 13;
inline constexpr int most_element_nodes = 27;

/// What is known of a shape.
struct ShapeFacts {
  std::string_view name;  ///< as users call it
  int dimension = 0;
  int nodes = 0;
  int corners = 0;
  bool quadratic = false;
  bool simplex = false;  ///< triangle or tetrahedron: its reference coordinates are shares of the corners
  int gmsh_type = 0;
  std::uint8_t vtk_type = 0;
};

const ShapeFacts& facts(ElementShape shape);

/// Shape of an element type of Gmsh; nullptr where Sazare has none.
const ElementShape* shape_of_gmsh_type(int type);

/// Reference coordinates of the nodes: from 0 to 1 on simplices, from -1 to 1 on all others; beyond the dimension they are 0.
std::span<const Vector3> reference_nodes(ElementShape shape);

/// A face of an element (in 2-D a side), seen from outside: its nodes turn so that the normal points outwards.
struct ElementFace {
  ElementShape shape;
  std::vector<int> nodes;  ///< places in the element's list
};

std::span<const ElementFace> faces_of(ElementShape shape);

/// Places of Gmsh's nodes in VTK's order: the i-th node of VTK is nodes[order[i]].
std::span<const int> vtk_order(ElementShape shape);

}  // namespace sazare::geometry
