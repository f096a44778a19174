#include "sazare/methods/spheres/ranks/clump_border.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "sazare/methods/spheres/stepper/clump_motion.hpp"

namespace sazare::methods::spheres {

namespace {

/// A clump on its way to another rank.
struct Travelling {
  std::size_t clump = 0;
  state::Clump motion;
};

}  // namespace

void ClumpBorder::plan(const TileOwners& owners, const state::Clumps& clumps, Scene scene) {
  scene_ = std::move(scene);
  owner_.clear();
  first_place_.clear();
  sides_.clear();
  for (int rank = 0; rank < ranks_->size(); ++rank) sides_.push_back({rank, {}, {}, {}, {}});
  const auto place_of = [&](const state::ClumpMember& member) { return scene_.place[static_cast<std::size_t>(member.sphere)]; };
  const int own = ranks_->rank();
  for (std::size_t c = 0; c < clumps.clumps.size(); ++c) {
    first_place_.push_back(place_of(clumps.members_of(c).front()));
    const int owner = owners.owner_of_sphere(first_place_.back());
    owner_.push_back(owner);
    Side& of_owner = sides_[static_cast<std::size_t>(owner)];
    for (const state::ClumpMember& member : clumps.members_of(c)) {
      const Index place = place_of(member);
      const int home = owners.owner_of_sphere(place);
      if (home == owner) continue;
      Side& of_home = sides_[static_cast<std::size_t>(home)];
      if (home == own) {
        of_owner.to_owner.push_back({place, member.sphere});
        if (of_owner.taken.empty() || of_owner.taken.back() != c) of_owner.taken.push_back(c);
      } else if (owner == own) {
        of_home.from_members.push_back({place, member.sphere});
        if (of_home.given.empty() || of_home.given.back() != c) of_home.given.push_back(c);
      }
    }
  }
}

/// Calls carry(level, place) for the loads of the levels that are due.
template <class Carry>
void ClumpBorder::carry_loads(const std::vector<Member>& members, std::size_t coarsest, Carry&& carry) const {
  for (const Member& member : members)
    for (std::size_t level = coarsest; level < scene_.loads.size() && is_kicked(member.place, level); ++level)
      carry(level, static_cast<std::size_t>(member.place));
}

std::size_t ClumpBorder::bytes_of(const std::vector<Member>& members, std::size_t coarsest, bool with_water) const {
  std::size_t bytes = with_water ? members.size() * sizeof(Real) : 0;
  carry_loads(members, coarsest, [&](std::size_t, std::size_t) { bytes += sizeof(LoadNumbers); });
  return bytes;
}

std::size_t ClumpBorder::bytes_of(const std::vector<std::size_t>& clumps, std::size_t coarsest) const {
  const auto kicked = std::ranges::count_if(clumps, [&](std::size_t clump) { return is_kicked(first_place_[clump], coarsest); });
  return static_cast<std::size_t>(kicked) * sizeof(Travelling);
}

void ClumpBorder::bring_loads(std::size_t coarsest, WaterForces& water) {
  const bool with_water = !water.empty();
  for (const Side& side : sides_) {
    messages_.plan(side.rank, bytes_of(side.to_owner, coarsest, with_water), bytes_of(side.from_members, coarsest, with_water));
    MessageWriter to = messages_.to(side.rank);
    carry_loads(side.to_owner, coarsest,
                [&](std::size_t level, std::size_t place) { to.write(numbers_of(scene_.loads[level]->of(place))); });
    if (with_water)
      for (const Member& member : side.to_owner) to.write(water.added_mass(member.number));
  }
  messages_.exchange();
  for (const Side& side : sides_) {
    MessageReader from = messages_.from(side.rank);
    carry_loads(side.from_members, coarsest, [&](std::size_t level, std::size_t place) {
      scene_.loads[level]->kept(place / neighbors::tile_size)[place % neighbors::tile_size] = load_of(from.read<LoadNumbers>());
    });
    if (with_water)
      for (const Member& member : side.from_members) water.set_added_mass(member.number, from.read<Real>());
  }
}

void ClumpBorder::show(state::Clumps& clumps, state::Spheres& spheres, std::size_t coarsest) {
  for (const Side& side : sides_) {
    messages_.plan(side.rank, bytes_of(side.given, coarsest), bytes_of(side.taken, coarsest));
    MessageWriter to = messages_.to(side.rank);
    for (const std::size_t clump : side.given)
      if (is_kicked(first_place_[clump], coarsest)) to.write(Travelling{clump, clumps.clumps[clump]});
  }
  messages_.exchange();
  for (const Side& side : sides_)
    for (MessageReader from = messages_.from(side.rank); !from.is_at_end();) {
      const auto arrived = from.read<Travelling>();
      clumps.clumps[arrived.clump] = arrived.motion;
      place_members(arrived.motion, clumps.members_of(arrived.clump), scene_.place, spheres);
    }
}

void ClumpBorder::share(state::Clumps& clumps, parallel::To to, parallel::Topic topic) const {
  std::vector<Travelling> own;
  for (std::size_t c = 0; c < owner_.size(); ++c)
    if (owns(c)) own.push_back({c, clumps.clumps[c]});
  const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(own)), topic, to);
  if (to == parallel::To::first && !ranks_->is_first()) return;
  for (MessageReader from(all.bytes); !from.is_at_end();) {
    const auto arrived = from.read<Travelling>();
    clumps.clumps[arrived.clump] = arrived.motion;
  }
}

}  // namespace sazare::methods::spheres
