#include "sazare/methods/spheres/stepper/levels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "sazare/methods/spheres/ranks/rank_search.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// From how many tiles on threads share the work on so many spheres: the finest levels are small, and often due.
std::size_t serial_below(std::size_t spheres) { return spheres > neighbors::tile_size ? 2 : static_cast<std::size_t>(-1); }

void add(state::SphereLoad& to, Real share, const state::SphereLoad& load) {
  to.fx += share * load.fx;
  to.fy += share * load.fy;
  to.fz += share * load.fz;
  to.mx += share * load.mx;
  to.my += share * load.my;
  to.mz += share * load.mz;
}

}  // namespace

SphereLevels::SphereLevels(std::vector<std::int8_t> level, const methods::spheres::ContactTable& table, Real base_step) {
  const int finest = level.empty() ? 0 : *std::ranges::max_element(level);
  if (finest > 0) level_ = std::move(level);
  for (int k = 0; k <= finest; ++k)
    levels_.push_back({std::ldexp(base_step, -k), methods::spheres::PairContacts(table), {}, 0, 0, {}});
}

std::size_t SphereLevels::coarsest_due(std::int64_t tick) const {
  return tick == 0 ? 0 : count() - 1 - static_cast<std::size_t>(std::countr_zero(static_cast<std::uint64_t>(tick)));
}

std::size_t SphereLevels::active_level(std::size_t sphere) const {
  std::size_t active_level = count() - 1;
  while (sphere >= levels_[active_level].spheres) --active_level;
  return active_level;
}

std::vector<std::int8_t> SphereLevels::by_place(const state::Spheres& spheres) const {
  std::vector<std::int8_t> level(level_.size());
  for (std::size_t i = 0; i < level.size(); ++i) level[i] = level_[static_cast<std::size_t>(spheres.number[i])];
  return level;
}

std::vector<Index> SphereLevels::find_among_ranks(state::Spheres& spheres, Real margin) {
  for (Level& level : levels_) level.loads = {};
  RankSearch search(*ranks_, spheres, margin, level_, finest());
  std::vector<Index> new_place = search.new_places();
  search.move();
  std::vector<neighbors::SpherePairs> pairs = search.pairs();
  for (std::size_t l = 0; l < levels_.size(); ++l) levels_[l].pairs.go_over(std::move(pairs[l]), new_place, ranks_);
  return new_place;
}

std::vector<Index> SphereLevels::find(state::Spheres& spheres, Real margin, Together together) {
  for (Level& level : levels_) level.loads = {};
  if (is_one()) return levels_.front().pairs.find(spheres, margin, ranks_);
  const std::vector<std::int8_t> level = by_place(spheres);
  auto found =
      neighbors::find_leveled_pairs(spheres, margin, {level, finest(), std::move(together.bonded), std::move(together.body)});
  std::vector<Index> new_place = neighbors::places_after(found.order);
  neighbors::put_in_order(spheres, found.order);
  if (ranks_ != nullptr) ranks_->divide(found.spheres);
  for (std::size_t l = 0; l < levels_.size(); ++l) levels_[l].pairs.go_over(std::move(found.pairs[l]), new_place, ranks_);
  return new_place;
}

SphereLevels::Level& SphereLevels::level_of(const state::Spheres& spheres, Index one, Index other) {
  if (is_one()) return levels_.front();
  const auto own = [&](Index i) { return level_[static_cast<std::size_t>(spheres.number[static_cast<std::size_t>(i)])]; };
  return levels_[static_cast<std::size_t>(std::max(own(one), own(other)))];
}

void SphereLevels::suppress_within(std::span<const Index> body) {
  for (Level& level : levels_) level.pairs.suppress_within(body);
}

void SphereLevels::suppress(const state::Spheres& spheres, Index one, Index other) {
  level_of(spheres, one, other).pairs.suppress(one, other);
}

void SphereLevels::activate(const state::Spheres& spheres, Index one, Index other, Real allowed) {
  Level& level = level_of(spheres, one, other);
  level.pairs.activate(one, other, allowed, level.loads);
}

