#pragma once

#include <utility>
#include <vector>

#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

/// The surface of a cube with a corner at the origin, outer sides out.
inline std::vector<Triangle> cube(Real side) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const Real at : {0.0, side}) {
      const Vector3 corner = at * Vector3::Unit(axis), u = side * Vector3::Unit((axis + 1) % 3),
                    v = side * Vector3::Unit((axis + 2) % 3);
      triangles.push_back({corner, corner + u, corner + u + v});
      triangles.push_back({corner, corner + u + v, corner + v});
      if (at == 0)
        for (Triangle* one : {&triangles[triangles.size() - 2], &triangles.back()}) std::swap((*one)[1], (*one)[2]);
    }
  return triangles;
}

}  // namespace sazare::geometry
