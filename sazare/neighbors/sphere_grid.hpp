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
    for (const auto& [width, cells] : widths_) {
      const Real edge = std::ldexp(1.0, width), reach = radius + 0.5 * edge;
      const Cell from = cell_at((centre.array() - reach) / edge), to = cell_at((centre.array() + reach) / edge);
      if (walk_is_longer(from, to, cells.size()))
        visit_filled(cells, from, to, visit);
      else
        visit_walking(cells, from, to, visit);
    }
  }

private:
  struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  using Cells = std::unordered_map<Cell, std::vector<Index>, Hash>;  ///< of one width; none is empty

  /// The cell of a place over the width; what lies beyond all numbers stands in the last ones.
  static Cell cell_at(const Vector3& place);

  /// Whether there are more cells between two than are filled: near one that is large against the width.
  static bool walk_is_longer(const Cell& from, const Cell& to, std::size_t filled) {
    const auto count = [](std::int64_t a, std::int64_t b) { return static_cast<Real>(b) - static_cast<Real>(a) + 1; };
    return count(from.x, to.x) * count(from.y, to.y) * count(from.z, to.z) > static_cast<Real>(filled);
  }

  template <class Visit>
  static void visit_filled(const Cells& cells, const Cell& from, const Cell& to, Visit& visit) {
    for (const auto& [cell, items] : cells)
      if (cell.x >= from.x && cell.x <= to.x && cell.y >= from.y && cell.y <= to.y && cell.z >= from.z && cell.z <= to.z)
        for (const Index item : items) visit(item);
  }

  template <class Visit>
  static void visit_walking(const Cells& cells, const Cell& from, const Cell& to, Visit& visit) {
    for (std::int64_t x = from.x; x <= to.x; ++x)
      for (std::int64_t y = from.y; y <= to.y; ++y)
        for (std::int64_t z = from.z; z <= to.z; ++z)
          if (const auto found = cells.find({x, y, z}); found != cells.end())
            for (const Index item : found->second) visit(item);
  }

  std::unordered_map<int, Cells> widths_;  ///< by the exponent of two of the cells' edge
  std::vector<int> width_of_;
  std::vector<Cell> cell_of_;
  std::vector<bool> placed_;
};

}  // namespace sazare::neighbors