void SphereLevels::arrange(const methods::spheres::Bonds& bonds) {
  tiles_.clear();
  batches_.clear();
  tiles_until_.resize(levels_.size());
  batches_until_.resize(levels_.size());
  std::size_t begin = 0;
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    level.spheres = level.pairs.pairs().first.size() - 1;
    const methods::spheres::TileLinks bond_ends = bonds.empty() ? methods::spheres::TileLinks{} : bonds.links(l).ends;
    if (ranks_ == nullptr) {
      level.loads.arrange(level.pairs.pairs(), bond_ends);
    } else {
      level.loads.arrange(level.pairs.pairs(), bond_ends, {ranks_->owners().is_own(), [&](auto& ghosts) {
                                                             ranks_->border().complete(ranks_->owners(), ghosts);
                                                           }});
    }
    level.pairs.write_to(level.loads);
    for (std::size_t tile = 0; tile < level.loads.tiles(); ++tile)
      if (owns(tile)) tiles_.push_back({l, tile});
    while (begin < level.spheres) {
      const std::size_t tile = begin / neighbors::tile_size, end = std::min((tile + 1) * neighbors::tile_size, level.spheres);
      if (owns(tile)) batches_.push_back({l, begin, end});
      begin = end;
    }
    tiles_until_[l] = tiles_.size();
    batches_until_[l] = batches_.size();
  }
  sums_.resize(tiles_.size());
  speeds_.resize(batches_.size());
  driven_work_.resize(batches_.size());
}

void SphereLevels::plan_border(bool with_turns) {
  std::vector<Border::Level> levels;
  for (Level& level : levels_) levels.push_back({&level.loads, level.spheres});
  ranks_->border().plan(ranks_->owners(), std::move(levels), with_turns);
}

ComingLines SphereLevels::coming(const state::Spheres& spheres, std::size_t n) const {
  const Level& level = levels_[tiles_[n].level];
  return level.pairs.coming(spheres, level.loads, tiles_[n].tile);
}

void SphereLevels::evaluate_tile(std::size_t n, const Scene& scene, state::SphereLoad* own, const ComingLines& next) {
  const auto [number, tile] = tiles_[n];
  Level& level = levels_[number];
  level.loads.clear_ghosts(tile);
  sums_[n] = level.pairs.evaluate(scene.spheres,
                                  {tile, scene.approach_of(tile), level.step, level.loads, own, next, scene.tells_energies});
  if (!scene.walls.walls().empty()) sums_[n] += scene.walls.evaluate(scene.spheres, {tile, level.step, own, number});
  if (!scene.bonds.empty())
    sums_[n] += scene.bonds.evaluate(scene.spheres, {tile, level.step, level.pairs.table(), level.loads, own, number});
  if (scene.water.empty() && scene.applied.empty()) return;
  const BodyLoadTask task{level.loads.begin_of(tile), level.loads.end_of(tile), scene.time, level.step, own, level_, number};
  if (!scene.water.empty()) sums_[n] += scene.water.evaluate(scene.spheres, task);
  if (!scene.applied.empty()) sums_[n] += scene.applied.evaluate(scene.spheres, task);
}

void SphereLevels::evaluate(std::int64_t tick, const Scene& scene) {
  const std::size_t coarsest = coarsest_due(tick), count = tiles_until_[coarsest],
                    alone_below = serial_below(levels_[coarsest].spheres);
  const auto kept = [&](std::size_t n) { return levels_[tiles_[n].level].loads.kept(tiles_[n].tile); };
  parallel::parallel_for(count, alone_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      std::ranges::fill(kept(n), state::SphereLoad{});
      evaluate_tile(n, scene, kept(n).data(), n + 1 < end ? coming(scene.spheres, n + 1) : ComingLines{});
    }
  });
  if (ranks_ != nullptr) ranks_->border().bring_loads(coarsest);
  parallel::parallel_for(count, alone_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) levels_[tiles_[n].level].loads.gather(tiles_[n].tile, kept(n).data());
  });
  count_contacts(tick);
}

