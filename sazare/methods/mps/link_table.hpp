#pragma once

/// Which particles of a lattice are linked, by direction: the n-th direction of every particle has the same r0, so what a link
/// is at the beginning is known from its direction alone.

#include <cstdint>
#include <map>
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
    std::vector<Index> neighbor;  ///< by particle, padded; the particle itself where there is none
    std::vector<Index> pattern;   ///< by pack of `lane_count` particles: which of `patterns` its links have
    std::vector<Index> first;     ///< by pack: first of neighbours that stand in a row; -1 where they do not
  };

  /// Share of each link of a pack: 1, 0 where there is none, 1/2 where half of it lies beyond a boundary. The first has none.
  struct Pattern {
    std::array<Real, lane_count> share{};
    Lanes lanes{};
  };

  std::vector<Direction> directions;
  std::vector<Pattern> patterns;
  Real number_density = 0;  ///< n0 of an inner particle [-]

  std::size_t opposite(std::size_t direction) const { return directions.size() - 1 - direction; }
  Real share(std::size_t direction, Index particle) const {
    const Index pattern = directions[direction].pattern[static_cast<std::size_t>(particle / lane_count)];
    return patterns[static_cast<std::size_t>(pattern)].share[static_cast<std::size_t>(particle % lane_count)];
  }
  bool is_present(std::size_t direction, Index particle) const { return share(direction, particle) > 0; }

  /// Changes the share of a link on the side of this particle.
  void set_share(std::size_t direction, Index particle, Real share);

  /// Halves the links among these particles, which stand in a plane through their centres beyond which nothing counts.
  void halve_among(std::span<const Index> particles);

private:
  std::map<std::array<Real, lane_count>, Index> known_;
};

/// Links of particles at these sites. `influence` is the influence radius over the spacing; a `period` of an axis, in spacings,
/// links both ends of the body along it (0: none).
template <int D>
LinkTable<D> make_links(std::span<const Site<D>> sites, Real spacing, Real influence, const Site<D>& period = {});

extern template struct LinkTable<2>;
extern template struct LinkTable<3>;
extern template LinkTable<2> make_links<2>(std::span<const Site<2>>, Real, Real, const Site<2>&);
extern template LinkTable<3> make_links<3>(std::span<const Site<3>>, Real, Real, const Site<3>&);

}  // namespace sazare::methods::mps
