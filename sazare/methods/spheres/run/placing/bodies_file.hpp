#pragma once

/// Files of rigid bodies: what they are and how they move, and the spheres that they touch others with.

#include <filesystem>
#include <vector>

#include "sazare/geometry/ball_union.hpp"

namespace sazare::runs {

struct FileBody {
  Real volume = 0;                     ///< [m3]
  Vector3 centre = Vector3::Zero();    ///< of mass [m]
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
  Vector3 spin = Vector3::Zero();      ///< [rad/s]
  Matrix3 inertia = Matrix3::Zero();   ///< about the centre of mass, over the density [m5]
  std::vector<geometry::Ball> balls;   ///< in space [m]
};

/// Bodies in the order of their file. Throws UserError with the line where a row is none, a body stands twice, has no volume, an
/// inertia that no body has, or no sphere, or where a sphere is of no body.
std::vector<FileBody> read_bodies(const std::filesystem::path& bodies, const std::filesystem::path& spheres);

}  // namespace sazare::runs
