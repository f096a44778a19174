#pragma once

/// Shapes of the elements of method rectangles, as columns beside their motion in Particles<2>: rectangles, polygons and circles
/// that move, and the supports after them, walls and circles that stand or are moved.

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "sazare/geometry/plane/outline_contact.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::state {

struct Outlines {
  std::vector<geometry::OutlineKind> kind;
  Column half_width, half_height;                       ///< [m]; of a circle its radius
  std::vector<geometry::Faces> exposed;                 ///< faces that no joined neighbour covers
  std::vector<Index> block;                             ///< of which it is a part; -1 for supports
  std::vector<geometry::Vector2> corners;               ///< of all polygons, see geometry::Outline [m]
  std::vector<std::array<std::size_t, 2>> own_corners;  ///< by element: where its own begin and end

  std::size_t size() const { return kind.size(); }

  void add(geometry::OutlineKind of_kind, Real width, Real height, Index of_block) {
    kind.push_back(of_kind);
    half_width.push_back(width);
    half_height.push_back(height);
    exposed.push_back(geometry::all_faces);
    block.push_back(of_block);
    own_corners.push_back({corners.size(), corners.size()});
  }

  /// A convex polygon by its corners from its centre, in its own axes; `faces` are those on the outside of its block.
  void add_polygon(std::span<const geometry::Vector2> own, geometry::Faces faces, Index of_block) {
    const Real half = 0.5 * std::sqrt(geometry::measure(own).area);
    add(geometry::OutlineKind::polygon, half, half, of_block);
    exposed.back() = faces;
    corners.insert(corners.end(), own.begin(), own.end());
    own_corners.back()[1] = corners.size();
  }

  std::span<const geometry::Vector2> corners_of(std::size_t i) const {
    return std::span(corners).subspan(own_corners[i][0], own_corners[i][1] - own_corners[i][0]);
  }

  geometry::Outline at(const Particles<2>& particles, std::size_t i) const {
    return {kind[i],
            exposed[i],
            {particles.position(0, i), particles.position(1, i)},
            {particles.rotation[0][i], particles.rotation[1][i]},
            half_width[i],
            half_height[i],
            corners_of(i)};
  }

  /// Half of the side of the square of equal area, the radius of a circle, 0 of a wall [m]: the r of the springs.
  Real spring_radius(std::size_t i) const {
    return kind[i] == geometry::OutlineKind::wall ? 0 : std::sqrt(half_width[i] * half_height[i]);
  }

  /// Mass of an element of this thickness [kg]; (17), (18).
  Real mass(std::size_t i, Real density, Real thickness) const {
    const Real area = half_width[i] * half_height[i];
    return density * thickness * area * (kind[i] == geometry::OutlineKind::circle ? std::numbers::pi : 4);
  }

  /// Moment of inertia over mass [m2]; (17), (18).
  Real gyration_square(std::size_t i) const {
    if (kind[i] == geometry::OutlineKind::polygon) {
      const geometry::PolygonMeasures found = geometry::measure(corners_of(i));
      return found.second_moment / found.area;
    }
    const Real square = half_width[i] * half_width[i] + half_height[i] * half_height[i];
    return kind[i] == geometry::OutlineKind::circle ? square / 4 : square / 3;
  }
};

}  // namespace sazare::state
