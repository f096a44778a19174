#include "sazare/methods/blocks/charges/crack_paths.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sazare::methods::blocks {

namespace {

enum class Kind : std::uint8_t { between, wall, open };

/// A face at one of its edges.
struct Side {
  std::pair<std::int32_t, std::int32_t> nodes;  ///< of the edge, the smaller one first
  Kind kind;
  Index number;
  std::uint8_t place;  ///< of the edge in the face

  auto key() const { return std::tuple(nodes, kind, number, place); }
};

void add_sides(std::vector<Side>& sides, const std::array<std::int32_t, 3>& nodes, Kind kind, Index number) {
  for (std::uint8_t k = 0; k < 3; ++k) sides.push_back({std::minmax(nodes[k], nodes[(k + 1) % 3]), kind, number, k});
}

}  // namespace

CrackPaths::CrackPaths(std::span<const geometry::InteriorFace> faces, std::span<const GasOuterFace> outer)
    : edges_of_(faces.size()) {
  std::vector<Side> sides;
  for (std::size_t face = 0; face < faces.size(); ++face)
    add_sides(sides, faces[face].nodes, Kind::between, static_cast<Index>(face));
  for (const GasOuterFace& face : outer)
    add_sides(sides, face.nodes, face.wall_face < 0 ? Kind::open : Kind::wall, face.wall_face);
  std::ranges::sort(sides, {}, &Side::key);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i == 0 || sides[i - 1].nodes != side.nodes) {
      const auto begin = static_cast<Index>(around_.size());
      edges_.push_back({begin, begin, begin});
    }
    Range& range = edges_.back();
    if (side.kind == Kind::open) {
      range.is_free = true;
      continue;
    }
    around_.push_back(side.number);
    range.end = static_cast<Index>(around_.size());
    if (side.kind != Kind::between) continue;
    range.middle = range.end;
    edges_of_[at(side.number)][side.place] = static_cast<Index>(edges_.size() - 1);
  }
}

CrackPaths::Edge CrackPaths::edge(Index number) const {
  const Range& range = edges_[at(number)];
  const std::span all(around_);
  return {all.subspan(at(range.begin), at(range.middle - range.begin)),
          all.subspan(at(range.middle), at(range.end - range.middle)), range.is_free};
}

}  // namespace sazare::methods::blocks
