#include "sazare/neighbors/sphere_grid.hpp"

namespace sazare::neighbors {

std::size_t SphereGrid::Hash::operator()(const Cell& cell) const {
  std::uint64_t hash = static_cast<std::uint64_t>(cell.width) * 0x9E3779B97F4A7C15u;
  for (const std::int64_t part : {cell.x, cell.y, cell.z})
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0xBF58476D1CE4E5B9u + (hash >> 29);
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

void SphereGrid::place(Index item, const Vector3& centre, Real radius) {
  const int width = static_cast<int>(std::ceil(std::log2(2 * radius)));
  const Vector3 at = (centre / std::ldexp(1.0, width)).array().floor();
  const Cell cell{width, static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()), static_cast<std::int64_t>(at.z())};
  const auto index = static_cast<std::size_t>(item);
  if (index >= cell_of_.size()) {
    cell_of_.resize(index + 1);
    placed_.resize(index + 1, false);
  }
  if (placed_[index] && cell_of_[index] == cell) return;
  remove(item);
  cells_[cell].push_back(item);
  ++widths_[width];
  cell_of_[index] = cell;
  placed_[index] = true;
}

void SphereGrid::remove(Index item) {
  const auto index = static_cast<std::size_t>(item);
  if (!placed_[index]) return;
  const auto found = cells_.find(cell_of_[index]);
  std::erase(found->second, item);
  if (found->second.empty()) cells_.erase(found);
  const auto width = widths_.find(cell_of_[index].width);
  if (--width->second == 0) widths_.erase(width);
  placed_[index] = false;
}

}  // namespace sazare::neighbors
