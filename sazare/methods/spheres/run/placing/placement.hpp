#pragma once

/// Puts the spheres of a case where its groups say.

#include <optional>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/state/clumps.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::runs {

/// Two spheres that are bonded, by their numbers.
struct BondedPair {
  Index first = 0, second = 0;
  Index entry = 0;  ///< of [[bonds]]
};

/// The body of a shape, and how much of its surface its spheres fill, by volume, where it is of a surface.
struct ShapeVolume {
  std::string shape;
  Real volume = 0;  ///< [m3]
  std::optional<Real> fill;
};

struct Placement {
  state::Spheres spheres;
  std::vector<Index> group;  ///< by number of the sphere
  std::vector<Index> body;   ///< by number of the sphere: its clump, below 0 where none
  state::Clumps clumps;
  std::vector<Index> bonded_body;  ///< by number of the sphere: its body of bonded spheres, below 0 where none
  Index bonded_bodies = 0;
  Real share_error = 0;            ///< what their inertia lacks of that of their shapes, relative
  std::vector<BondedPair> bonded;  ///< by first sphere
  std::vector<ShapeVolume> shapes;  ///< that groups are of
};

/// Throws UserError when a file of spheres cannot be read, a group has no sphere, or more than this machine can hold, random
/// spheres find no room, a sphere is too large for a periodic axis, or spheres overlap by more than contact.overlap_limit that no
/// lasting bond joins.
Placement place_spheres(const cases::CaseFile& file);

/// How near two spheres must be to be kept as a pair [m].
Real search_margin(const cases::SpheresCase& spheres, const state::Spheres& placed);

}  // namespace sazare::runs
