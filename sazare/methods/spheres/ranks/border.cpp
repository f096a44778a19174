#include "sazare/methods/spheres/ranks/border.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "sazare/parallel/give.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// Force and moment.
using LoadNumbers = std::array<Real, 6>;
/// Place, velocity and spin: what forces need of a sphere, and what changes of it in a step.
using MotionNumbers = std::array<Real, 9>;

static_assert(sizeof(LoadNumbers) == Border::bytes_of_load && sizeof(MotionNumbers) == Border::bytes_of_motion &&
              sizeof(state::SphereTurn) == Border::bytes_of_turn);

LoadNumbers numbers_of(const state::SphereLoad& load) { return {load.fx, load.fy, load.fz, load.mx, load.my, load.mz}; }

void put(const LoadNumbers& numbers, state::SphereLoad& load) {
  load.fx = numbers[0], load.fy = numbers[1], load.fz = numbers[2];
  load.mx = numbers[3], load.my = numbers[4], load.mz = numbers[5];
}

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

/// Writes a record into a message or reads it from there, and goes on to the next one.
template <class Record>
void write(std::byte*& to, const Record& record) {
  std::memcpy(to, &record, sizeof record);
  to += sizeof record;
}

template <class Record>
Record read(const std::byte*& from) {
  Record record;
  std::memcpy(&record, from, sizeof record);
  from += sizeof record;
  return record;
}

}  // namespace

