#pragma once

/// Fragments: parts of a body that still hang together, as tables and figures tell of them.

#include <filesystem>
#include <span>
#include <vector>

#include "sazare/core/links.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::runs {

struct Fragment {
  Index number = 0;  ///< its place in the map
  Index elements = 0;
  Real volume = 0;                     ///< [m3]
  Real mass = 0;                       ///< [kg]
  Real size = 0;                       ///< diameter of the sphere of the same volume [m]
  Vector3 center = Vector3::Zero();    ///< of mass [m]
  Vector3 velocity = Vector3::Zero();  ///< of the centre [m/s]
  Real throw_distance = 0;             ///< how far the centre has moved [m]
  bool stays = false;                  ///< whether it remains in place, see block_fragments.hpp; no size distribution counts it
};

/// Numbers fragments, of which elements, volume, mass, and mass times centre and velocity have been added up, and sorts them by
/// volume, the largest first. `moved`: mass times way [kg m].
void finish_fragments(std::vector<Fragment>& fragments, std::span<const Vector3> moved);

/// Which columns fragments.csv has.
enum class FragmentTable { plain, with_stays };

/// Writes fragments.csv.
void write_fragments(const std::filesystem::path& file, std::span<const Fragment> fragments,
                     FragmentTable table = FragmentTable::plain);

/// The size [m] that a share of the mass (0..1) passes, on the cumulative curve: straight lines between the fragments'
/// sizes, each with the mass of all fragments up to it; below the smallest fragment its own size. Not a number without fragments.
Real passing_size(std::span<const Fragment> largest_first, Real share);

}  // namespace sazare::runs
