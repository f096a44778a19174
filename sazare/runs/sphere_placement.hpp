#pragma once

/// Puts the spheres of a case where its groups say.

#include "sazare/cases/case_file.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::runs {

struct Placement {
  state::Spheres spheres;
  std::vector<Index> group;  ///< by number of the sphere
};

/// Throws UserError when a file of spheres cannot be read, a group has no sphere, random spheres find no room, a sphere is too
/// large for a periodic axis, or spheres overlap by more than contact.overlap_limit.
Placement place_spheres(const cases::CaseFile& file);

/// How near two spheres must be to be kept as a pair [m].
Real search_margin(const cases::SpheresCase& spheres, const state::Spheres& placed);

}  // namespace sazare::runs
