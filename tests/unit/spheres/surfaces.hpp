#pragma once

/// Surfaces of triangles for the tests.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "scene.hpp"

namespace sazare::methods::spheres {

inline constexpr Real degree = std::numbers::pi / 180;

using Shape = std::function<Vector3(int i, int j)>;

/// Triangles between nodes that are counted from -`cells` to `cells` both ways.
inline Wall surface(const Shape& node, int cells) {
  Wall wall;
  for (int i = -cells; i < cells; ++i)
    for (int j = -cells; j < cells; ++j) {
      const bool along = (i + j) % 2 == 0;  // diagonals both ways
      const Vector3 a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      wall.triangles.push_back(along ? geometry::Triangle{a, b, c} : geometry::Triangle{a, b, d});
      wall.triangles.push_back(along ? geometry::Triangle{a, c, d} : geometry::Triangle{b, c, d});
    }
  return wall;
}

/// Strips that go up and down by turns, so that their edges are concave and convex.
inline Shape zigzag(Real angle, Real facet) {
  return [=](int i, int j) -> Vector3 {
    return facet * Vector3(i * std::cos(0.5 * angle), j, std::abs(i % 2) * std::sin(0.5 * angle));
  };
}

/// A faceted trough, or below an angle of 0 a faceted ridge, whose lowest or highest facet is about the origin.
inline Shape trough(Real angle, Real facet) {
  return [=](int i, int j) -> Vector3 {
    Vector3 place(0, j * facet, 0);
    for (int n = 0; n < std::abs(i); ++n) {
      const Real slope = std::min(std::abs((n + 0.5) * angle), 60 * degree) * (angle < 0 ? -1 : 1);
      place += facet * Vector3(i < 0 ? -std::cos(slope) : std::cos(slope), 0, std::sin(slope));
    }
    return place;
  };
}

/// x^2 - y^2, or x^2 + y^2, with facets that are apart by about an angle from their neighbours.
inline Shape bent(Real angle, Real facet, Real other) {
  return [=](int i, int j) -> Vector3 { return facet * Vector3(i, j, 0.5 * angle * (i * i + other * j * j)); };
}

}  // namespace sazare::methods::spheres
