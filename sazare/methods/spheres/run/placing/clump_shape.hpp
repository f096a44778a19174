#pragma once

/// Shapes of a case as balls about their centres of mass, along their principal axes.

#include <optional>

#include "sazare/cases/case_file.hpp"
#include "sazare/geometry/ball_members.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

/// A body of density 1.
struct Shape {
  std::vector<geometry::Ball> balls;   ///< by its principal axes
  Matrix3 axes = Matrix3::Identity();  ///< its principal axes, as columns, as its file or its legs have them
  Real volume = 0;                     ///< of the union of its balls, or of the solid that they fill [m3]
  Vector3 inertia = Vector3::Zero();   ///< about its principal axes [m5]
  Real error = 0;                      ///< of volume and inertia, relative, estimated
  std::optional<Real> fill;            ///< of balls in a surface: the volume of their union over its own
  Real reach = 0;                      ///< of its farthest point from the centre of mass [m]

  /// Shares of the mass that bonded balls have; empty for a rigid body.
  std::vector<geometry::MassShare> shares;
  Real share_error = 0;                             ///< what their inertia together lacks of the body's, relative
  std::vector<std::pair<Index, Index>> neighbours;  ///< which are bonded
  Index bonds = -1;                                 ///< entry of [[bonds]]
};

/// A shape whose balls stood in other axes, with its centre of mass there and its inertia about that [m; m5].
Shape along_principal_axes(Shape shape, const Vector3& centre, const Matrix3& inertia);

/// Throws UserError when a shape has no ball, its surface has holes or triangles that are turned inside out, or its balls do not
/// hang together: by bonds, or as a rigid body by touching.
Shape make_shape(const cases::CaseFile& file, std::size_t shape);

}  // namespace sazare::runs
