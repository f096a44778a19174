#include "sazare/methods/spheres/bond_links.hpp"

namespace sazare::methods::spheres {

void BondLinks::append(const Placed& at, const Bond& bond, const Traits& traits, bool is_filler) {
  const Real share = is_filler ? 0 : 1;
  first.push_back(at.first);
  ends.second.push_back(at.second);
  source.push_back(is_filler ? filler : at.bond);
  kind.push_back(bond.kind);
  length.push_back(bond.stiffness.length);
  stretch.push_back(share * bond.stiffness.stretch);
  shear.push_back(share * bond.stiffness.shear);
  bend.push_back(share * bond.stiffness.bend);
  twist.push_back(share * bond.stiffness.twist);
  direction_x.push_back(bond.direction.x());
  direction_y.push_back(bond.direction.y());
  direction_z.push_back(bond.direction.z());
  if (traits.breaks) {
    radius.push_back(bond.radius);
    largest_use.push_back(is_filler ? 0 : bond.largest_use);
    energy_before.push_back(is_filler ? 0 : bond.energy_before);
  }
  if (!traits.damped) return;
  along.push_back(share * bond.damping.along);
  across.push_back(share * bond.damping.across);
  turning.push_back(share * bond.damping.turning);
}

void BondLinks::lay_out(std::span<const Placed> placed, const std::vector<Bond>& bonds, const Traits& traits, std::size_t tiles) {
  *this = {};
  ends.begin.assign(1, 0);
  auto next = placed.begin();
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const auto end = static_cast<Index>((tile + 1) * neighbors::tile_size);
    const Placed* last = nullptr;
    const auto add = [&](bool is_filler) { append(*last, bonds[static_cast<std::size_t>(last->bond)], traits, is_filler); };
    for (; next != placed.end() && next->first < end; ++next) {
      last = &*next;
      add(false);
    }
    while (last != nullptr && first.size() % lane_count != 0) add(true);
    ends.begin.push_back(first.size());
  }
  broken.assign(tiles, {});
}

}  // namespace sazare::methods::spheres
