#include "sazare/engine/sphere_levels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "sazare/neighbors/pair_levels.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::engine {

namespace {

/// From how many blocks on threads share the work on so many spheres: the finest levels are small, and often due.
std::size_t serial_below(std::size_t spheres) { return spheres > neighbors::block_size ? 2 : static_cast<std::size_t>(-1); }

void add(state::SphereLoad& to, Real share, const state::SphereLoad& load) {
  to.fx += share * load.fx;
  to.fy += share * load.fy;
  to.fz += share * load.fz;
  to.mx += share * load.mx;
  to.my += share * load.my;
  to.mz += share * load.mz;
}

}  // namespace

SphereLevels::SphereLevels(std::vector<std::int8_t> level, const methods::spheres::ContactTable& table, Real base_step)
    : level_(std::move(level)) {
  const int finest = *std::ranges::max_element(level_);
  for (int k = 0; k <= finest; ++k)
    levels_.push_back({std::ldexp(base_step, -k), methods::spheres::PairContacts(table), {}, 0, {}, {}});
}

int SphereLevels::coarsest_due(std::int64_t tick) const {
  return tick == 0 ? 0 : finest() - std::countr_zero(static_cast<std::uint64_t>(tick));
}

int SphereLevels::pace(std::size_t sphere) const {
  int pace = finest();
  while (sphere >= levels_[static_cast<std::size_t>(pace)].spheres) --pace;
  return pace;
}

std::vector<std::int8_t> SphereLevels::by_place(const state::Spheres& spheres) const {
  std::vector<std::int8_t> level(level_.size());
  for (std::size_t i = 0; i < level.size(); ++i) level[i] = level_[static_cast<std::size_t>(spheres.number[i])];
  return level;
}

std::vector<Index> SphereLevels::find(state::Spheres& spheres, Real margin) {
  auto found = neighbors::find_leveled_pairs(spheres, margin, by_place(spheres), finest());
  const std::vector<Index> new_place = neighbors::places_after(found.order);
  neighbors::put_in_order(spheres, found.order);
  for (std::size_t l = 0; l < levels_.size(); ++l) levels_[l].pairs.go_over(std::move(found.pairs[l]), new_place);
  arrange();
  for (Level& level : levels_) level.pairs.write_to(level.loads);
  return std::move(found.order);
}

/// Loads and lists of what is worked on together, from the pairs.
void SphereLevels::arrange() {
  blocks_.clear();
  flocks_.clear();
  blocks_until_.resize(levels_.size());
  flocks_until_.resize(levels_.size());
  std::size_t begin = 0;
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    const int number = static_cast<int>(l);
    level.spheres = level.pairs.pairs().first.size() - 1;
    level.loads.arrange(level.pairs.pairs(), {});
    for (std::size_t block = 0; block < level.loads.blocks(); ++block) blocks_.push_back({number, block});
    while (begin < level.spheres) {
      const std::size_t end = std::min((begin / neighbors::block_size + 1) * neighbors::block_size, level.spheres);
      flocks_.push_back({number, begin, end});
      begin = end;
    }
    blocks_until_[l] = blocks_.size();
    flocks_until_[l] = flocks_.size();
  }
  sums_.resize(blocks_.size());
  speeds_.resize(flocks_.size());
  driven_work_.resize(flocks_.size());
}

ComingLines SphereLevels::coming(const state::Spheres& spheres, const Block& block) const {
  const Level& level = levels_[static_cast<std::size_t>(block.level)];
  return level.pairs.coming(spheres, level.loads, block.block);
}

void SphereLevels::evaluate(std::int64_t tick, const state::Spheres& spheres, methods::spheres::WallContacts& walls,
                            Real approach) {
  const auto coarsest = static_cast<std::size_t>(coarsest_due(tick));
  const std::size_t count = blocks_until_[coarsest], alone_below = serial_below(levels_[coarsest].spheres);
  parallel::parallel_for(count, alone_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const std::size_t block = blocks_[n].block, number = static_cast<std::size_t>(blocks_[n].level);
      Level& level = levels_[number];
      state::SphereLoad* const own = level.loads.kept(block);
      level.loads.clear(block, own);
      const ComingLines next = n + 1 < end ? coming(spheres, blocks_[n + 1]) : ComingLines{};
      sums_[n] = level.pairs.evaluate(spheres, {block, approach, level.step, level.loads, own, next});
      if (!walls.walls().empty()) sums_[n] += walls.evaluate(spheres, {block, level.step, own, number});
    }
  });
  parallel::parallel_for(count, alone_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Level& level = levels_[static_cast<std::size_t>(blocks_[n].level)];
      level.loads.gather(blocks_[n].block, level.loads.kept(blocks_[n].block));
    }
  });
  for (std::size_t l = coarsest; l < levels_.size(); ++l) levels_[l].sums = {};
  for (std::size_t n = 0; n < count; ++n) levels_[static_cast<std::size_t>(blocks_[n].level)].sums += sums_[n];
  for (std::size_t l = coarsest; l < levels_.size(); ++l) counts_.evaluations += levels_[l].sums.contacts;
  if (tick == 0)
    for (const Level& level : levels_) counts_.uniform_evaluations += ticks() * level.sums.contacts;
}