void SphereLevels::count_contacts(std::int64_t tick) {
  const std::size_t coarsest = coarsest_due(tick);
  for (std::size_t l = coarsest; l < levels_.size(); ++l) levels_[l].contacts = 0;
  for (std::size_t n = 0; n < tiles_until_[coarsest]; ++n) levels_[tiles_[n].level].contacts += sums_[n].contacts;
  for (std::size_t l = coarsest; l < levels_.size(); ++l) counts_.evaluations += levels_[l].contacts;
  if (tick == 0)
    for (const Level& level : levels_) counts_.uniform_evaluations += ticks() * level.contacts;
}

std::int64_t SphereLevels::add_work(std::int64_t tick, WorkSums& sums) const {
  const auto due = std::span(sums_).first(tiles_until_[coarsest_due(tick)]);
  const std::int64_t broken_before = sums.broken;
  for (const ContactSums& tile : due) sums.add(tile);
  if (tick == 0) {
    sums.hold_nothing();
    for (const ContactSums& tile : due) sums.hold(tile);
  }
  return sums.broken - broken_before;
}

std::vector<TimedTable> SphereLevels::acting(std::size_t active_level, std::int64_t tick) const {
  const auto stride = [&](std::size_t level) { return std::int64_t{1} << (levels_.size() - 1 - level); };
  const std::int64_t next = tick + stride(active_level);
  std::vector<TimedTable> tables;
  for (std::size_t l = 0; l <= active_level; ++l) {
    const std::int64_t evaluated = tick - tick % stride(l);
    const Real halves = static_cast<Real>(2 * (next - evaluated) - stride(l));
    tables.push_back({&levels_[l].loads, evaluated == tick ? levels_[l].step : 0, 0.5 * tick_seconds() * halves});
  }
  return tables;
}

std::vector<TimedTable> SphereLevels::acting_until_now(std::size_t active_level) const {
  std::vector<TimedTable> tables;
  for (std::size_t l = 0; l <= active_level; ++l) tables.push_back({&levels_[l].loads, 0, 0.5 * levels_[l].step});
  return tables;
}

void SphereLevels::kick(std::int64_t tick, state::Spheres& spheres, const Kick& rules, ExactSum& driven_work) {
  const std::size_t coarsest = coarsest_due(tick), count = batches_until_[coarsest];
  parallel::parallel_for(count, serial_below(levels_[coarsest].spheres), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) fly(n, tick, spheres, rules);
  });
  for (std::size_t l = coarsest; l < levels_.size(); ++l) levels_[l].speeds = {};
  for (std::size_t n = 0; n < count; ++n) {
    levels_[batches_[n].active_level].speeds.take(speeds_[n]);
    driven_work += driven_work_[n];
  }
  count_kicks(levels_[coarsest].spheres);
}

/// Kicks and moves a batch.
void SphereLevels::fly(std::size_t n, std::int64_t tick, state::Spheres& spheres, const Kick& rules) {
  const auto [active_level, begin, end] = batches_[n];
  const Real step = levels_[active_level].step;
  std::vector<TimedLoads> loads;
  for (const TimedTable& level : acting(active_level, tick))
    loads.push_back({&level.loads->of(begin), level.given, level.predicted});
  speeds_[n] = kick_and_drift(spheres, begin, end, loads, {step, rules.gravity, rules.drift});
  if (!spheres.turn.empty()) turn(spheres, begin, end, step);
  driven_work_[n] = 0;
  if (!rules.drives) return;
  for (const TimedLoads& level : loads)
    if (level.given > 0) driven_work_[n] += work_of_driven(spheres, begin, end, level.loads, level.given);
}

SphereSpeeds SphereLevels::speeds() const {
  SphereSpeeds all;
  for (const Level& level : levels_) all.take(level.speeds);
  return all;
}

void SphereLevels::take_speeds(std::span<SphereSpeeds> by_tile) const {
  for (std::size_t n = 0; is_one() && n < batches_.size(); ++n) by_tile[batches_[n].begin / neighbors::tile_size] = speeds_[n];
}

