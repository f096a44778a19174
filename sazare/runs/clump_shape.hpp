#pragma once

/// Shapes of a case as balls about their centres of mass, along their principal axes.

#include "sazare/cases/case_file.hpp"
#include "sazare/geometry/ball_members.hpp"

namespace sazare::runs {

/// A body of density 1.
struct Shape {
  std::vector<geometry::Ball> balls;   ///< by its principal axes
  Matrix3 axes = Matrix3::Identity();  ///< its principal axes, as columns, as its file or its legs have them
  Real volume = 0;                     ///< of the union of its balls [m3]
  Vector3 inertia = Vector3::Zero();   ///< about its principal axes [m5]
  Real error = 0;                      ///< of volume and inertia, relative, estimated
  Real reach = 0;                      ///< of its farthest point from the centre of mass [m]

  /// Of bonded balls; empty for a rigid body.
  std::vector<geometry::MassShare> shares;
  Real share_error = 0;                             ///< what their inertia together lacks of the body's, relative
  std::vector<std::pair<Index, Index>> neighbours;  ///< which are bonded
  Index bonds = -1;                                 ///< entry of [[bonds]]
};

/// Throws UserError when a shape has no ball, its surface has holes, or its balls are to be bonded and do not hang together.
Shape make_shape(const cases::CaseFile& file, std::size_t shape);

/// Rows of radius, x, y, z of a file. Throws UserError with the line that is none.
std::vector<geometry::Ball> read_balls(const std::filesystem::path& file);

/// Rows of `count` numbers of a file; blank lines and those that begin with a letter or # are skipped.
std::vector<std::vector<Real>> read_rows(const std::filesystem::path& file, std::size_t count, const std::string& expected);

}  // namespace sazare::runs
