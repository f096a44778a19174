#pragma once

/// The order of a grid's cells. They are gathered in cubes, and these in layers across one axis, along a Morton curve in each
/// layer; the cells of a cube stand in layers across the same axis. So what is near in space is near in the order, and wherever
/// this is cut in two, few cells of one part touch the other: those along a plane across the axis.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sazare/core/morton.hpp"
#include "sazare/core/time.hpp"

namespace sazare::neighbors {

/// Place of a cell: its number on each axis.
using CellPlace = std::array<std::int64_t, 3>;

class CellOrder {
public:
  /// The most cells on an axis.
  static constexpr std::int64_t most_cells = std::int64_t{1} << 19;

  /// `cells`: how many there are on each axis. `cube`: about how wide a cube is on each, in cells. `across`: the axis.
  CellOrder(const CellPlace& cells, const std::array<Real, 3>& cube, std::size_t across) {
    const std::size_t second = (across + 1) % 3, third = (across + 2) % 3;
    int cell_bits = 0, cube_bits = 0;
    for (const std::size_t a : {third, second, across}) {
      const auto wanted = std::clamp<std::int64_t>(std::llround(static_cast<Real>(cells[a]) / cube[a]), 1, cells[a]);
      const std::int64_t width = (cells[a] + wanted - 1) / wanted, cubes = (cells[a] + width - 1) / width;
      axes_[a].width = static_cast<std::uint64_t>(width);
      axes_[a].inverse = (std::uint64_t{1} << inverse_shift) / axes_[a].width + 1;
      axes_[a].cell_shift = cell_bits;
      cell_bits += bits_of(width);
      if (a != across) cube_bits = std::max(cube_bits, bits_of(cubes));
    }
    axes_[third].cube_shift = cell_bits;
    axes_[second].cube_shift = cell_bits + 1;
    axes_[across].cube_shift = cell_bits + 2 * cube_bits;
    axes_[across].is_first = true;
  }

  /// What a cell's number on an axis adds to its key.
  std::uint64_t part(std::size_t axis, std::int64_t cell) const {
    const Axis& on = axes_[axis];
    const auto number = static_cast<std::uint64_t>(cell);
    const std::uint64_t cube = number * on.inverse >> inverse_shift;  // number / width
    return (number - cube * on.width) << on.cell_shift | (on.is_first ? cube : spread_for_two(cube)) << on.cube_shift;
  }

  /// Cells stand by it; no two have the same.
  std::uint64_t key(const CellPlace& place) const { return part(0, place[0]) | part(1, place[1]) | part(2, place[2]); }

private:
  /// Whole parts of numbers up to `most_cells` are exact with inverses of so many bits, and products below 2^64.
  static constexpr int inverse_shift = 40;

  struct Axis {
    std::uint64_t width = 1, inverse = 0;  ///< of a cube [cells], and what stands for 1 / width
    int cell_shift = 0, cube_shift = 0;    ///< where the bits of a cell in its cube and of the cube are in a key
    bool is_first = false;
  };

  /// Number of bits that numbers below `count` need.
  static int bits_of(std::int64_t count) { return std::bit_width(static_cast<std::uint64_t>(count - 1)); }

  std::array<Axis, 3> axes_;
};

}  // namespace sazare::neighbors
