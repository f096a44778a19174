#include "sazare/methods/spheres/ranks/border.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "sazare/parallel/give.hpp"
#include "sazare/parallel/plain_records.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// Place, velocity and spin: what forces need of a sphere, and what changes of it in a step.
using MotionNumbers = std::array<Real, 9>;

static_assert(sizeof(MotionNumbers) == Border::bytes_of_motion && sizeof(state::SphereTurn) == Border::bytes_of_turn);

MotionNumbers motion_of(const state::Spheres& spheres, Index at) {
  const auto i = static_cast<std::size_t>(at);
  const state::SpherePlace& place = spheres.place[i];
  const state::SphereSpin& spin = spheres.spin[i];
  return {place.x, place.y, place.z, place.vx, place.vy, place.vz, spin.x, spin.y, spin.z};
}

void put(const MotionNumbers& numbers, state::Spheres& spheres, Index at) {
  const auto i = static_cast<std::size_t>(at);
  state::SpherePlace& place = spheres.place[i];
  state::SphereSpin& spin = spheres.spin[i];
  place.x = numbers[0], place.y = numbers[1], place.z = numbers[2];
  place.vx = numbers[3], place.vy = numbers[4], place.vz = numbers[5];
  spin.x = numbers[6], spin.y = numbers[7], spin.z = numbers[8];
}

/// A tile that looks at a sphere of a later one.
struct Look {
  Index tile = 0, sphere = 0;
};
using Looks = std::vector<Look>;

}  // namespace

void Border::complete(const TileOwners& owners, std::vector<std::vector<Index>>& ghosts) {
  std::vector<Looks> to_each(static_cast<std::size_t>(ranks_->size()));
  for (const std::size_t tile : owners.own())
    for (const Index ghost : ghosts[tile])
      if (const int owner = owners.owner_of_sphere(ghost); owner != ranks_->rank())
        to_each[static_cast<std::size_t>(owner)].push_back({static_cast<Index>(tile), ghost});
  std::vector<std::vector<std::byte>> bytes;
  for (const Looks& looks : to_each) bytes.push_back(parallel::bytes_of(looks));
  for (const auto& arrived : parallel::give(*ranks_, std::move(bytes), parallel::Topic::search)) {
    for (const Look& look : parallel::records_in<Look>(arrived))
      ghosts[static_cast<std::size_t>(look.tile)].push_back(look.sphere);
  }
}

void Border::tell_of_ghosts(std::vector<Index>& by_place) const {
  std::vector<std::vector<std::byte>> to_each(static_cast<std::size_t>(ranks_->size()));
  for (std::size_t rank = 0; rank < ours_.size(); ++rank) {
    std::vector<Index> values;
    for (const Index sphere : ours_[rank].spheres) values.push_back(by_place[static_cast<std::size_t>(sphere)]);
    to_each[rank] = parallel::bytes_of(values);
  }
  const auto arrived = parallel::give(*ranks_, std::move(to_each), parallel::Topic::search);
  for (std::size_t rank = 0; rank < theirs_.size(); ++rank) {
    MessageReader from(arrived[rank]);
    for (const Index sphere : theirs_[rank].spheres) by_place[static_cast<std::size_t>(sphere)] = from.read<Index>();
  }
}

void Border::plan(const TileOwners& owners, std::vector<Level> levels, bool with_turns) {
  levels_ = std::move(levels);
  with_turns_ = with_turns;
  Side empty;
  empty.loads.resize(levels_.size());
  theirs_.assign(static_cast<std::size_t>(ranks_->size()), empty);
  ours_ = theirs_;
  for (std::size_t level = 0; level < levels_.size(); ++level)
    for (std::size_t tile = 0; tile < levels_[level].loads->tiles(); ++tile) {
      auto load = static_cast<Index>(levels_[level].loads->first_ghost(tile));
      for (const Index ghost : levels_[level].loads->ghosts(tile)) {
        const Index number = load++;
        const int home = owners.owner_of_sphere(ghost), owner = owners.owner(tile);
        if (home == owner) continue;
        Side& side = owners.owns(tile) ? theirs_[static_cast<std::size_t>(home)] : ours_[static_cast<std::size_t>(owner)];
        side.loads[level].push_back(number);
        side.spheres.push_back(ghost);
      }
    }
  finish(theirs_);
  finish(ours_);
}

