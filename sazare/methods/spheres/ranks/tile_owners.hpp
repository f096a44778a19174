#pragma once

/// Which of several ranks works for which tiles of spheres. Every rank knows all owners.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::methods::spheres {

class TileOwners {
public:
  explicit TileOwners(int rank) : rank_(rank) {}

  /// `owner` is by tile.
  void take(std::vector<int> owner) {
    owner_ = std::move(owner);
    own_.clear();
    is_own_.assign(owner_.size(), 0);
    for (std::size_t tile = 0; tile < owner_.size(); ++tile) {
      if (owner_[tile] != rank_) continue;
      own_.push_back(tile);
      is_own_[tile] = 1;
    }
  }

  std::size_t tiles() const { return owner_.size(); }
  int owner(std::size_t tile) const { return owner_[tile]; }
  bool owns(std::size_t tile) const { return is_own_[tile] != 0; }
  int owner_of_sphere(Index place) const { return owner_[static_cast<std::size_t>(place) / neighbors::tile_size]; }
  /// The tiles of this rank, in order.
  const std::vector<std::size_t>& own() const { return own_; }
  /// By tile: whether it is one of this rank.
  const std::vector<std::uint8_t>& is_own() const { return is_own_; }

private:
  int rank_;
  std::vector<int> owner_;
  std::vector<std::size_t> own_;
  std::vector<std::uint8_t> is_own_;
};

}  // namespace sazare::methods::spheres
