#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <tuple>

#include "sazare/core/error.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/geometry/gmsh/reader.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {
namespace {

const char* const slab_file = "cases/free-face-blast/slab.msh";

/// A block of n x n x n cubes, each of six tetrahedra around its diagonal.
TetraMesh block(int n) {
  TetraMesh mesh;
  const auto node = [&](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };
  for (int z = 0; z <= n; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) mesh.nodes.emplace_back(x, y, z);
    }
  }
  constexpr std::array<std::array<int, 3>, 6> orders = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        for (const auto& order : orders) {
          std::array<int, 3> at = {x, y, z};
          std::array<std::int32_t, 4> corners{};
          corners[0] = node(at[0], at[1], at[2]);
          for (std::size_t i = 0; i < 3; ++i) {
            ++at[static_cast<std::size_t>(order[i])];
            corners[i + 1] = node(at[0], at[1], at[2]);
          }
          mesh.tetrahedra.push_back(corners);
          const auto element = static_cast<std::int32_t>(mesh.tetrahedra.size() - 1);
          if (volume(corners_of(mesh, element)) < 0) std::swap(mesh.tetrahedra.back()[2], mesh.tetrahedra.back()[3]);
        }
      }
    }
  }
  mesh.region.assign(mesh.tetrahedra.size(), 0);
  mesh.region_names = {"rock"};
  return mesh;
}

TEST(face_map, slab_has_the_known_numbers_of_faces) {
  const TetraMesh mesh = read_gmsh(slab_file, 1);
  const FaceMap faces = build_face_map(mesh);
  EXPECT_EQ(faces.interior.size(), 1754u);
  EXPECT_EQ(faces.outer.size(), 4 * 1039u - 2 * 1754u);
}

TEST(face_map, agrees_with_a_plain_search) {
  const TetraMesh mesh = read_gmsh(slab_file, 1);
  std::map<std::array<std::int32_t, 3>, std::vector<std::pair<int, int>>> plain;
  for (std::size_t element = 0; element < mesh.tetrahedra.size(); ++element) {
    for (int face = 0; face < 4; ++face) {
      std::array<std::int32_t, 3> key{};
      std::size_t count = 0;
      for (int corner = 0; corner < 4; ++corner) {
        if (corner != face) key[count++] = mesh.tetrahedra[element][static_cast<std::size_t>(corner)];
      }
      std::sort(key.begin(), key.end());
      plain[key].emplace_back(static_cast<int>(element), face);
    }
  }
  std::set<std::array<int, 4>> expected;
  std::set<std::pair<int, int>> expected_outer;
  for (const auto& [key, sides] : plain) {
    if (sides.size() == 2) expected.insert({sides[0].first, sides[1].first, sides[0].second, sides[1].second});
    if (sides.size() == 1) expected_outer.insert(sides[0]);
  }
  const FaceMap faces = build_face_map(mesh);
  std::set<std::array<int, 4>> found;
  std::set<std::pair<int, int>> found_outer;
  for (const auto& face : faces.interior) found.insert({face.element_i, face.element_j, face.face_i, face.face_j});
  for (const auto& face : faces.outer) found_outer.emplace(face.element, face.face);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found_outer, expected_outer);
}

TEST(face_map, nodes_are_counter_clockwise_from_outside_of_the_first_element) {
  const TetraMesh mesh = block(2);
  for (const auto& face : build_face_map(mesh).interior) {
    ASSERT_LT(face.element_i, face.element_j);
    const auto at = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(face.nodes[i])]; };
    const Vector3 normal = (at(1) - at(0)).cross(at(2) - at(0));
    EXPECT_GT(normal.dot(centroid(corners_of(mesh, face.element_j)) - centroid(corners_of(mesh, face.element_i))), 0);
    for (const auto& [element, local] : {std::pair(face.element_i, face.face_i), {face.element_j, face.face_j}}) {
      const auto& corners = mesh.tetrahedra[static_cast<std::size_t>(element)];
      const std::int32_t opposite = corners[static_cast<std::size_t>(local)];
      EXPECT_EQ(std::count(face.nodes.begin(), face.nodes.end(), opposite), 0);
      for (const std::int32_t node : face.nodes) EXPECT_EQ(std::count(corners.begin(), corners.end(), node), 1);
    }
  }
}

