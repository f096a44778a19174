#include "sazare/geometry/element_shape.hpp"

#include <algorithm>
#include <numeric>

namespace sazare::geometry {
namespace {

using Shape = ElementShape;

constexpr std::array<ShapeFacts, element_shape_count> all_facts = {{
    {"point", 0, 1, 1, false, false, 15, 1},
    {"2-node line", 1, 2, 2, false, false, 1, 3},
    {"3-node line", 1, 3, 2, true, false, 8, 21},
    {"3-node triangle", 2, 3, 3, false, true, 2, 5},
    {"6-node triangle", 2, 6, 3, true, true, 9, 22},
    {"4-node quadrilateral", 2, 4, 4, false, false, 3, 9},
    {"8-node quadrilateral", 2, 8, 4, true, false, 16, 23},
    {"9-node quadrilateral", 2, 9, 4, true, false, 10, 28},
    {"4-node tetrahedron", 3, 4, 4, false, true, 4, 10},
    {"10-node tetrahedron", 3, 10, 4, true, true, 11, 24},
    {"8-node hexahedron", 3, 8, 8, false, false, 5, 12},
    {"20-node hexahedron", 3, 20, 8, true, false, 17, 25},
    {"27-node hexahedron", 3, 27, 8, true, false, 12, 29},
}};

using Places = std::vector<std::vector<int>>;

/// Corners of the family's linear shape.
std::vector<Vector3> corners_of(Shape shape) {
  const ShapeFacts& about = facts(shape);
  if (about.dimension == 0) return {Vector3::Zero()};
  if (about.dimension == 1) return {{-1, 0, 0}, {1, 0, 0}};
  if (about.simplex && about.dimension == 2) return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  if (about.simplex) return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (about.dimension == 2) return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
}

/// Corners between which the further nodes stand in the middle, in Gmsh's order.
Places middles_of(Shape shape) {
  const ShapeFacts& about = facts(shape);
  if (!about.quadratic) return {};
  if (about.dimension == 1) return {{0, 1}};
  if (shape == Shape::triangle6) return {{0, 1}, {1, 2}, {2, 0}};
  if (shape == Shape::tetrahedron10) return {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}};
  if (about.dimension == 2) {
    Places middles = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    if (shape == Shape::quadrilateral9) middles.push_back({0, 1, 2, 3});
    return middles;
  }
  Places middles = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  if (shape == Shape::hexahedron27)
    for (const auto& more : Places{{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}})
      middles.push_back(more);
  if (shape == Shape::hexahedron27) middles.push_back({0, 1, 2, 3, 4, 5, 6, 7});
  return middles;
}

/// Corners of the faces, turning so that the normal points outwards.
Places face_corners(Shape shape) {
  const ShapeFacts& about = facts(shape);
  if (about.dimension == 2 && about.simplex) return {{0, 1}, {1, 2}, {2, 0}};
  if (about.dimension == 2) return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  if (about.dimension == 3 && about.simplex) return {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  if (about.dimension == 3) return {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
  return {};
}

Shape face_shape(Shape shape) {
  switch (shape) {
    case Shape::triangle3:
    case Shape::quadrilateral4:
      return Shape::line2;
    case Shape::triangle6:
    case Shape::quadrilateral8:
    case Shape::quadrilateral9:
      return Shape::line3;
    case Shape::tetrahedron4:
      return Shape::triangle3;
    case Shape::tetrahedron10:
      return Shape::triangle6;
    case Shape::hexahedron8:
      return Shape::quadrilateral4;
    case Shape::hexahedron20:
      return Shape::quadrilateral8;
    default:
      return Shape::quadrilateral9;
  }
}

/// The place of the node in the middle of some corners.
int place_of_middle(const Places& middles, int corners, std::vector<int> wanted) {
  std::ranges::sort(wanted);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    auto found = middles[i];
    std::ranges::sort(found);
    if (found == wanted) return corners + static_cast<int>(i);
  }
  return -1;
}

std::vector<ElementFace> make_faces(Shape shape) {
  std::vector<ElementFace> faces;
  const Places middles = middles_of(shape);
  for (const auto& corners : face_corners(shape)) {
    ElementFace face{face_shape(shape), corners};
    for (const auto& between : middles_of(face.shape)) {
      std::vector<int> wanted;
      for (const int corner : between) wanted.push_back(corners[static_cast<std::size_t>(corner)]);
      face.nodes.push_back(place_of_middle(middles, facts(shape).corners, wanted));
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

std::vector<Vector3> make_reference_nodes(Shape shape) {
  const std::vector<Vector3> corners = corners_of(shape);
  std::vector<Vector3> nodes = corners;
  for (const auto& between : middles_of(shape)) {
    Vector3 sum = Vector3::Zero();
    for (const int corner : between) sum += corners[static_cast<std::size_t>(corner)];
    nodes.push_back(sum / static_cast<Real>(between.size()));
  }
  return nodes;
}

std::vector<int> make_vtk_order(Shape shape) {
  if (shape == Shape::tetrahedron10) return {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  std::vector<int> order(static_cast<std::size_t>(facts(shape).nodes));
  std::iota(order.begin(), order.end(), 0);
  constexpr std::array edges = {8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
  constexpr std::array faces = {22, 23, 21, 24, 20, 25, 26};
  if (shape == Shape::hexahedron20 || shape == Shape::hexahedron27) std::ranges::copy(edges, order.begin() + 8);
  if (shape == Shape::hexahedron27) std::ranges::copy(faces, order.begin() + 20);
  return order;
}

/// What `make` says of every shape, made once.
template <class Make>
auto table_of(Make make) {
  std::array<decltype(make(Shape::point)), element_shape_count> table;
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = make(static_cast<Shape>(i));
  return table;
}

}  // namespace

const ShapeFacts& facts(ElementShape shape) { return all_facts[static_cast<std::size_t>(shape)]; }

const ElementShape* shape_of_gmsh_type(int type) {
  static const auto shapes = table_of([](Shape shape) { return shape; });
  for (const ElementShape& shape : shapes)
    if (facts(shape).gmsh_type == type) return &shape;
  return nullptr;
}

std::span<const Vector3> reference_nodes(ElementShape shape) {
  static const auto table = table_of(make_reference_nodes);
  return table[static_cast<std::size_t>(shape)];
}

std::span<const ElementFace> faces_of(ElementShape shape) {
  static const auto table = table_of(make_faces);
  return table[static_cast<std::size_t>(shape)];
}

std::span<const int> vtk_order(ElementShape shape) {
  static const auto table = table_of(make_vtk_order);
  return table[static_cast<std::size_t>(shape)];
}

}  // namespace sazare::geometry
