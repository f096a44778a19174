#include "sazare/levels/distribute/balance.hpp"

#include <algorithm>
#include <numeric>

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

Real sum_of(const std::vector<Real>& cost, Index begin, Index end) {
  return std::accumulate(cost.begin() + begin, cost.begin() + end, Real{0});
}

/// The time of each rank, spread evenly over its range.
std::vector<Real> measured_cost(const Ranges& now, const std::vector<Work>& work) {
  std::vector<Real> cost(at(now.end(now.count() - 1)));
  for (int rank = 0; rank < now.count(); ++rank)
    std::fill(cost.begin() + now.begin(rank), cost.begin() + now.end(rank),
              work[at(rank)].total() / std::max<Real>(1, now.size(rank)));
  return cost;
}

/// The dearest range's cost over the mean, less one.
Real excess(const Ranges& ranges, const std::vector<Real>& cost) {
  Real dearest = 0;
  for (int rank = 0; rank < ranges.count(); ++rank)
    dearest = std::max(dearest, sum_of(cost, ranges.begin(rank), ranges.end(rank)));
  const Real total = sum_of(cost, 0, static_cast<Index>(cost.size()));
  return total > 0 ? dearest * ranges.count() / total - 1 : 0;
}

}  // namespace

Real Work::total() const { return std::accumulate(seconds.begin(), seconds.end(), Real{0}); }

/// What the range of a rank took over what was predicted for it; the mean over ranks is taken out.
void Balance::learn_from_error(const Ranges& now, const std::vector<Work>& work) {
  Real took = 0;
  for (const Work& of : work) took += of.total();
  const Real foretold = sum_of(predicted_, 0, now.end(now.count() - 1));
  if (took <= 0 || foretold <= 0) return;
  std::vector<Real> newest(predicted_.size(), 1);
  for (int rank = 0; rank < now.count(); ++rank) {
    const Real of_rank = sum_of(predicted_, now.begin(rank), now.end(rank));
    const Real error = of_rank > 0 ? work[at(rank)].total() / took / (of_rank / foretold) : 1;
    std::fill(newest.begin() + now.begin(rank), newest.begin() + now.end(rank),
              std::clamp(error, 1 / largest_correction, largest_correction));
  }
  smooth(correction_, newest);
}

void Balance::predict(const Ranges& now, const std::vector<Work>& work, const std::vector<std::vector<Real>>& due) {
  std::vector<Real> kind_cost(due.size(), 0);
  for (std::size_t kind = 0; kind < due.size(); ++kind) {
    Real seconds = 0, count = 0;
    for (const Work& of : work) {
      seconds += of.seconds[kind];
      count += static_cast<Real>(of.count[kind]);
    }
    if (count > 0) kind_cost[kind] = seconds / count;
  }
  smooth(kind_cost_, kind_cost);
  if (!predicted_.empty()) learn_from_error(now, work);
  predicted_.assign(at(now.end(now.count() - 1)), 0);
  for (std::size_t kind = 0; kind < due.size(); ++kind)
    for (std::size_t body = 0; body < predicted_.size(); ++body) predicted_[body] += kind_cost_[kind] * due[kind][body];
  cost_ = predicted_;
  for (std::size_t body = 0; body < correction_.size(); ++body) cost_[body] *= correction_[body];
}

Ranges Balance::first(const Ranges& now, const std::vector<std::vector<Real>>& due) const {
  if (policy_ != Policy::predicted) return now;
  std::vector<Real> cost(at(now.end(now.count() - 1)), 0);
  for (const std::vector<Real>& kind : due)
    for (std::size_t body = 0; body < cost.size(); ++body) cost[body] += kind[body];
  return cut_evenly(cost, now.count());
}

Ranges Balance::cut(const Ranges& now, const std::vector<Work>& work, const std::vector<std::vector<Real>>& due) {
  if (policy_ == Policy::fixed) return now;
  if (policy_ == Policy::measured)
    smooth(cost_, measured_cost(now, work));
  else
    predict(now, work, due);
  const Real mean = std::accumulate(cost_.begin(), cost_.end(), Real{0}) / std::max<Real>(1, static_cast<Real>(cost_.size()));
  std::vector<Real> floored = cost_;
  for (Real& cost : floored) cost = std::max(cost, least_cost * mean);
  const Ranges next = cut_evenly(floored, now.count());
  return excess(now, floored) - excess(next, floored) > tolerated_excess ? next : now;
}

}  // namespace sazare::distribute
