#pragma once

/// Numbered places by cells, for questions which of them are near another place.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sazare/core/saturated.hpp"
#include "sazare/core/time.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::geometry {

class PlaceCells {
public:
  /// Cells of this edge length [m]: as long as the largest distance that counts as near.
  explicit PlaceCells(Real cell_size = 1) : cell_size_(cell_size) {}

  void add(Index number, const Vector3& place) { cells_[cell_of(place)].push_back(number); }

  /// Calls visit(number) for all that may be nearer than a cell is long, in an order that the places alone decide.
  template <class Visit>
  void visit_near(const Vector3& place, Visit&& visit) const {
    const Cell middle = cell_of(place);
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z)
          if (const auto found = cells_.find({middle[0] + x, middle[1] + y, middle[2] + z}); found != cells_.end())
            for (const Index number : found->second) visit(number);
  }

private:
  static constexpr Real last_cell = 4e18;  // of 64-bit numbers, with room for one more
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t hash = 0;
      for (const std::int64_t part : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 29;
      }
      return static_cast<std::size_t>(hash);
    }
  };

  Cell cell_of(const Vector3& place) const {
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          saturated<std::int64_t>(std::clamp(std::floor(place[axis] / cell_size_), -last_cell, last_cell));
    return cell;
  }

  Real cell_size_;
  std::unordered_map<Cell, std::vector<Index>, Hash> cells_;
};

}  // namespace sazare::geometry
