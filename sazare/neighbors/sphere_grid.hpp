#pragma once

/// Finds which bounding spheres may come near a place. Spheres of any size: each stands in a grid whose cells are as wide
/// as the sphere or up to twice that; grids of several widths are searched together.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::neighbors {

class SphereGrid {
public:
  /// Puts an item at a place, from wherever it was.
  void place(Index item, const Vector3& centre, Real radius);
  void remove(Index item);

  /// Calls visit(item) for every item whose sphere may reach within `radius` of `centre`, in no order to rely on.
  template <class Visit>
  void visit_near(const Vector3& centre, Real radius, Visit&& visit) const {
    for (const auto& [width, items] : widths_) {
      const Real cell = std::ldexp(1.0, width), reach = radius + 0.5 * cell;
      const Vector3 from = ((centre.array() - reach) / cell).floor(), to = ((centre.array() + reach) / cell).floor();
      for (auto x = static_cast<std::int64_t>(from.x()); x <= static_cast<std::int64_t>(to.x()); ++x)
        for (auto y = static_cast<std::int64_t>(from.y()); y <= static_cast<std::int64_t>(to.y()); ++y)
          for (auto z = static_cast<std::int64_t>(from.z()); z <= static_cast<std::int64_t>(to.z()); ++z)
            if (const auto found = cells_.find({width, x, y, z}); found != cells_.end())
              for (const Index item : found->second) visit(item);
    }
  }

private:
  struct Cell {
    int width = 0;  ///< exponent of two of the cell's edge
    std::int64_t x = 0, y = 0, z = 0;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };

  std::unordered_map<Cell, std::vector<Index>, Hash> cells_;
  std::unordered_map<int, int> widths_;  ///< how many items stand in cells of a width
  std::vector<Cell> cell_of_;
  std::vector<bool> placed_;
};

}  // namespace sazare::neighbors
