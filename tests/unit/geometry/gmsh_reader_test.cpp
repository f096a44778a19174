#include <gtest/gtest.h>

#include <cmath>

#include "msh_writer.hpp"
#include "sazare/geometry/gmsh/reader.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {
namespace {

using test::MshWriter;
using test::TemporaryFolder;
using test::two_tetrahedra;

const char* const slab_file = "cases/free-face-blast/slab.msh";

const TetraMesh::Surface* find(const TetraMesh& mesh, const std::string& name) {
  for (const auto& surface : mesh.surfaces) {
    if (surface.name == name) return &surface;
  }
  return nullptr;
}

TEST(gmsh_reader, slab_of_the_paper) {
  const TetraMesh mesh = read_gmsh(slab_file, 1);
  EXPECT_EQ(mesh.nodes.size(), 348u);
  EXPECT_EQ(mesh.tetrahedra.size(), 1039u);
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"concrete"});
  EXPECT_EQ(mesh.region, std::vector<std::int32_t>(1039, 0));
  EXPECT_EQ(mesh.tags.size(), 1039u);
  EXPECT_EQ(mesh.tags.back(), 1803);
  ASSERT_EQ(mesh.surfaces.size(), 7u);
  EXPECT_EQ(mesh.surfaces[0].name, "left");
  EXPECT_NE(find(mesh, "hole"), nullptr);
  Real total = 0;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    total += volume(corners_of(mesh, static_cast<std::int32_t>(i)));
  }
  // 1.8 x 1.2 x 0.2 m less a hexagonal hole of radius 0.025 m.
  EXPECT_NEAR(total, 1.8 * 1.2 * 0.2 - 1.5 * std::sqrt(3.0) * 0.025 * 0.025 * 0.2, 1e-12);
}

TEST(gmsh_reader, hole_has_its_area) {
  const TetraMesh mesh = read_gmsh(slab_file, 1);
  Real area = 0;
  for (const auto& triangle : find(mesh, "hole")->triangles) {
    const auto at = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(triangle[i])]; };
    area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  EXPECT_NEAR(area, 6 * 0.025 * 0.2, 1e-12);
}

void expect_two_tetrahedra(const TetraMesh& mesh) {
  EXPECT_EQ(mesh.nodes.size(), 5u);
  ASSERT_EQ(mesh.tetrahedra.size(), 2u);
  EXPECT_EQ(mesh.tetrahedra[0], (std::array<std::int32_t, 4>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.tetrahedra[1], (std::array<std::int32_t, 4>{1, 4, 2, 3}));
  EXPECT_EQ(mesh.region, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(mesh.tags, (std::vector<std::int64_t>{103, 104}));
  ASSERT_EQ(mesh.surfaces.size(), 1u);
  EXPECT_EQ(mesh.surfaces[0].name, "floor");
  EXPECT_EQ(mesh.surfaces[0].triangles.size(), 2u);
  EXPECT_EQ(mesh.surfaces[0].triangles[1], (std::array<std::int32_t, 3>{1, 4, 2}));
}

TEST(gmsh_reader, text_and_binary_give_the_same_mesh) {
  const TemporaryFolder folder;
  expect_two_tetrahedra(read_gmsh(folder.write("text.msh", two_tetrahedra().text()), 1));
  expect_two_tetrahedra(read_gmsh(folder.write("binary.msh", two_tetrahedra().binary()), 1));
}

TEST(gmsh_reader, parametric_coordinates_are_passed_over) {
  const TemporaryFolder folder;
  MshWriter mesh = two_tetrahedra();
  mesh.parametric = true;
  expect_two_tetrahedra(read_gmsh(folder.write("text.msh", mesh.text()), 1));
  expect_two_tetrahedra(read_gmsh(folder.write("binary.msh", mesh.binary()), 1));
}

TEST(gmsh_reader, windows_line_ends_and_other_sections_are_passed_over) {
  const TemporaryFolder folder;
  std::string text = two_tetrahedra().text();
  text.insert(text.find("$Nodes"), "$Comments\nmade by hand $ 5\n$EndComments\n");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  expect_two_tetrahedra(read_gmsh(folder.write("text.msh", text), 1));
}

TEST(gmsh_reader, scale_multiplies_coordinates) {
  const TemporaryFolder folder;
  const TetraMesh mesh = read_gmsh(folder.write("a.msh", two_tetrahedra().text()), 1e-3);
  EXPECT_EQ(mesh.nodes[1], Vector3(1e-3, 0, 0));
}

TEST(gmsh_reader, nodes_without_a_tetrahedron_are_dropped) {
  const TemporaryFolder folder;
  MshWriter mesh = two_tetrahedra();
  mesh.nodes.insert(mesh.nodes.begin(), Vector3(7, 7, 7));
  mesh.nodes.emplace_back(8, 8, 8);
  for (auto& element : mesh.elements) {
    for (auto& node : element.nodes) ++node;
  }
  mesh.elements.push_back({15, 0, 1, {1}});
  mesh.elements.push_back({1, 1, 1, {1, 7}});
  expect_two_tetrahedra(read_gmsh(folder.write("a.msh", mesh.binary()), 1));
}

TEST(gmsh_reader, surface_may_be_in_several_groups) {
  const TemporaryFolder folder;
  MshWriter mesh = two_tetrahedra();
  mesh.names.push_back({2, 3, "all"});
  mesh.surface_groups[1] = {7, -3};
  const TetraMesh read = read_gmsh(folder.write("a.msh", mesh.text()), 1);
  ASSERT_EQ(read.surfaces.size(), 2u);
  EXPECT_EQ(read.surfaces[0].name, "all");
  EXPECT_EQ(read.surfaces[1].name, "floor");
  EXPECT_EQ(read.surfaces[0].triangles, read.surfaces[1].triangles);
}

TEST(gmsh_reader, group_without_name_goes_by_its_number) {
  const TemporaryFolder folder;
  MshWriter mesh = two_tetrahedra();
  mesh.names.erase(mesh.names.begin() + 1);
  const TetraMesh read = read_gmsh(folder.write("a.msh", mesh.text()), 1);
  EXPECT_EQ(read.region_names, (std::vector<std::string>{"8", "right"}));
}

TEST(gmsh_reader, named_surface_without_triangles_is_kept_empty) {
  const TemporaryFolder folder;
  MshWriter mesh = two_tetrahedra();
  mesh.names.push_back({2, 30, "hole"});
  const TetraMesh read = read_gmsh(folder.write("a.msh", mesh.text()), 1);
  ASSERT_NE(find(read, "hole"), nullptr);
  EXPECT_TRUE(find(read, "hole")->triangles.empty());
}

}  // namespace
}  // namespace sazare::geometry
