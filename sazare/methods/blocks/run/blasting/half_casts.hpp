#pragma once

/// Half-casts: holes whose half barrel is left on the rock that stays.

#include <filesystem>
#include <string>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::runs {

/// What is left of the wall of a hole, by length along its axis [m].
struct HalfCast {
  std::string surface;              ///< of the wall
  Vector3 first = Vector3::Zero();  ///< where the wall begins, on the axis [m]
  Vector3 last = Vector3::Zero();   ///< where it ends [m]
  Real half = 0;                    ///< where at least half of the wall around the axis stays
  Real whole = 0;                   ///< where all of it stays: the hole has not broken out
  Real standing = 0;                ///< mean share of the wall around the axis that stays

  Real length() const { return (last - first).norm(); }
};

/// The half-cast of every hole of a case: of each surface of charges, and of blasts where it closes around a hole with an axis.
/// `stays`: whether each element of the mesh belongs to rock that stays.
///
/// The wall is cut across the axis at 400 places. Half of it stays where the angle that its faces on rock that stays span around
/// the axis is at least half of the angle that all its faces span, less one face: no face can be parted, and a break along the
/// axis leaves one more or one less on either side.
std::vector<HalfCast> measure_half_casts(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                                         const std::vector<bool>& stays);

/// Length of half barrels over that of all holes; 0 without holes.
Real half_cast_factor(const std::vector<HalfCast>& casts);

/// Writes half_casts.csv, a row for every hole.
void write_half_casts(const std::filesystem::path& file, const std::vector<HalfCast>& casts);

}  // namespace sazare::runs