/// Names each sphere once, and finds which of them are kicked and their tiles.
void Border::finish(std::vector<Side>& sides) const {
  for (std::size_t rank = 0; rank < sides.size(); ++rank) {
    Side& side = sides[rank];
    side.rank = static_cast<int>(rank);
    std::ranges::sort(side.spheres);
    side.spheres.erase(std::unique(side.spheres.begin(), side.spheres.end()), side.spheres.end());
    for (const Level& level : levels_)
      side.kicked.push_back(static_cast<std::size_t>(std::ranges::lower_bound(side.spheres, static_cast<Index>(level.spheres)) -
                                                     side.spheres.begin()));
    if (levels_.size() > 1) continue;
    for (const Index sphere : side.spheres)
      if (const std::size_t tile = static_cast<std::size_t>(sphere) / neighbors::tile_size;
          side.tiles.empty() || side.tiles.back() != tile)
        side.tiles.push_back(tile);
  }
}

std::size_t Border::bytes_of_loads(const Side& side, std::size_t coarsest) const {
  std::size_t count = 0;
  for (std::size_t level = coarsest; level < levels_.size(); ++level) count += side.loads[level].size();
  return count * bytes_of_load;
}

std::size_t Border::bytes_of_spheres(const Side& side, std::size_t coarsest) const {
  return side.kicked[coarsest] * (bytes_of_motion + (with_turns_ ? bytes_of_turn : 0)) + side.tiles.size() * sizeof(SphereSpeeds);
}

template <class Bytes>
void Border::plan(const std::vector<Side>& to, const std::vector<Side>& from, Bytes&& bytes) {
  for (std::size_t n = 0; n < to.size(); ++n) messages_.plan(to[n].rank, bytes(to[n]), bytes(from[n]));
}

void Border::bring_loads(std::size_t coarsest) {
  const Real began = parallel::processor_seconds();
  plan(theirs_, ours_, [&](const Side& side) { return bytes_of_loads(side, coarsest); });
  for (const Side& side : theirs_) {
    MessageWriter to = messages_.to(side.rank);
    for (std::size_t level = coarsest; level < levels_.size(); ++level)
      for (const Index load : side.loads[level]) to.write(numbers_of(levels_[level].loads->load_of_ghost(load)));
  }
  messages_.exchange();
  for (const Side& side : ours_) {
    MessageReader from = messages_.from(side.rank);
    for (std::size_t level = coarsest; level < levels_.size(); ++level)
      for (const Index load : side.loads[level]) levels_[level].loads->load_of_ghost(load) = load_of(from.read<LoadNumbers>());
  }
  seconds_ += parallel::processor_seconds() - began;
}

void Border::show_motion(state::Spheres& spheres, std::span<SphereSpeeds> by_tile, std::size_t coarsest) {
  const Real began = parallel::processor_seconds();
  const auto kicked = [&](const Side& side) { return std::span(side.spheres).first(side.kicked[coarsest]); };
  plan(ours_, theirs_, [&](const Side& side) { return bytes_of_spheres(side, coarsest); });
  for (const Side& side : ours_) {
    MessageWriter to = messages_.to(side.rank);
    for (const Index sphere : kicked(side)) {
      to.write(motion_of(spheres, sphere));
      if (with_turns_) to.write(spheres.turn[static_cast<std::size_t>(sphere)]);
    }
    for (const std::size_t tile : side.tiles) to.write(by_tile[tile]);
  }
  messages_.exchange();
  for (const Side& side : theirs_) {
    MessageReader from = messages_.from(side.rank);
    for (const Index sphere : kicked(side)) {
      put(from.read<MotionNumbers>(), spheres, sphere);
      if (with_turns_) spheres.turn[static_cast<std::size_t>(sphere)] = from.read<state::SphereTurn>();
    }
    for (const std::size_t tile : side.tiles) by_tile[tile] = from.read<SphereSpeeds>();
  }
  seconds_ += parallel::processor_seconds() - began;
}

std::int64_t Border::shown() const {
  std::int64_t all = 0;
  for (const Side& side : ours_) all += static_cast<std::int64_t>(side.spheres.size());
  return all;
}

}  // namespace sazare::methods::spheres
