#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/geometry/mesh_checks.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sazare::geometry {
namespace {

using sazare::test::words_of;

/// Squares of side 1, one on the other, with nodes of their own.
ElementMesh squares(int count, Real gap) {
  ElementMesh mesh;
  mesh.region_names = {"body"};
  for (int square = 0; square < count; ++square) {
    const Real y = square * (1 + gap);
    const auto first = static_cast<Index>(mesh.nodes.size());
    for (const Vector3& corner : {Vector3(0, y, 0), Vector3(1, y, 0), Vector3(1, y + 1, 0), Vector3(0, y + 1, 0)}) {
      mesh.nodes.push_back(corner);
      mesh.node_tags.push_back(static_cast<std::int64_t>(mesh.nodes.size()));
    }
    mesh.elements.push_back({ElementShape::quadrilateral4, {first, first + 1, first + 2, first + 3}, square + 1});
    mesh.region.push_back(0);
  }
  return mesh;
}

std::string words(const ElementMesh& mesh) {
  return words_of<UserError>([&] { check_conforming(mesh); });
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

TEST(conforming, nodes_that_stand_twice_are_refused) {
  EXPECT_NO_THROW(check_conforming(squares(2, 0.01)));
  EXPECT_SAYS(words(squares(2, 0)), "2 pairs of nodes stand in one place: 4 and 5, 3 and 6. The parts of the body");
  EXPECT_SAYS(words(squares(2, 1e-9)), "2 pairs of nodes stand in one place") << "within the rounding of a file";
}

TEST(conforming, elements_that_stand_twice_are_refused) {
  ElementMesh mesh = squares(1, 0);
  mesh.elements.push_back(mesh.elements.front());
  mesh.elements.back().tag = 7;
  mesh.region.push_back(0);
  EXPECT_SAYS(words(mesh), "1 pair of elements have the same nodes, so their material would count twice: 1 and 7");
}

}  // namespace
}  // namespace sazare::geometry
