#pragma once

/// Boxes of finite elements for tests.

#include <string>

#include "sazare/methods/fem/stepper.hpp"

namespace sazare::test {

using geometry::ElementMesh, geometry::ElementShape;

struct BoxRules {
  Vector3 size = Vector3::Ones();  ///< [m]
  std::array<int, 3> cells = {1, 1, 1};
  Real distortion = 0;  ///< of the inner corners, over a cell
};

/// A box from the origin, with the groups "left", "right" (x), "bottom", "top" (the last axis) and in space "front", "back" (y).
ElementMesh box(ElementShape shape, const BoxRules& rules);

inline constexpr std::array solid_shapes = {
    ElementShape::triangle3,      ElementShape::triangle6,    ElementShape::quadrilateral4, ElementShape::quadrilateral8,
    ElementShape::quadrilateral9, ElementShape::tetrahedron4, ElementShape::tetrahedron10,  ElementShape::hexahedron8,
    ElementShape::hexahedron20,   ElementShape::hexahedron27};

std::string name_of(ElementShape shape);

/// Calls test(shape, std::integral_constant<int, D>) for every shape.
template <class Test>
void for_every_shape(Test test) {
  for (const ElementShape shape : solid_shapes)
    if (geometry::facts(shape).dimension == 2)
      test(shape, std::integral_constant<int, 2>{});
    else
      test(shape, std::integral_constant<int, 3>{});
}

/// Adds supports on the nodes of a group along an axis.
template <int D>
void hold(const ElementMesh& mesh, const std::string& group, int axis, methods::fem::Supports<D>& supports,
          Index motion = methods::fem::Support::no_motion);

/// A body of one material.
methods::fem::BodyDescription of_one_material(ElementMesh mesh, const methods::fem::SolidMaterial& material);

/// Forces of a traction on a group [N].
methods::fem::NodalColumn traction(const ElementMesh& mesh, const std::string& group, const Vector3& pressure);

/// The node nearest to a place.
Index node_at(const ElementMesh& mesh, const Vector3& place);

}  // namespace sazare::test
