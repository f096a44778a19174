#include "validation/analytic/bar-wave-speed/bar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::validation {

namespace {

/// The triangles of an element that lie in one of the four sides of the bar.
void add_sides(geometry::TetraMesh& mesh, const std::array<std::int32_t, 4>& element) {
  for (const auto& face : geometry::tetrahedron_faces) {
    std::array<std::int32_t, 3> nodes{};
    for (std::size_t i = 0; i < 3; ++i) nodes[i] = element[static_cast<std::size_t>(face[i])];
    for (const int axis : {1, 2})
      for (const Real side : {-cube_size, cube_size})
        if (std::ranges::all_of(nodes, [&](auto node) { return mesh.nodes[static_cast<std::size_t>(node)][axis] == side; }))
          mesh.surfaces.front().triangles.push_back(nodes);
  }
}

}  // namespace

geometry::TetraMesh bar_mesh() {
  geometry::TetraMesh mesh;
  const auto node = [](int i, int j, int k) { return 9 * i + 3 * j + k; };
  for (int i = 0; i <= cubes_along; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) mesh.nodes.push_back(cube_size * Vector3(i, j - 1, k - 1));
  // The regular tetrahedron stands on four corners of the cube, no two of them on an edge; the other four cut the rest.
  constexpr std::array<std::array<std::array<int, 3>, 4>, 5> blocks = {{{{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}},
                                                                        {{{1, 0, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 1}}},
                                                                        {{{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 1}}},
                                                                        {{{0, 0, 1}, {0, 0, 0}, {1, 0, 1}, {0, 1, 1}}},
                                                                        {{{1, 1, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}}}};
  for (int i = 0; i < cubes_along; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (const auto& block : blocks) {
          const bool mirrored = (i + j + k) % 2 != 0;
          std::array<std::int32_t, 4> nodes{};
          for (std::size_t c = 0; c < 4; ++c)
            nodes[c] = node(i + (mirrored ? 1 - block[c][0] : block[c][0]), j + block[c][1], k + block[c][2]);
          mesh.tetrahedra.push_back(nodes);
          const auto corners = geometry::corners_of(mesh, static_cast<std::int32_t>(mesh.tetrahedra.size()) - 1);
          if (geometry::volume(corners) < 0) std::swap(mesh.tetrahedra.back()[1], mesh.tetrahedra.back()[2]);
          mesh.region.push_back(0);
        }
  mesh.region_names = {"bar"};
  mesh.surfaces = {{"sides", {}}};
  for (const auto& element : mesh.tetrahedra) add_sides(mesh, element);
  return mesh;
}

cases::BlocksCase bar_case(Sides sides) {
  cases::BlocksCase blocks;
  blocks.materials = {{"concrete", {"bar"}, 2390.0}};
  cases::Joint joint;
  joint.name = "concrete";
  joint.between = {"concrete", "concrete"};
  joint.normal_stiffness = 450e9;
  joint.shear_stiffness = 90e9;
  joint.cohesion = joint.tensile_strength = 1e9;
  joint.fracture_energy = 1e7;
  blocks.joints = {joint};
  if (sides == Sides::confined) blocks.boundaries = {{"sides", cases::BoundaryKind::frictionless}};
  blocks.contact.normal_stiffness = 1.5e9;
  blocks.time.history_interval = 1e-6;
  return blocks;
}

}  // namespace sazare::validation
