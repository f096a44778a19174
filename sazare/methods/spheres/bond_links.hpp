#pragma once

/// The bonds of one time level in columns that lanes read, by the tile of the first sphere.

#include <span>
#include <vector>

#include "sazare/laws/sphere_bond.hpp"
#include "sazare/methods/spheres/load_table.hpp"

namespace sazare::methods::spheres {

/// A bond between two spheres by their numbers, and what has become of it.
struct Bond {
  Index first = 0, second = 0;
  Index kind = 0;   ///< whose strength it has
  Index gone = 0;   ///< 1 when it is broken and no longer laid out
  Real radius = 0;  ///< [m]
  laws::BondStiffness<Real> stiffness;
  laws::BondDamping<Real> damping;
  Vector3 direction = Vector3::Zero();  ///< from the first to the second at the start
  Real largest_use = 0;                 ///< so far
  Real energy_before = 0;               ///< what damage may take, at the last evaluation [J]
};

/// A bond that has just broken: its place among the links, and the overlap beyond which alone its spheres push each other [m].
struct BrokenLink {
  std::size_t link = 0;
  Real allowed_overlap = 0;
};

/// A tile's bonds are filled up to whole lanes by bonds that do nothing. Columns by link but for the last.
struct BondLinks {
  static constexpr Index filler = -1;

  TileLinks ends;                   ///< second spheres, by place
  std::vector<Index> first;         ///< spheres, by place
  std::vector<Index> kind, source;  ///< `source`: number of the bond, or `filler`
  std::vector<Real> length, stretch, shear, bend, twist, direction_x, direction_y, direction_z;
  std::vector<Real> radius, largest_use, energy_before;  ///< where bonds break
  std::vector<Real> along, across, turning;              ///< where they have dashpots
  std::vector<std::vector<BrokenLink>> broken;           ///< by tile, at the last evaluation

  /// Which of the columns are filled.
  struct Traits {
    bool breaks = false, damped = false;
  };

  /// A bond by the places of its spheres.
  struct Placed {
    Index first = 0, second = 0, bond = 0;
  };

  /// Lays out the bonds `placed`, which are sorted, for so many tiles of spheres.
  void lay_out(std::span<const Placed> placed, const std::vector<Bond>& bonds, const Traits& traits, std::size_t tiles);

private:
  void append(const Placed& at, const Bond& bond, const Traits& traits, bool is_filler);
};

}  // namespace sazare::methods::spheres