void Border::complete(const TileOwners& owners, std::vector<std::vector<Index>>& ghosts) {
  std::vector<Looks> to_each(static_cast<std::size_t>(ranks_->size()));
  for (const std::size_t tile : owners.own())
    for (const Index ghost : ghosts[tile])
      if (const int owner = owners.owner_of_sphere(ghost); owner != ranks_->rank())
        to_each[static_cast<std::size_t>(owner)].push_back({static_cast<Index>(tile), ghost});
  std::vector<std::vector<std::byte>> bytes;
  for (const Looks& looks : to_each) {
    const auto packed = std::as_bytes(std::span(looks));
    bytes.emplace_back(packed.begin(), packed.end());
  }
  for (const auto& arrived : parallel::give(*ranks_, std::move(bytes), parallel::Topic::search)) {
    Looks looks(arrived.size() / sizeof(Look));
    if (!looks.empty()) std::memcpy(looks.data(), arrived.data(), arrived.size());
    for (const Look& look : looks) ghosts[static_cast<std::size_t>(look.tile)].push_back(look.sphere);
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
  rounds_.clear();
  for (std::size_t coarsest = 0; coarsest < levels_.size(); ++coarsest) {
    const auto loads = [&](const Side& side) { return bytes_of_loads(side, coarsest); };
    const auto motion = [&](const Side& side) { return bytes_of_spheres(side, coarsest); };
    rounds_.push_back({messages(theirs_, loads), messages(ours_, loads), messages(ours_, motion), messages(theirs_, motion)});
  }
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

/// A message for each side, also where it is empty.
Border::Messages Border::messages(const std::vector<Side>& sides, const std::function<std::size_t(const Side&)>& bytes) const {
  Messages list;
  for (const Side& side : sides) list.push_back({side.rank, std::vector<std::byte>(bytes(side))});
  return list;
}

std::size_t Border::bytes_of_loads(const Side& side, std::size_t coarsest) const {
  std::size_t count = 0;
  for (std::size_t level = coarsest; level < levels_.size(); ++level) count += side.loads[level].size();
  return count * bytes_of_load;
}

std::size_t Border::bytes_of_spheres(const Side& side, std::size_t coarsest) const {
  return side.kicked[coarsest] * (bytes_of_motion + (with_turns_ ? bytes_of_turn : 0)) + side.tiles.size() * sizeof(SphereSpeeds);
}

void Border::bring_loads(std::size_t coarsest) {
  const Real began = parallel::processor_seconds();
  Round& round = rounds_[coarsest];
  for (std::size_t n = 0; n < theirs_.size(); ++n) {
    std::byte* to = round.sent_loads[n].bytes.data();
    for (std::size_t level = coarsest; level < levels_.size(); ++level)
      for (const Index load : theirs_[n].loads[level]) write(to, numbers_of(levels_[level].loads->load_of_ghost(load)));
  }
  expect(round.sent_loads);
  exchange(round.sent_loads, round.received_loads);
  for (std::size_t n = 0; n < ours_.size(); ++n) {
    const std::byte* from = round.received_loads[n].bytes.data();
    for (std::size_t level = coarsest; level < levels_.size(); ++level)
      for (const Index load : ours_[n].loads[level]) put(read<LoadNumbers>(from), levels_[level].loads->load_of_ghost(load));
  }
  seconds_ += parallel::processor_seconds() - began;
}

void Border::show_motion(state::Spheres& spheres, std::span<SphereSpeeds> by_tile, std::size_t coarsest) {
  const Real began = parallel::processor_seconds();
  Round& round = rounds_[coarsest];
  for (std::size_t n = 0; n < ours_.size(); ++n)
    write_motion(ours_[n], coarsest, spheres, by_tile, round.sent_motion[n].bytes.data());
  expect(round.sent_motion);
  exchange(round.sent_motion, round.received_motion);
  for (std::size_t n = 0; n < theirs_.size(); ++n)
    read_motion(theirs_[n], coarsest, spheres, by_tile, round.received_motion[n].bytes.data());
  seconds_ += parallel::processor_seconds() - began;
}

void Border::write_motion(const Side& side, std::size_t coarsest, const state::Spheres& spheres,
                          std::span<const SphereSpeeds> by_tile, std::byte* to) const {
  for (const Index sphere : std::span(side.spheres).first(side.kicked[coarsest])) {
    write(to, motion_of(spheres, sphere));
    if (with_turns_) write(to, spheres.turn[static_cast<std::size_t>(sphere)]);
  }
  for (const std::size_t tile : side.tiles) write(to, by_tile[tile]);
}

void Border::read_motion(const Side& side, std::size_t coarsest, state::Spheres& spheres, std::span<SphereSpeeds> by_tile,
                         const std::byte* from) const {
  for (const Index sphere : std::span(side.spheres).first(side.kicked[coarsest])) {
    put(read<MotionNumbers>(from), spheres, sphere);
    if (with_turns_) spheres.turn[static_cast<std::size_t>(sphere)] = read<state::SphereTurn>(from);
  }
  for (const std::size_t tile : side.tiles) by_tile[tile] = read<SphereSpeeds>(from);
}

/// Exchanges the messages that hold something; both ends know which.
void Border::exchange(Messages& sent, Messages& received) const {
  Messages full_sent, full_received;
  const auto is_full = [](const parallel::Message& message) { return !message.bytes.empty(); };
  const auto move_full = [&](Messages& from, Messages& to) {
    for (parallel::Message& message : from)
      if (is_full(message)) to.push_back(std::move(message));
  };
  move_full(sent, full_sent);
  move_full(received, full_received);
  ranks_->exchange(full_sent, full_received, parallel::Topic::motion);
  for (Messages* const list : {&full_sent, &full_received})
    for (parallel::Message& message : *list)
      (list == &full_sent ? sent : received)[static_cast<std::size_t>(message.rank)].bytes = std::move(message.bytes);
}

void Border::expect(const Messages& sent) {
  for (const parallel::Message& message : sent) {
    expected_.bytes += static_cast<std::int64_t>(message.bytes.size());
    expected_.messages += message.bytes.empty() ? 0 : 1;
  }
}

std::int64_t Border::shown() const {
  std::int64_t all = 0;
  for (const Side& side : ours_) all += static_cast<std::int64_t>(side.spheres.size());
  return all;
}

}  // namespace sazare::methods::spheres
