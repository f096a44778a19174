#pragma once

/// Bodies of bonded spheres, which can break, and the pieces they are in. Spheres of one piece do not touch each other, however
/// much they overlap; spheres of two pieces do.

#include <algorithm>
#include <vector>

#include "sazare/methods/spheres/bonds.hpp"

namespace sazare::methods::spheres {

class BondedBodies {
public:
  struct Range {
    Index begin = 0, end = 0;
  };

  BondedBodies() = default;
  /// `body` says by number of the sphere which, below 0 where none: bodies from 0 on, one after the other, the spheres of each
  /// with numbers in a row. The bonds stand by their first sphere.
  BondedBodies(std::vector<Index> body, const Bonds& bonds);

  bool empty() const { return spheres_.empty(); }
  std::size_t count() const { return spheres_.size(); }
  /// The body of a sphere, below 0 where none.
  Index of(Index sphere) const { return body_[static_cast<std::size_t>(sphere)]; }
  /// Numbers of the spheres of a body.
  Range spheres(Index body) const { return spheres_[static_cast<std::size_t>(body)]; }
  /// The piece a sphere is in, by the number of the first sphere in it; below 0 where it is of no body.
  Index piece(Index sphere) const { return piece_[static_cast<std::size_t>(sphere)]; }
  bool is_whole(std::size_t body) const {
    const Range range = spheres_[body];
    return std::all_of(piece_.begin() + range.begin, piece_.begin() + range.end,
                       [&](Index piece) { return piece == range.begin; });
  }

  /// Finds the pieces of a body, or of all, by the bonds that hold.
  void find_pieces(Index body, const Bonds& bonds);
  void find_pieces(const Bonds& bonds);

private:
  Index root(Index sphere);

  std::vector<Index> body_, piece_;  ///< by number of the sphere
  std::vector<Range> spheres_;       ///< by body: numbers
  std::vector<Range> bonds_;         ///< by body: those whose first sphere is of it
};

}  // namespace sazare::methods::spheres
