#pragma once

/// Bodies made of balls that may overlap: their mass properties, and balls that fill a shape.

#include <span>
#include <vector>

#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

struct Ball {
  Vector3 centre = Vector3::Zero();  ///< [m]
  Real radius = 0;                   ///< [m]
};

/// Mass properties of a body of density 1.
struct UnionProperties {
  Real volume = 0;                    ///< [m3]
  Vector3 centre = Vector3::Zero();   ///< [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about the centre [m5]
  Real error = 0;                     ///< estimated, of the volume and of the inertia, relative; 0 where they are exact
};

/// Volume, centre and inertia of the union of balls, none of it counted twice: exact along lines parallel to z, of which `lines`
/// by `lines` stand in a square grid; the error is that against half as many by half as many.
UnionProperties properties_of_union(std::span<const Ball> balls, int lines = 512);

/// Balls in a tetrapod of a height [m], its centre at the origin, one leg upright: one ball at the centre and `per_leg` along
/// each leg, whose surfaces touch that of the leg; the outermost ones reach its end.
///
/// The legs are truncated cones: ends of 0.302 of the height in diameter, 0.644 of it from the centre, so that the three lower
/// legs stand a height below the end of the upper one. They taper from 0.530 at the centre, which gives the usual volume of
/// 0.280 height^3.
std::vector<Ball> tetrapod_balls(Real height, int per_leg);

/// Balls inside a closed surface, the largest first: each takes the place, on a grid of `cells` along the longest side, where
/// the largest ball fits that adds to what is filled. At most `count`.
std::vector<Ball> fill_with_balls(std::span<const Triangle> surface, int count, int cells = 48);

}  // namespace sazare::geometry
