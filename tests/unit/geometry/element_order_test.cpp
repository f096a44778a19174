#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sazare/geometry/element_order.hpp"
#include "sazare/geometry/gmsh/reader.hpp"

namespace sazare::geometry {
namespace {

TetraMesh shuffled_slab() {
  TetraMesh mesh = read_gmsh("cases/free-face-blast/slab.msh", 1.0);
  std::mt19937 random(7);
  for (std::size_t last = mesh.tetrahedra.size() - 1; last > 0; --last) {
    const std::size_t other = random() % (last + 1);
    std::swap(mesh.tetrahedra[last], mesh.tetrahedra[other]);
    std::swap(mesh.region[last], mesh.region[other]);
    std::swap(mesh.tags[last], mesh.tags[other]);
  }
  return mesh;
}

/// Mean distance of elements that follow one another [m].
Real mean_stride(const TetraMesh& mesh) {
  const auto corner = [&](std::size_t element) { return mesh.nodes[static_cast<std::size_t>(mesh.tetrahedra[element][0])]; };
  Real sum = 0;
  for (std::size_t element = 1; element < mesh.tetrahedra.size(); ++element)
    sum += (corner(element) - corner(element - 1)).norm();
  return sum / static_cast<Real>(mesh.tetrahedra.size() - 1);
}

TEST(element_order, neighbours_in_memory_are_neighbours_in_space) {
  TetraMesh mesh = shuffled_slab();
  const Real before = mean_stride(mesh);
  sort_along_curve(mesh);
  EXPECT_LT(mean_stride(mesh), 0.3 * before);
}

TEST(element_order, elements_keep_their_nodes_regions_and_tags) {
  const TetraMesh original = read_gmsh("cases/free-face-blast/slab.msh", 1.0);
  TetraMesh mesh = shuffled_slab();
  sort_along_curve(mesh);
  for (std::size_t element = 0; element < mesh.tags.size(); ++element) {
    const auto same = static_cast<std::size_t>(std::ranges::find(original.tags, mesh.tags[element]) - original.tags.begin());
    ASSERT_LT(same, original.tags.size());
    EXPECT_EQ(mesh.tetrahedra[element], original.tetrahedra[same]);
    EXPECT_EQ(mesh.region[element], original.region[same]);
  }
}

TEST(element_order, does_not_depend_on_the_order_of_the_file) {
  TetraMesh mesh = shuffled_slab(), original = read_gmsh("cases/free-face-blast/slab.msh", 1.0);
  sort_along_curve(mesh);
  sort_along_curve(original);
  EXPECT_EQ(mesh.tags, original.tags);
}

}  // namespace
}  // namespace sazare::geometry