void SphereLevels::book(std::int64_t tick, methods::spheres::ContactSums& sums) const {
  methods::spheres::ContactSums due;
  for (std::size_t l = static_cast<std::size_t>(coarsest_due(tick)); l < levels_.size(); ++l) due += levels_[l].sums;
  sums.dashpot_work += due.dashpot_work;
  sums.sliding_work += due.sliding_work;
  if (tick > 0) return;
  sums.elastic = due.elastic;
  sums.sliding = due.sliding;
  sums.contacts = due.contacts;
}

/// The loads of all levels at which spheres of a pace may have contacts. A load evaluated at t acts from half a step of its level
/// before t to half a step after it.
std::vector<TimedLoads> SphereLevels::loads_on(const Flock& flock, std::int64_t tick) const {
  const std::int64_t next = tick + (std::int64_t{1} << (finest() - flock.pace));
  std::vector<TimedLoads> loads;
  for (int l = 0; l <= flock.pace; ++l) {
    const Level& level = levels_[static_cast<std::size_t>(l)];
    const std::int64_t stride = std::int64_t{1} << (finest() - l), evaluated = tick - tick % stride;
    const Real halves = static_cast<Real>(2 * (next - evaluated) - stride);
    loads.push_back({&level.loads.of(flock.begin), evaluated == tick ? level.step : 0, 0.5 * tick_seconds() * halves});
  }
  return loads;
}

SphereSpeeds SphereLevels::kick(std::int64_t tick, state::Spheres& spheres, const Kick& rules) {
  const auto coarsest = static_cast<std::size_t>(coarsest_due(tick));
  const std::size_t count = flocks_until_[coarsest];
  parallel::parallel_for(count, serial_below(levels_[coarsest].spheres), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Flock& flock = flocks_[n];
      const Real step = levels_[static_cast<std::size_t>(flock.pace)].step;
      const std::vector<TimedLoads> loads = loads_on(flock, tick);
      speeds_[n] = kick_and_drift(spheres, flock.begin, flock.end, loads, {step, rules.gravity, rules.drift});
      driven_work_[n] = 0;
      if (!rules.drives) continue;
      for (const TimedLoads& level : loads)
        if (level.given > 0) driven_work_[n] += work_of_driven(spheres, flock.begin, flock.end, level.loads, level.given);
    }
  });
  std::fill(driven_work_.begin() + static_cast<std::ptrdiff_t>(count), driven_work_.end(), 0);
  for (std::size_t l = coarsest; l < levels_.size(); ++l) levels_[l].speeds = {};
  for (std::size_t n = 0; n < count; ++n) levels_[static_cast<std::size_t>(flocks_[n].pace)].speeds.take(speeds_[n]);
  counts_.kicks += static_cast<std::int64_t>(levels_[coarsest].spheres);
  SphereSpeeds all;
  for (const Level& level : levels_) all.take(level.speeds);
  return all;
}

Real SphereLevels::driven_work() const {
  Real work = 0;
  for (const Real one : driven_work_) work += one;
  return work;
}

state::SphereLoad SphereLevels::load(std::size_t sphere) const {
  state::SphereLoad load;
  for (int l = 0; l <= pace(sphere); ++l) add(load, 1, levels_[static_cast<std::size_t>(l)].loads.of(sphere));
  return load;
}

state::SphereLoad SphereLevels::half_impulse(std::size_t sphere) const {
  state::SphereLoad impulse;
  for (int l = 0; l <= pace(sphere); ++l) {
    const Level& level = levels_[static_cast<std::size_t>(l)];
    add(impulse, 0.5 * level.step, level.loads.of(sphere));
  }
  return impulse;
}

void SphereLevels::columns(Archive& archive, bool loads_are_kept) {
  if (empty()) return;
  for (std::size_t l = 0; l < levels_.size(); ++l)
    archive.folder("level" + std::to_string(l), [&] { levels_[l].pairs.columns(archive); });
  if (archive.reading()) arrange();
  if (loads_are_kept)
    for (std::size_t l = 0; l < levels_.size(); ++l)
      archive.folder("loads" + std::to_string(l), [&] { levels_[l].loads.columns(archive); });
  archive("kicks", counts_.kicks);
  archive("evaluations", counts_.evaluations);
  archive("uniform_evaluations", counts_.uniform_evaluations);
}

}  // namespace sazare::engine