void SphereLevels::collect() {
  collected_.clear();
  using Part = methods::spheres::PairContacts::TilePart;
  for (const Level& level : levels_) {
    std::vector<Part> by_tile =
        ranks_->collect<Part>(level.pairs.tiles(), [&](std::size_t tile) { return level.pairs.part(tile); });
    if (!ranks_->ranks().is_first()) continue;
    collected_.emplace_back(level.pairs.table());
    collected_.back().assemble(std::move(by_tile));
  }
}

void SphereLevels::keep_own() {
  for (Level& level : levels_) {
    std::vector<methods::spheres::PairContacts::TilePart> by_tile;
    for (std::size_t tile = 0; tile < level.pairs.tiles(); ++tile) {
      by_tile.push_back(level.pairs.part(tile));
      if (owns(tile)) continue;
      const std::size_t spheres = by_tile.back().counts.size();
      by_tile.back() = {std::vector<std::uint32_t>(spheres, 0), {}, {}, {}};
    }
    level.pairs.assemble(std::move(by_tile));
  }
  if (!ranks_->ranks().is_first()) counts_.evaluations = counts_.uniform_evaluations = 0;
}

void SphereLevels::collect_loads() {
  using Loads = std::vector<state::SphereLoad>;
  for (Level& level : levels_) {
    const auto by_tile = ranks_->collect<Loads>(level.loads.tiles(), [&](std::size_t tile) -> Loads {
      if (!level.loads.keeps(tile)) return {};
      const auto kept = level.loads.kept(tile);
      return {kept.begin(), kept.end()};
    });
    for (std::size_t tile = 0; tile < by_tile.size(); ++tile)
      if (!by_tile[tile].empty()) std::ranges::copy(by_tile[tile], level.loads.kept(tile).begin());
  }
}

SphereLevels::Counts SphereLevels::all_counts() const {
  Counts all{counts_.kicks, 0, 0};  // every rank counts all kicks
  for (const Counts& of : ranks_->to_first(counts_, parallel::Topic::rows)) {
    all.evaluations += of.evaluations;
    all.uniform_evaluations += of.uniform_evaluations;
  }
  return all;
}

Real SphereLevels::add_to_load(const state::Spheres& spheres, std::size_t sphere, const Vector3& force) {
  Level& level =
      is_one() ? levels_.front() : levels_[static_cast<std::size_t>(level_[static_cast<std::size_t>(spheres.number[sphere])])];
  state::SphereLoad& load = level.loads.kept(sphere / neighbors::tile_size)[sphere % neighbors::tile_size];
  load.fx += force.x();
  load.fy += force.y();
  load.fz += force.z();
  return level.step;
}

state::SphereLoad SphereLevels::load(std::size_t sphere) const {
  state::SphereLoad load;
  for (std::size_t l = 0; l <= active_level(sphere); ++l) add(load, 1, levels_[l].loads.of(sphere));
  return load;
}

state::SphereLoad SphereLevels::half_impulse(std::size_t sphere) const {
  state::SphereLoad impulse;
  for (std::size_t l = 0; l <= active_level(sphere); ++l) add(impulse, 0.5 * levels_[l].step, levels_[l].loads.of(sphere));
  return impulse;
}

void SphereLevels::columns(Archive& archive) {
  for (std::size_t l = 0; l < levels_.size(); ++l)
    archive.folder("level" + std::to_string(l),
                   [&] { (collected_.empty() ? levels_[l].pairs : collected_[l]).columns(archive); });
  Counts& counts = collected_counts_ ? *collected_counts_ : counts_;
  archive("kicks", counts.kicks);
  archive("evaluations", counts.evaluations);
  archive("uniform_evaluations", counts.uniform_evaluations);
  collected_counts_.reset();
}

void SphereLevels::load_columns(Archive& archive) {
  for (std::size_t l = 0; l < levels_.size(); ++l)
    archive.folder("loads" + std::to_string(l), [&] { levels_[l].loads.columns(archive); });
}

}  // namespace sazare::methods::spheres
