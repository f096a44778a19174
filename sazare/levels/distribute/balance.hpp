#pragma once

/// Where the ranges are cut, from what their work has cost.

#include <cstdint>
#include <vector>

#include "sazare/levels/distribute/ranges.hpp"

namespace sazare::distribute {

enum class Policy {
  fixed,      ///< equal numbers of bodies, for good
  measured,   ///< equal shares of the time of the last interval, spread evenly over each range [Konno2018], 3.2
  predicted,  ///< evaluations due in the next interval times their measured costs, corrected by the last prediction's error
};

/// Work of a rank in an interval, by kind: the links of each term, then kicks.
struct Work {
  std::vector<Real> seconds;        ///< of processor time
  std::vector<std::int64_t> count;  ///< how often it was done

  Real total() const;
};

class Balance {
public:
  explicit Balance(Policy policy) : policy_(policy) {}

  Policy policy() const { return policy_; }

  /// Ranges for the first interval, of which nothing is measured yet: `predicted` takes all kinds of work for equally dear.
  Ranges first(const Ranges& now, const std::vector<std::vector<Real>>& due) const;

  /// Ranges for the next interval. `work` is by rank; `due` is by kind and body: how often a body's share of that kind
  /// will be done in a base step (looked at by `predicted` only).
  /// Noise of the clocks does not move the cuts: costs are smoothed over intervals and have a floor, and cuts stay where
  /// they are unless the imbalance is worth it.
  Ranges cut(const Ranges& now, const std::vector<Work>& work, const std::vector<std::vector<Real>>& due);

private:
  void predict(const Ranges& now, const std::vector<Work>& work, const std::vector<std::vector<Real>>& due);
  void learn_from_error(const Ranges& now, const std::vector<Work>& work);

  Policy policy_;
  std::vector<Real> cost_;        ///< by body, as the next cut takes it
  std::vector<Real> kind_cost_;   ///< by kind, smoothed [s]
  std::vector<Real> predicted_;   ///< by body, before the correction; empty before the first prediction
  std::vector<Real> correction_;  ///< by body, smoothed: what its range took over what was predicted
};

}  // namespace sazare::distribute
