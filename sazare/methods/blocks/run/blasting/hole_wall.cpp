#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/cases/explanation.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

namespace {

/// Of both directions of an axis the one whose largest component is positive.
Vector3 directed(const Vector3& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vector3(-axis) : axis;
}

}  // namespace

Real width_around(const Vector3& axis, const std::array<Vector3, 3>& corners) {
  const Vector3 around = axis.cross(area_vector(corners)).normalized();
  const auto [least, most] = std::minmax({corners[0].dot(around), corners[1].dot(around), corners[2].dot(around)});
  return most - least;
}

HoleWall measure_wall(const geometry::TetraMesh& mesh, const std::vector<geometry::OuterFace>& faces) {
  constexpr Real cylinder = 0.02;  // largest mean square of the axial part of the normals
  HoleWall wall;
  Matrix3 normals = Matrix3::Zero();
  Vector3 centre = Vector3::Zero();
  for (const auto& face : faces) {
    const auto corners = face_corners(mesh, face.nodes);
    const Vector3 area = area_vector(corners);
    wall.area += area.norm();
    wall.open += area;
    normals += area * area.normalized().transpose();
    centre += area.norm() * (corners[0] + corners[1] + corners[2]) / 3;
  }
  centre /= wall.area;
  const Eigen::SelfAdjointEigenSolver<Matrix3> spread(normals / wall.area);
  const bool has_axis = spread.eigenvalues()[0] < cylinder;
  if (has_axis) wall.axis = directed(spread.eigenvectors().col(0));
  Real low = 0, high = 0, widths = 0;
  for (const auto& face : faces) {
    const auto corners = face_corners(mesh, face.nodes);
    const Vector3 area = area_vector(corners);
    for (const Vector3& corner : corners) {
      const Real along = (corner - centre).dot(wall.axis);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    widths += width_around(wall.axis, corners);
    const Vector3 radius = (corners[0] + corners[1] + corners[2]) / 3 - centre;
    wall.volume -= (radius - radius.dot(wall.axis) * wall.axis).dot(area) / (has_axis ? 2 : 3);
  }
  wall.first = centre + low * wall.axis;
  wall.last = centre + high * wall.axis;
  wall.length = high - low;
  wall.diameter =
      has_axis ? std::sqrt(4 * wall.volume / (std::numbers::pi * wall.length)) : std::cbrt(6 * wall.volume / std::numbers::pi);
  wall.width = widths / static_cast<Real>(faces.size());
  return wall;
}

std::string size_text(const HoleWall& wall) {
  using cases::number;
  if (!wall.has_axis()) return number(wall.diameter) + " m across, no cylinder";
  const Real around = wall.around();
  return fmt::format("{} m across, {} m long, about {:.0f} faces around{}", number(wall.diameter), number(wall.length), around,
                     around < HoleWall::few_faces ? ", which are few for a round hole" : "");
}

}  // namespace sazare::runs
