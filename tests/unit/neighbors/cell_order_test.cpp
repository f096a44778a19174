#include "sazare/neighbors/cell_order.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace sazare::neighbors {
namespace {

template <class F>
void visit(const CellPlace& cells, F&& f) {
  for (std::int64_t z = 0; z < cells[2]; ++z)
    for (std::int64_t y = 0; y < cells[1]; ++y)
      for (std::int64_t x = 0; x < cells[0]; ++x) f(CellPlace{x, y, z});
}

TEST(cell_order, gives_every_cell_a_key_of_its_own) {
  for (const CellPlace& cells : {CellPlace{41, 41, 42}, CellPlace{7, 1, 30}, CellPlace{1, 1, 1}, CellPlace{2, 50, 3}})
    for (std::size_t across = 0; across < 3; ++across) {
      const CellOrder order(cells, {8.6, 9.1, 5.5}, across);
      std::set<std::uint64_t> keys;
      visit(cells, [&](const CellPlace& place) { EXPECT_TRUE(keys.insert(order.key(place)).second); });
    }
}

TEST(cell_order, has_room_for_the_longest_axes) {
  constexpr std::int64_t most = CellOrder::most_cells;
  const CellOrder order({most, most, most}, {700, 9, 1}, 1);
  std::set<std::uint64_t> keys;
  for (const std::int64_t x : {std::int64_t{0}, most / 3, most - 2, most - 1})
    for (const std::int64_t y : {std::int64_t{0}, most / 3, most - 2, most - 1})
      for (const std::int64_t z : {std::int64_t{0}, most / 3, most - 2, most - 1})
        EXPECT_TRUE(keys.insert(order.key({x, y, z})).second);
}

TEST(cell_order, stands_in_layers_across_its_axis) {
  const CellPlace cells{20, 20, 40};
  const CellOrder order(cells, {10, 10, 10}, 2);
  visit(cells, [&](const CellPlace& one) {
    if (one[2] >= 30) return;
    EXPECT_LT(order.key(one), order.key({one[1], one[0], one[2] + 10})) << "cubes";
    if (one[2] % 10 < 9) {
      EXPECT_LT(order.key(one), order.key({one[0], one[1], one[2] + 1})) << "cells in a cube";
    }
  });
}

/// What threads have to tell each other: cells before a cut that have a neighbour behind it.
TEST(cell_order, is_cut_along_a_plane_wherever_that_is) {
  const CellPlace cells{41, 41, 42};
  const CellOrder order(cells, {8.6, 8.6, 8.7}, 2);
  std::map<std::uint64_t, CellPlace> in_order;
  visit(cells, [&](const CellPlace& place) { in_order[order.key(place)] = place; });
  std::map<CellPlace, std::size_t> number;
  for (const auto& [key, place] : in_order) number.emplace(place, number.size());
  for (const std::size_t parts : {2, 3, 5, 7}) {
    const std::size_t cut = number.size() / parts;
    std::size_t touching = 0;
    for (const auto& [place, n] : number) {
      if (n >= cut) continue;
      bool touches = false;
      for (std::size_t a = 0; a < 3; ++a)
        for (const int step : {-1, 1}) {
          CellPlace beside = place;
          beside[a] += step;
          if (a < 2) beside[a] = (beside[a] + cells[a]) % cells[a];
          const auto found = number.find(beside);
          touches = touches || (found != number.end() && found->second >= cut);
        }
      touching += touches ? 1 : 0;
    }
    EXPECT_LT(touching, 2 * 41 * 41) << parts;  // a plane and, where a layer of cubes is cut, sides of those that are there
  }
}

}  // namespace
}  // namespace sazare::neighbors
