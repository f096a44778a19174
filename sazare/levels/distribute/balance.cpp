#include "sazare/levels/distribute/balance.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sazare/levels/distribute/partition.hpp"

namespace sazare::distribute {

namespace {

constexpr Real newest_share = 0.5;  // of the last interval in the smoothed costs
constexpr Real least_cost = 0.02;   // of the mean cost of a body
constexpr Real largest_correction = 4;
constexpr Real tolerated_excess = 0.02;  // of the dearest range over the mean

void smooth(std::vector<Real>& kept, const std::vector<Real>& newest) {
  if (kept.size() != newest.size()) {
    kept = newest;
    return;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] += newest_share * (newest[i] - kept[i]);
}

Real sum_of(const std::vector<Real>& cost, const Owners& owners, int rank) {
  Real sum = 0;
  for (const BodyRange& range : owners.ranges(rank))
    sum = std::accumulate(cost.begin() + range.begin, cost.begin() + range.end, sum);
  return sum;
}

Real sum_of(const std::vector<Real>& cost) { return std::accumulate(cost.begin(), cost.end(), Real{0}); }

/// The same number for all bodies of a rank.
template <class NumberOf>
std::vector<Real> spread(const Owners& owners, NumberOf&& number_of) {
  std::vector<Real> by_body(at(owners.bodies()));
  for (int rank = 0; rank < owners.ranks(); ++rank) {
    const Real number = number_of(rank);
    for (const BodyRange& range : owners.ranges(rank))
      std::fill(by_body.begin() + range.begin, by_body.begin() + range.end, number);
  }
  return by_body;
}

/// Of each body, the last interval's time of its rank over the number of the rank's bodies.
std::vector<Real> evenly_over_ranges(const Owners& owners, const std::vector<Work>& work) {
  return spread(owners, [&](int rank) { return work[at(rank)].total() / std::max<Real>(1, owners.size(rank)); });
}

/// Ranges with the same sum of N_e - i, the most contacts that body i can have with those behind it.
Owners cut_by_most_contacts(const Owners& now) {
  std::vector<Real> most(at(now.bodies()));
  for (std::size_t i = 0; i < most.size(); ++i) most[i] = static_cast<Real>(most.size() - i);
  return cut_evenly(most, now.ranks());
}

/// The dearest rank's cost over the mean, less one.
Real excess(const Owners& owners, const std::vector<Real>& cost) {
  Real dearest = 0;
  for (int rank = 0; rank < owners.ranks(); ++rank) dearest = std::max(dearest, sum_of(cost, owners, rank));
  const Real total = sum_of(cost);
  return total > 0 ? dearest * owners.ranks() / total - 1 : 0;
}

}  // namespace

Real Work::total() const { return std::accumulate(seconds.begin(), seconds.end(), Real{0}); }

/// What a rank took over what was predicted for it; the mean over ranks is taken out.
void Balance::learn_from_error(const Owners& now, const std::vector<Work>& work) {
  Real took = 0;
  for (const Work& of : work) took += of.total();
  const Real foretold = sum_of(predicted_);
  if (took <= 0 || foretold <= 0) return;
  smooth(correction_, spread(now, [&](int rank) {
           const Real of_rank = sum_of(predicted_, now, rank);
           const Real error = of_rank > 0 ? work[at(rank)].total() / took / (of_rank / foretold) : 1;
           return std::clamp(error, 1 / largest_correction, largest_correction);
         }));
}

/// What each kind of work costs, from what all ranks took for it.
void Balance::measure_kinds(const std::vector<Work>& work) {
  std::vector<Real> kind_cost(work.front().seconds.size(), 0);
  for (std::size_t kind = 0; kind < kind_cost.size(); ++kind) {
    Real seconds = 0, count = 0;
    for (const Work& of : work) {
      seconds += of.seconds[kind];
      count += static_cast<Real>(of.count[kind]);
    }
    if (count > 0) kind_cost[kind] = seconds / count;
  }
  smooth(kind_cost_, kind_cost);
}

void Balance::predict(const Owners& now, const std::vector<Work>& work, const std::vector<std::vector<Real>>& due) {
  measure_kinds(work);
  if (!predicted_.empty()) learn_from_error(now, work);
  predicted_.assign(at(now.bodies()), 0);
  for (std::size_t kind = 0; kind < due.size(); ++kind)
    for (std::size_t body = 0; body < predicted_.size(); ++body) predicted_[body] += kind_cost_[kind] * due[kind][body];
  cost_ = predicted_;
  for (std::size_t body = 0; body < correction_.size(); ++body) cost_[body] *= correction_[body];
}

Outlook::Kind Balance::looks_at() const {
  switch (policy_) {
    case Policy::predicted:
      return Outlook::Kind::bodies;
    case Policy::by_level:
    case Policy::random:
      return Outlook::Kind::chunks;
    case Policy::graph:
      return Outlook::Kind::bordering_chunks;
    default:
      return Outlook::Kind::nothing;
  }
}

Owners Balance::first(const Owners& now, const Outlook& outlook) {
  switch (policy_) {
    case Policy::fixed:
    case Policy::measured:
    case Policy::printed:
      return now;
    case Policy::printed_fixed:
      return cut_by_most_contacts(now);
    case Policy::predicted: {
      std::vector<Real> cost(at(now.bodies()), 0);
      for (const std::vector<Real>& kind : outlook.due)
        for (std::size_t body = 0; body < cost.size(); ++body) cost[body] += kind[body];
      return cut_evenly(cost, now.ranks());
    }
    case Policy::random:
      return draw(outlook.chunks, now.ranks());
    default:
      return share_out_chunks(now, outlook.chunks, std::vector<Real>(outlook.chunks.due.size(), 1));
  }
}

Owners Balance::next(const Owners& now, const std::vector<Work>& work, const Outlook& outlook) {
  switch (policy_) {
    case Policy::fixed:
    case Policy::printed_fixed:
      return now;
    case Policy::measured:
      smooth(cost_, evenly_over_ranges(now, work));
      return cut_curve(now);
    case Policy::printed:
      cost_ = evenly_over_ranges(now, work);
      return sum_of(cost_) > 0 ? cut_evenly(cost_, now.ranks()) : now;
    case Policy::predicted:
      predict(now, work, outlook.due);
      return cut_curve(now);
    case Policy::random:
      return draw(outlook.chunks, now.ranks());
    default:
      measure_kinds(work);
      return share_out_chunks(now, outlook.chunks, kind_cost_);
  }
}

Owners Balance::draw(const ChunkWork& work, int ranks) {
  return owners_of_bodies(work, partition_at_random(work.chunks(), ranks, drawn_++), ranks);
}

/// Ranges of the curve with the same cost, where that is worth it.
Owners Balance::cut_curve(const Owners& now) const {
  const Real mean = sum_of(cost_) / std::max<Real>(1, static_cast<Real>(cost_.size()));
  std::vector<Real> floored = cost_;
  for (Real& cost : floored) cost = std::max(cost, least_cost * mean);
  const Owners next = cut_evenly(floored, now.ranks());
  return excess(now, floored) - excess(next, floored) > tolerated_excess ? next : now;
}

/// Chunks with the same cost at every level, where that is worth it.
Owners Balance::share_out_chunks(const Owners& now, const ChunkWork& work, const std::vector<Real>& kind_cost) const {
  const ChunkCosts costs(work, kind_cost);
  const std::vector<int> before = owners_of_chunks(work, now);
  const std::vector<int> after = keep_numbers(
      before,
      policy_ == Policy::graph ? partition_graph(costs, work.borders, now.ranks()) : partition_by_level(costs, now.ranks()),
      now.ranks());
  const bool is_worth_it = lock_step(costs, after, now.ranks()) - lock_step(costs, before, now.ranks()) > tolerated_excess;
  return is_worth_it ? owners_of_bodies(work, after, now.ranks()) : now;
}

}  // namespace sazare::distribute
