#include "sazare/methods/spheres/bonded_bodies.hpp"

#include <utility>

namespace sazare::methods::spheres {

BondedBodies::BondedBodies(std::vector<Index> body, const Bonds& bonds) : body_(std::move(body)) {
  for (std::size_t sphere = 0; sphere < body_.size(); ++sphere) {
    if (body_[sphere] < 0) continue;
    const auto number = static_cast<Index>(sphere);
    if (static_cast<std::size_t>(body_[sphere]) == spheres_.size()) spheres_.push_back({number, number});
    spheres_.back().end = number + 1;
  }
  for (const Range& range : spheres_) {
    const auto first = [](const Bond& bond) { return std::min(bond.first, bond.second); };
    const auto begin = std::ranges::lower_bound(bonds.bonds(), range.begin, {}, first),
               end = std::ranges::lower_bound(bonds.bonds(), range.end, {}, first);
    bonds_.push_back({static_cast<Index>(begin - bonds.bonds().begin()), static_cast<Index>(end - bonds.bonds().begin())});
  }
  piece_.assign(body_.size(), -1);
  find_pieces(bonds);
}

Index BondedBodies::root(Index sphere) {
  const auto above = [&](Index of) -> Index& { return piece_[static_cast<std::size_t>(of)]; };
  while (above(sphere) != sphere) sphere = above(sphere) = above(above(sphere));
  return sphere;
}

void BondedBodies::find_pieces(Index body, const Bonds& bonds) {
  const Range range = spheres(body), links = bonds_[static_cast<std::size_t>(body)];
  for (Index sphere = range.begin; sphere < range.end; ++sphere) piece_[static_cast<std::size_t>(sphere)] = sphere;
  for (Index n = links.begin; n < links.end; ++n) {
    const Bond& bond = bonds.bonds()[static_cast<std::size_t>(n)];
    if (bonds.is_broken(static_cast<std::size_t>(n)) || of(bond.first) != of(bond.second)) continue;
    const Index one = root(bond.first), other = root(bond.second);
    piece_[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
  }
  for (Index sphere = range.begin; sphere < range.end; ++sphere) piece_[static_cast<std::size_t>(sphere)] = root(sphere);
}

void BondedBodies::find_pieces(const Bonds& bonds) {
  for (std::size_t body = 0; body < spheres_.size(); ++body) find_pieces(static_cast<Index>(body), bonds);
}

}  // namespace sazare::methods::spheres
