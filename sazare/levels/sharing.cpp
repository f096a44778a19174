/// The parts of a simulation that several processes of a run need.

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "sazare/levels/simulation.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::levels {

namespace {

/// Sorts borders and makes one of those between the same chunks.
void merge(std::vector<distribute::ChunkBorder>& borders) {
  std::ranges::sort(borders, {}, [](const distribute::ChunkBorder& of) { return std::pair(of.first, of.second); });
  std::size_t kept = 0;
  for (const distribute::ChunkBorder& border : borders) {
    if (kept > 0 && borders[kept - 1].first == border.first && borders[kept - 1].second == border.second)
      borders[kept - 1].times += border.times;
    else
      borders[kept++] = border;
  }
  borders.resize(kept);
}

/// Mean over ranks of what was done at each tick of an interval, over the largest of it.
Real lock_step(const std::vector<std::vector<std::int32_t>>& by_rank) {
  std::int64_t sum = 0, largest = 0;
  for (std::size_t tick = 0; tick < by_rank.front().size(); ++tick) {
    std::int32_t most = 0;
    for (const auto& work : by_rank) {
      sum += work[tick];
      most = std::max(most, work[tick]);
    }
    largest += most;
  }
  return largest > 0 ? static_cast<Real>(sum) / static_cast<Real>(largest) / static_cast<Real>(by_rank.size()) : 1;
}

}  // namespace

template <int D>
void Simulation<D>::count_work(std::size_t kind, std::size_t count, Real since) {
  own_work_.seconds[kind] += parallel::processor_seconds() - since;
  own_work_.count[kind] += static_cast<std::int64_t>(count);
  tick_work_.back() += static_cast<std::int32_t>(count);
}

template <int D>
void Simulation<D>::collect() {
  if (replicas_) replicas_->collect(work_, parallel::To::first);
}

/// Calls visit(term, link, level) for all links that act.
template <int D>
template <class Visit>
void Simulation<D>::visit_links(Visit&& visit) const {
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    const schedule::LinkClock& clock = levels_.clock(term);
    const auto links = terms_[term]->links();
    for (std::size_t number = 0; number < links.size(); ++number)
      if (clock.holds(static_cast<Index>(number))) visit(term, links[number], clock.level(static_cast<Index>(number)));
  }
}

/// By kind of work (the links of each term, then kicks) and body: how often its owner does it in a base step, as levels
/// stand now. A link of two bodies of one rank counts half for each; one between ranks is evaluated by both.
template <int D>
std::vector<std::vector<Real>> Simulation<D>::due_in_base_step(const distribute::Owners& owners) const {
  std::vector<std::vector<Real>> due(terms_.size() + 1, std::vector<Real>(at(bodies_.size()), 0));
  visit_links([&](std::size_t term, const Link& link, int level) {
    const auto times = static_cast<Real>(Tick{1} << level);
    const bool shared = link.second != Link::outside;
    const Real part = shared && owners.owner(link.first) == owners.owner(link.second) ? 0.5 : 1;
    due[term][at(link.first)] += part * times;
    if (shared) due[term][at(link.second)] += part * times;
  });
  for (Index body = 0; body < bodies_.size(); ++body)
    due.back()[at(body)] = static_cast<Real>(Tick{1} << levels_.active_level(body));
  return due;
}

/// What chunks have to do at a step of each level, as levels stand now. A link counts half for each of its bodies.
template <int D>
distribute::ChunkWork Simulation<D>::chunk_work(int ranks, bool with_borders) const {
  distribute::ChunkWork work;
  work.bodies = bodies_.size();
  work.chunk_size = distribute::chunk_size_for(bodies_.size(), ranks);
  work.due.assign(terms_.size() + 1, std::vector<Real>(distribute::ChunkWork::place(work.chunks(), 0), 0));
  visit_links([&](std::size_t term, const Link& link, int level) {
    const Index first = work.chunk(link.first);
    if (link.second == Link::outside) {
      work.due[term][work.place(first, level)] += 1;
      return;
    }
    const Index second = work.chunk(link.second);
    work.due[term][work.place(first, level)] += 0.5;
    work.due[term][work.place(second, level)] += 0.5;
    if (with_borders && first != second)
      work.borders.push_back({std::min(first, second), std::max(first, second), static_cast<Real>(Tick{1} << level)});
  });
  for (Index body = 0; body < bodies_.size(); ++body)
    work.due.back()[work.place(work.chunk(body), levels_.active_level(body))] += 1;
  merge(work.borders);
  return work;
}

/// What the choice of owners looks at.
template <int D>
distribute::Outlook Simulation<D>::outlook(distribute::Outlook::Kind kind, const distribute::Owners& owners) const {
  using Kind = distribute::Outlook::Kind;
  distribute::Outlook outlook;
  if (kind == Kind::bodies) outlook.due = due_in_base_step(owners);
  if (kind == Kind::chunks || kind == Kind::bordering_chunks)
    outlook.chunks = chunk_work(owners.ranks(), kind == Kind::bordering_chunks);
  return outlook;
}

