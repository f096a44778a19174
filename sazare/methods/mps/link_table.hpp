#pragma once

/// Which particles of a lattice are linked, by direction: the n-th direction of every particle has the same r0, so what a link
/// is at the beginning is known from its direction alone.

#include <cstdint>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/laws/particle_link.hpp"

namespace sazare::methods::mps {

/// Place of a particle on the lattice.
template <int D>
using Site = std::array<int, D>;

template <int D>
struct LinkTable {
  /// One direction of the lattice. Directions stand so that the opposite of the n-th from the front is the n-th from the back.
  struct Direction {
    Site<D> offset{};
    laws::LinkDirection<D> law;
    std::vector<Index> neighbor;        ///< by particle, padded; the particle itself where there is none
    std::vector<std::uint8_t> present;  ///< by block of `lane_count` particles: bit of each lane whose neighbour is there
    std::vector<Index> first;           ///< by block: first of neighbours that stand in a row; -1 where they do not
  };

  std::vector<Direction> directions;
  Real number_density = 0;  ///< n0 of an inner particle [-]

  std::size_t opposite(std::size_t direction) const { return directions.size() - 1 - direction; }
  bool is_present(std::size_t direction, Index particle) const {
    return (directions[direction].present[static_cast<std::size_t>(particle / lane_count)] >> (particle % lane_count) & 1) != 0;
  }
};

/// Links of particles at these sites. `influence` is the influence radius over the spacing; a `period` of an axis, in spacings, links
/// both ends of the body along it (0: none).
template <int D>
LinkTable<D> make_links(std::span<const Site<D>> sites, Real spacing, Real influence, const Site<D>& period = {});

extern template LinkTable<2> make_links<2>(std::span<const Site<2>>, Real, Real, const Site<2>&);
extern template LinkTable<3> make_links<3>(std::span<const Site<3>>, Real, Real, const Site<3>&);

}  // namespace sazare::methods::mps
