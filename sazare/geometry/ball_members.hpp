#pragma once

/// A body of balls that may overlap, taken apart: what each ball has of its mass, and which balls are neighbours.

#include <span>
#include <utility>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/geometry/ball_union.hpp"

namespace sazare::geometry {

/// Volumes of the parts into which the radical planes of balls cut their union: each point belongs to the ball whose power
/// (squared distance from its centre less its squared radius) is least there, so that nothing counts twice [Edelsbrunner1995].
/// Exact along `lines` by `lines` parallel lines [m3].
std::vector<Real> cell_volumes(std::span<const Ball> balls, int lines = 256);

/// What a ball has of a body of density 1.
struct MassShare {
  Real volume = 0;   ///< [m3]
  Real inertia = 0;  ///< about its own centre, about any axis [m5]
};

struct MassShares {
  std::vector<MassShare> of;  ///< by ball; empty where the masses that give the volume and its centre are not all positive
  Real error = 0;             ///< what the balls' inertia together lacks of the body's, relative
};

/// Shares out the volume and the principal inertia of a union among its balls, which stand about its centre of mass along its
/// principal axes, so that all of them together have the volume, its centre and its inertia: the volumes of the cells, changed
/// by as little as it takes, and inertias in proportion to volume and squared radius. Volume and centre come out exactly; so
/// does the inertia wherever positive shares can give it, which two balls alone cannot.
MassShares share_mass(std::span<const Ball> balls, Real volume, const Vector3& inertia);

/// Pairs of balls that touch, or whose gap is at most `reach` of the sum of their radii, and are neighbours: no third ball that
/// touches both has its centre in the sphere across theirs (Gabriel's graph of those that touch [Gabriel1969]). What hangs
/// together by touching hangs together by neighbours, since a pair that is left out goes by two shorter ones.
std::vector<std::pair<Index, Index>> neighbouring_balls(std::span<const Ball> balls, Real reach);

/// Which of so many balls hang together with the first one by these pairs.
std::vector<bool> joined_to_first(std::size_t balls, std::span<const std::pair<Index, Index>> pairs);

/// Whether all of them do.
bool hang_together(std::size_t balls, std::span<const std::pair<Index, Index>> pairs);

}  // namespace sazare::geometry
