#include "sazare/methods/blocks/run/water.hpp"

#include <algorithm>

namespace sazare::runs {

namespace {

/// By outer face of the mesh: whether nothing of the case stands on it.
std::vector<bool> find_free_outer(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  std::vector<bool> is_free(faces.map.outer.size(), true);
  for (std::size_t surface = 0; surface < faces.surfaces.size(); ++surface) {
    const auto stands_on = [&](const auto& entry) { return entry.surface == faces.mesh.surfaces[surface].name; };
    if (std::ranges::any_of(blocks.boundaries, stands_on) || std::ranges::any_of(blocks.blasts, stands_on) ||
        std::ranges::any_of(blocks.charges, stands_on))
      for (const Index face : faces.surfaces[surface].outer) is_free[at(face)] = false;
  }
  return is_free;
}

}  // namespace

std::unique_ptr<methods::blocks::WaterLoads> make_water(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                        const methods::blocks::BondedFaces& joints,
                                                        const state::Bodies<3>& bodies) {
  if (!blocks.water.is_there()) return nullptr;
  std::vector<methods::blocks::WettedFace> wetted;
  const std::vector<bool> is_free = find_free_outer(blocks, faces);
  for (std::size_t face = 0; face < is_free.size(); ++face)
    if (is_free[face]) wetted.push_back({faces.map.outer[face].element, faces.map.outer[face].face, -1, 0});
  for (const geometry::InteriorFace& shared : faces.map.interior) {
    wetted.push_back({shared.element_i, shared.face_i, shared.element_j, shared.face_j});
    wetted.push_back({shared.element_j, shared.face_j, shared.element_i, shared.face_i});
  }
  return std::make_unique<methods::blocks::WaterLoads>(
      cases::water_field(blocks.water, blocks.gravity), *blocks.water.drag_coefficient,
      geometry::ElementCorners{faces.mesh.nodes, faces.mesh.tetrahedra}, std::move(wetted), joints, bodies);
}

}  // namespace sazare::runs
