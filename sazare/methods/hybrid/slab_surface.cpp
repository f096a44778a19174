#include "sazare/methods/hybrid/slab_surface.hpp"

namespace sazare::methods::hybrid {

std::vector<std::array<Index, 3>> SlabSurface::triangles() const {
  std::vector<std::array<Index, 3>> triangles;
  const auto dimension = static_cast<std::size_t>(shape_.dimension);
  const auto nodes = static_cast<Index>(shape_.nodes.size() / dimension);
  for (std::size_t i = 0; i + dimension <= shape_.faces.size(); i += dimension) {
    const Index a = shape_.faces[i], b = shape_.faces[i + 1];
    if (!is_plane()) {
      triangles.push_back({a, b, shape_.faces[i + 2]});
      continue;
    }
    triangles.push_back({a, b + nodes, b});
    triangles.push_back({a, a + nodes, b + nodes});
  }
  return triangles;
}

std::vector<Vector3> SlabSurface::places(const std::vector<Real>& displacement) const {
  std::vector<Vector3> result;
  const auto dimension = static_cast<std::size_t>(shape_.dimension);
  for (const Real z : {low_, high_}) {
    for (std::size_t i = 0; i < displacement.size(); i += dimension) {
      Vector3 place(0, 0, z);
      for (std::size_t axis = 0; axis < dimension; ++axis)
        place[static_cast<int>(axis)] = shape_.nodes[i + axis] + displacement[i + axis];
      result.push_back(place);
    }
    if (!is_plane()) break;
  }
  return result;
}

std::vector<Real> SlabSurface::folded(const std::vector<Vector3>& forces, Real factor) const {
  std::vector<Real> result(shape_.nodes.size(), 0);
  const auto dimension = static_cast<std::size_t>(shape_.dimension);
  const std::size_t nodes = result.size() / dimension;
  for (std::size_t n = 0; n < forces.size(); ++n)
    for (std::size_t axis = 0; axis < dimension; ++axis)
      result[n % nodes * dimension + axis] += factor * forces[n][static_cast<int>(axis)];
  if (is_plane())
    for (Real& value : result) value /= shape_.width;
  return result;
}

}  // namespace sazare::methods::hybrid