TEST(face_map, outer_faces_bound_the_volume) {
  const TetraMesh mesh = block(3);
  const FaceMap faces = build_face_map(mesh);
  EXPECT_EQ(faces.outer.size(), 6u * 9 * 2);
  Real by_divergence = 0;
  for (const auto& face : faces.outer) {
    const auto at = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(face.nodes[i])]; };
    by_divergence += at(0).dot((at(1) - at(0)).cross(at(2) - at(0))) / 6;
  }
  EXPECT_NEAR(by_divergence, 27, 1e-12);
}

TEST(face_map, lists_are_in_order_of_elements_and_faces) {
  const FaceMap faces = build_face_map(block(2));
  const auto interior = [](const InteriorFace& a, const InteriorFace& b) {
    return std::tie(a.element_i, a.face_i) < std::tie(b.element_i, b.face_i);
  };
  const auto outer = [](const OuterFace& a, const OuterFace& b) {
    return std::tie(a.element, a.face) < std::tie(b.element, b.face);
  };
  EXPECT_TRUE(std::is_sorted(faces.interior.begin(), faces.interior.end(), interior));
  EXPECT_TRUE(std::is_sorted(faces.outer.begin(), faces.outer.end(), outer));
}

TEST(face_map, cost_grows_with_the_number_of_elements) {
  const auto seconds = [](const TetraMesh& mesh) {
    double best = 1e9;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      EXPECT_FALSE(build_face_map(mesh).interior.empty());
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
  };
  const double small = seconds(block(8));   // 3 072 elements
  const double large = seconds(block(32));  // 196 608 elements
  EXPECT_LT(large, 64 * 8 * small);         // a search of all pairs would take 64 times longer than this ratio of 64
}

TEST(face_map, face_of_three_elements_is_refused) {
  TetraMesh mesh = block(1);
  mesh.tags = {11, 12, 13, 14, 15, 16, 17};
  mesh.nodes.emplace_back(9, 9, 9);
  const FaceMap faces = build_face_map(mesh);
  const auto& nodes = faces.interior.front().nodes;
  mesh.tetrahedra.push_back({nodes[0], nodes[1], nodes[2], 8});
  try {
    build_face_map(mesh);
    FAIL() << "a third element on a face was accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("and 17 share one face"), std::string::npos) << error.what();
  }
}

TEST(face_map, surface_groups_find_their_faces) {
  const TetraMesh mesh = read_gmsh(slab_file, 1);
  const FaceMap faces = build_face_map(mesh);
  const auto surfaces = find_surface_faces(mesh, faces);
  ASSERT_EQ(surfaces.size(), mesh.surfaces.size());
  std::size_t outer = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    EXPECT_TRUE(surfaces[i].interior.empty()) << mesh.surfaces[i].name;
    EXPECT_EQ(surfaces[i].outer.size(), mesh.surfaces[i].triangles.size()) << mesh.surfaces[i].name;
    outer += surfaces[i].outer.size();
  }
  EXPECT_EQ(outer, faces.outer.size());  // the slab's groups cover its whole boundary
}

TEST(face_map, surface_inside_the_body_finds_interior_faces) {
  TetraMesh mesh = block(2);
  TetraMesh::Surface middle{"fault", {}};
  const FaceMap faces = build_face_map(mesh);
  std::vector<std::int32_t> expected;
  for (std::size_t i = 0; i < faces.interior.size(); ++i) {
    auto nodes = faces.interior[i].nodes;
    const bool in_plane = std::all_of(nodes.begin(), nodes.end(),
                                      [&](std::int32_t node) { return mesh.nodes[static_cast<std::size_t>(node)].x() == 1; });
    if (!in_plane) continue;
    expected.push_back(static_cast<std::int32_t>(i));
    std::swap(nodes[0], nodes[2]);  // any order of the nodes will do
    middle.triangles.push_back(nodes);
    middle.triangles.push_back({nodes[1], nodes[2], nodes[0]});  // and a triangle may be there twice
  }
  ASSERT_EQ(expected.size(), 8u);
  mesh.surfaces = {middle};
  const auto found = find_surface_faces(mesh, faces);
  EXPECT_EQ(found[0].interior, expected);
  EXPECT_TRUE(found[0].outer.empty());
}

TEST(face_map, triangle_on_no_face_is_refused) {
  TetraMesh mesh = block(2);
  mesh.surfaces = {{"stray", {{0, 1, 26}}}};
  const FaceMap faces = build_face_map(mesh);
  try {
    find_surface_faces(mesh, faces);
    FAIL() << "a stray triangle was accepted";
  } catch (const UserError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("surface group 'stray'"), std::string::npos) << words;
    EXPECT_NE(words.find("(1, 0.666667, 0.666667)"), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace sazare::geometry
