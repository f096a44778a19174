#pragma once

/// Boxes of cubes of six blocks each, for tests of bodies that touch.

#include <array>
#include <functional>
#include <string>

#include "sazare/core/time.hpp"
#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::test {

struct BoxOfBlocks {
  std::string region;
  Vector3 corner = Vector3::Zero();  ///< the lowest one [m]
  std::array<int, 3> cubes{1, 1, 1};
  Real size = 0.1;  ///< of a cube [m]
};

/// Adds a box with nodes of its own; `move` shifts them [m].
inline void add_box(
    geometry::TetraMesh& mesh, const BoxOfBlocks& box,
    const std::function<Vector3(const Vector3&)>& move = [](const Vector3&) { return Vector3(0, 0, 0); }) {
  const auto first = static_cast<Index>(mesh.nodes.size());
  const auto& [nx, ny, nz] = box.cubes;
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j)
      for (int k = 0; k <= nz; ++k) {
        const Vector3 place = box.corner + box.size * Vector3(i, j, k);
        mesh.nodes.push_back(place + move(place));
      }
  const auto node = [&](int i, int j, int k) { return first + ((i * (box.cubes[1] + 1)) + j) * (box.cubes[2] + 1) + k; };
  // Six blocks about the long diagonal: between them, a walk round the other six corners.
  constexpr std::array<std::array<int, 3>, 6> round = {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}}};
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        for (std::size_t side = 0; side < 6; ++side) {
          const auto &a = round[side], &b = round[(side + 1) % 6];
          mesh.tetrahedra.push_back(
              {node(i, j, k), node(i + a[0], j + a[1], k + a[2]), node(i + b[0], j + b[1], k + b[2]), node(i + 1, j + 1, k + 1)});
          mesh.region.push_back(static_cast<Index>(mesh.region_names.size()));
        }
  mesh.region_names.push_back(box.region);
}

}  // namespace sazare::test
