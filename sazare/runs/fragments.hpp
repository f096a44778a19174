#pragma once

/// Fragments: elements that still hang together by joints, or spheres by bonds, that hold.

#include <filesystem>
#include <span>
#include <vector>

#include "sazare/engine/simulation.hpp"
#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/joints.hpp"

namespace sazare::runs {

/// Which fragment every element belongs to; fragments are numbered by their first element.
struct FragmentMap {
  Index count = 0;
  std::vector<Index> of_element;
};

FragmentMap find_fragments(Index elements, const methods::blocks::Joints& joints);

struct Fragment {
  Index number = 0;  ///< its place in the map
  Index elements = 0;
  Real volume = 0;                     ///< [m3]
  Real mass = 0;                       ///< [kg]
  Real size = 0;                       ///< diameter of the sphere of the same volume [m]
  Vector3 center = Vector3::Zero();    ///< of mass [m]
  Vector3 velocity = Vector3::Zero();  ///< of the centre [m/s]
  Real throw_distance = 0;             ///< how far the centre has moved [m]
};

/// Fragments at a moment, largest volume first; equal ones in the order of their numbers.
std::vector<Fragment> measure_fragments(const FragmentMap& map, const geometry::TetraMesh& mesh, const state::Bodies<3>& bodies,
                                        const engine::Snapshot<3>& now);

/// Numbers fragments, of which elements, volume, mass, and mass times centre and velocity have been added up, and sorts them by
/// volume, the largest first. `moved`: mass times way [kg m].
void finish_fragments(std::vector<Fragment>& fragments, std::span<const Vector3> moved);

/// Writes fragments.csv.
void write_fragments(const std::filesystem::path& file, std::span<const Fragment> fragments);

/// The size [m] that a share of the volume (0..1) passes, on the cumulative curve: straight lines between the fragments'
/// sizes, each with the volume of all fragments up to it; below the smallest fragment its own size. 0 without fragments.
Real passing_size(std::span<const Fragment> largest_first, Real share);

}  // namespace sazare::runs