/// By level and rank: evaluations of links and kicks at a step of the level. A link between two ranks is evaluated by both.
template <int D>
std::vector<std::vector<Real>> Simulation<D>::work_at_levels(const distribute::Owners& owners) const {
  std::vector<std::vector<Real>> work(schedule::level_count, std::vector<Real>(static_cast<std::size_t>(owners.ranks()), 0));
  const auto add = [&](int level, Index body) {
    work[static_cast<std::size_t>(level)][static_cast<std::size_t>(owners.owner(body))] += 1;
  };
  visit_links([&](std::size_t, const Link& link, int level) {
    add(level, link.first);
    if (link.second != Link::outside && owners.owner(link.second) != owners.owner(link.first)) add(level, link.second);
  });
  for (Index body = 0; body < bodies_.size(); ++body) add(levels_.active_level(body), body);
  return work;
}

template <int D>
SharingForecast Simulation<D>::forecast(distribute::Policy policy, int ranks) const {
  distribute::Balance balance(policy);
  const distribute::Owners equal = distribute::cut_equally(bodies_.size(), ranks);
  const distribute::Owners owners = balance.first(equal, outlook(balance.looks_at(), equal));
  SharingForecast forecast{distribute::lock_step(work_at_levels(owners)), bodies_.size(), 0, 0, {}};
  distribute::Viewers viewers;
  viewers.begin(bodies_.size());
  Real links = 0, twice = 0;
  visit_links([&](std::size_t term, const Link& link, int level) {
    const auto times = static_cast<Real>(Tick{1} << level);
    links += times;
    if (viewers.add(link, terms_[term]->looks_at_steps(), owners)) twice += times;
  });
  forecast.twice = links > 0 ? twice / links : 0;
  for (int rank = 0; rank < ranks; ++rank) {
    forecast.fewest = std::min(forecast.fewest, owners.size(rank));
    forecast.most = std::max(forecast.most, owners.size(rank));
    const parallel::Sent motion = viewers.motion_of(rank, owners, distribute::BorderBytes<D>(bodies_),
                                                    [&](Index body) { return levels_.active_level(body); });
    if (motion.bytes >= forecast.motion.bytes) forecast.motion = motion;
  }
  return forecast;
}

/// Of this rank, so far and now.
template <int D>
RankWork Simulation<D>::own_rank_work() const {
  RankWork own;
  own.tick = now_.tick - now_.start;
  own.rank = replicas_->ranks().rank();
  own.traffic = replicas_->ranks().traffic();
  own.expected_motion = expected_motion_;
  own.border = replicas_->viewers().seen_of(own.rank, replicas_->owners());
  own.ranges = static_cast<Index>(replicas_->own_ranges().size());
  for (const distribute::BodyRange& range : replicas_->own_ranges())
    for (Index body = range.begin; body < range.end; ++body) ++own.bodies[static_cast<std::size_t>(levels_.active_level(body))];
  return own;
}

/// Chooses owners anew from what the last interval has cost.
template <int D>
void Simulation<D>::divide_anew() {
  const int ranks = replicas_->ranks().size();
  Parcel own;
  RankWork of_rank = own_rank_work();
  own(own_work_.seconds);
  own(own_work_.count);
  own(tick_work_);
  own(of_rank);
  const parallel::Gathered gathered = replicas_->ranks().gather(own.packed(), parallel::Topic::other);
  std::vector<distribute::Work> work(static_cast<std::size_t>(ranks));
  std::vector<std::vector<std::int32_t>> tick_work(work.size());
  const std::size_t first_row = rank_work_.size();
  for (std::size_t rank = 0; rank < work.size(); ++rank) {
    Parcel arrived(gathered.of(static_cast<int>(rank)));
    arrived(work[rank].seconds);
    arrived(work[rank].count);
    arrived(tick_work[rank]);
    arrived(of_rank);
    of_rank.seconds = work[rank].total();
    rank_work_.push_back(of_rank);
  }
  for (RankWork& row : std::span(rank_work_).subspan(first_row)) row.lock_step = lock_step(tick_work);
  std::ranges::fill(own_work_.seconds, 0);
  std::ranges::fill(own_work_.count, 0);
  tick_work_.clear();
  take_owners(balance_.next(replicas_->owners(), work, outlook(balance_.looks_at(), replicas_->owners())));
}

/// Owners to begin with, of a run or of one that is resumed: of them, every process knows all of the state.
template <int D>
void Simulation<D>::begin_sharing() {
  tick_work_.clear();
  replicas_->divide(balance_.first(replicas_->owners(), outlook(balance_.looks_at(), replicas_->owners())));
  foretell_motion();
}

template <int D>
void Simulation<D>::take_owners(distribute::Owners next) {
  if (next != replicas_->owners()) {
    replicas_->collect(work_, parallel::To::all);
    replicas_->divide(std::move(next));
  }
  foretell_motion();
}

/// Adds what bodies at borders will send until owners are chosen anew.
template <int D>
void Simulation<D>::foretell_motion() {
  const parallel::Sent of_step =
      replicas_->viewers().motion_of(replicas_->ranks().rank(), replicas_->owners(), distribute::BorderBytes<D>(bodies_),
                                     [&](Index body) { return levels_.active_level(body); });
  const std::int64_t steps = interval_ - now_.tick / schedule::base_stride % interval_;
  expected_motion_.bytes += steps * of_step.bytes;
  expected_motion_.messages += steps * of_step.messages;
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace sazare::levels
