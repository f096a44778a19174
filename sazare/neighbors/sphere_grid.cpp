#include "sazare/neighbors/sphere_grid.hpp"

#include <algorithm>

#include "sazare/core/saturated.hpp"

namespace sazare::neighbors {

namespace {
constexpr Real last_cell = 4e18;  // of 64-bit numbers, with room for one more
}

std::size_t SphereGrid::Hash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0x9E3779B97F4A7C15u;
  for (const std::int64_t part : {cell.x, cell.y, cell.z})
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0xBF58476D1CE4E5B9u + (hash >> 29);
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

SphereGrid::Cell SphereGrid::cell_at(const Vector3& place) {
  const auto number = [&](int axis) {
    return saturated<std::int64_t>(std::clamp(std::floor(place[axis]), -last_cell, last_cell));
  };
  return {number(0), number(1), number(2)};
}

void SphereGrid::place(Index item, const Vector3& centre, Real radius) {
  const int width = saturated<int>(std::ceil(std::log2(2 * radius)));
  const Cell cell = cell_at(centre / std::ldexp(1.0, width));
  const auto index = static_cast<std::size_t>(item);
  if (index >= cell_of_.size()) {
    cell_of_.resize(index + 1);
    width_of_.resize(index + 1, 0);
    placed_.resize(index + 1, false);
  }
  if (placed_[index] && width_of_[index] == width && cell_of_[index] == cell) return;
  remove(item);
  widths_[width][cell].push_back(item);
  cell_of_[index] = cell;
  width_of_[index] = width;
  placed_[index] = true;
}

void SphereGrid::remove(Index item) {
  const auto index = static_cast<std::size_t>(item);
  if (!placed_[index]) return;
  const auto width = widths_.find(width_of_[index]);
  const auto found = width->second.find(cell_of_[index]);
  std::erase(found->second, item);
  if (found->second.empty()) width->second.erase(found);
  if (width->second.empty()) widths_.erase(width);
  placed_[index] = false;
}

}  // namespace sazare::neighbors
