#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/geometry/linear_surface.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::geometry {
namespace {

/// Area of a face times its normal to the side of the bodies; in 2-D per metre.
Vector3 across(const ElementMesh& mesh, const LinearSurface& surface, std::size_t face) {
  const auto dimension = static_cast<std::size_t>(surface.dimension);
  const auto node = [&](std::size_t k) {
    return mesh.nodes[static_cast<std::size_t>(surface.nodes[static_cast<std::size_t>(surface.faces[face * dimension + k])])];
  };
  const Vector3 side = node(1) - node(0);
  return dimension == 2 ? Vector3(-side.y(), side.x(), 0) : Vector3(0.5 * side.cross(node(2) - node(0)));
}

TEST(linear_surface, covers_the_faces_of_every_shape_and_looks_outwards) {
  test::for_every_shape([](ElementShape shape, auto) {
    const ElementMesh mesh = test::box(shape, {{1, 2, 3}, {2, 3, 2}, 0});
    for (const ElementGroup& group : mesh.groups) {
      const LinearSurface surface = linear_surface(mesh, group);
      const auto dimension = static_cast<std::size_t>(mesh.dimension);
      const std::size_t faces = surface.faces.size() / dimension;
      Vector3 sum = Vector3::Zero(), middle = Vector3::Zero();
      for (std::size_t face = 0; face < faces; ++face) {
        sum += across(mesh, surface, face);
        EXPECT_GT(across(mesh, surface, face).norm(), 1e-3);
      }
      for (const Index node : surface.nodes) middle += mesh.nodes[static_cast<std::size_t>(node)];
      middle /= static_cast<Real>(surface.nodes.size());
      const Vector3 size(1, 2, mesh.dimension == 2 ? 0 : 3), outwards = middle - 0.5 * size;
      const Real area = (group.name == "left" || group.name == "right")   ? (dimension == 2 ? 2 : 6)
                        : (group.name == "bottom" || group.name == "top") ? (dimension == 2 ? 1 : 2)
                                                                          : 3;
      EXPECT_NEAR(sum.norm(), area, 1e-12) << test::name_of(shape) << group.name;
      EXPECT_GT(sum.dot(outwards), 0.4 * area) << test::name_of(shape) << group.name;
    }
  });
}

TEST(linear_surface, has_all_nodes_of_its_faces_once) {
  const ElementMesh mesh = test::box(ElementShape::quadrilateral8, {{1, 1, 1}, {3, 2, 1}, 0});
  const LinearSurface surface = linear_surface(mesh, *mesh.find_group("top"));
  EXPECT_EQ(surface.nodes.size(), 7U);
  EXPECT_EQ(surface.faces.size(), 12U);
}

TEST(linear_surface, refuses_what_is_no_face_of_the_body) {
  ElementMesh mesh = test::box(ElementShape::triangle3, {{1, 1, 1}, {3, 2, 1}, 0});
  ElementGroup& group = mesh.groups.front();
  group.elements.front().nodes[0] = test::node_at(mesh, {1, 1, 0});
  EXPECT_THROW(linear_surface(mesh, group), UserError);
}

}  // namespace
}  // namespace sazare::geometry
