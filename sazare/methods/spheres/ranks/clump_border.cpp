#include "sazare/methods/spheres/ranks/clump_border.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "sazare/methods/spheres/stepper/clump_motion.hpp"

namespace sazare::methods::spheres {

namespace {

/// Force and moment.
using LoadNumbers = std::array<Real, 6>;

/// A clump on its way to another rank.
struct Travelling {
  std::size_t clump = 0;
  state::Clump motion;
};

template <class Record>
void write(std::vector<std::byte>& to, const Record& record) {
  const std::size_t before = to.size();
  to.resize(before + sizeof record);
  std::memcpy(to.data() + before, &record, sizeof record);
}

template <class Record>
Record read(const std::byte*& from) {
  Record record;
  std::memcpy(static_cast<void*>(&record), from, sizeof record);
  from += sizeof record;
  return record;
}

}  // namespace

void ClumpBorder::plan(const TileOwners& owners, const state::Clumps& clumps, Scene scene) {
  scene_ = std::move(scene);
  owner_.clear();
  first_place_.clear();
  sides_.assign(static_cast<std::size_t>(ranks_->size()), {});
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
  std::vector<parallel::Message> sent, received;
  for (std::size_t rank = 0; rank < sides_.size(); ++rank) {
    const Side& side = sides_[rank];
    parallel::Message message{static_cast<int>(rank), {}};
    carry_loads(side.to_owner, coarsest, [&](std::size_t level, std::size_t place) {
      const state::SphereLoad& load = scene_.loads[level]->of(place);
      write(message.bytes, LoadNumbers{load.fx, load.fy, load.fz, load.mx, load.my, load.mz});
    });
    if (!water.empty())
      for (const Member& member : side.to_owner) write(message.bytes, water.added_mass(member.number));
    sent.push_back(std::move(message));
    received.push_back({static_cast<int>(rank), std::vector<std::byte>(bytes_of(side.from_members, coarsest, !water.empty()))});
  }
  exchange(std::move(sent), received);
  for (const parallel::Message& message : received) {
    const Side& side = sides_[static_cast<std::size_t>(message.rank)];
    const std::byte* from = message.bytes.data();
    carry_loads(side.from_members, coarsest, [&](std::size_t level, std::size_t place) {
      const auto numbers = read<LoadNumbers>(from);
      scene_.loads[level]->kept(place / neighbors::tile_size)[place % neighbors::tile_size] = {
          numbers[0], numbers[1], numbers[2], 0, numbers[3], numbers[4], numbers[5], 0};
    });
    if (!water.empty())
      for (const Member& member : side.from_members) water.set_added_mass(member.number, read<Real>(from));
  }
}

void ClumpBorder::show(state::Clumps& clumps, state::Spheres& spheres, std::size_t coarsest) {
  std::vector<parallel::Message> sent, received;
  for (std::size_t rank = 0; rank < sides_.size(); ++rank) {
    parallel::Message message{static_cast<int>(rank), {}};
    for (const std::size_t clump : sides_[rank].given)
      if (is_kicked(first_place_[clump], coarsest)) write(message.bytes, Travelling{clump, clumps.clumps[clump]});
    sent.push_back(std::move(message));
    received.push_back({static_cast<int>(rank), std::vector<std::byte>(bytes_of(sides_[rank].taken, coarsest))});
  }
  exchange(std::move(sent), received);
  for (const parallel::Message& message : received) {
    const std::byte* from = message.bytes.data();
    for (std::size_t n = 0; n < message.bytes.size() / sizeof(Travelling); ++n) {
      const auto arrived = read<Travelling>(from);
      clumps.clumps[arrived.clump] = arrived.motion;
      place_members(arrived.motion, clumps.members_of(arrived.clump), scene_.place, spheres);
    }
  }
}

void ClumpBorder::share(state::Clumps& clumps, parallel::To to, parallel::Topic topic) const {
  std::vector<std::byte> own;
  for (std::size_t c = 0; c < owner_.size(); ++c)
    if (owns(c)) write(own, Travelling{c, clumps.clumps[c]});
  const parallel::Gathered all = ranks_->gather(own, topic, to);
  if (to == parallel::To::first && !ranks_->is_first()) return;
  const std::byte* from = all.bytes.data();
  for (std::size_t n = 0; n < all.bytes.size() / sizeof(Travelling); ++n) {
    const auto arrived = read<Travelling>(from);
    clumps.clumps[arrived.clump] = arrived.motion;
  }
}

/// Exchanges the messages that hold something; both ends know which.
void ClumpBorder::exchange(std::vector<parallel::Message> sent, std::vector<parallel::Message>& received) {
  const auto is_empty = [](const parallel::Message& message) { return message.bytes.empty(); };
  std::erase_if(sent, is_empty);
  std::erase_if(received, is_empty);
  for (const parallel::Message& message : sent) {
    expected_.bytes += static_cast<std::int64_t>(message.bytes.size());
    ++expected_.messages;
  }
  ranks_->exchange(sent, received, parallel::Topic::motion);
}

}  // namespace sazare::methods::spheres
