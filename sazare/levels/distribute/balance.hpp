#pragma once

/// Who is to own what, from what the work has cost.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sazare/levels/distribute/chunk_work.hpp"
#include "sazare/levels/distribute/owners.hpp"

namespace sazare::distribute {

enum class Policy {
  fixed,          ///< one range with an equal number of bodies for each rank, for good
  measured,       ///< ranges with equal shares of the time of the last interval, spread evenly over each range [Konno2018], 3.2
  predicted,      ///< ranges: evaluations due in the next interval times their measured costs, corrected by the last prediction's
                  ///< error
  by_level,       ///< the same work at every time level for each rank, in pieces along the curve
  graph,          ///< the same work at every time level for each rank, with few links between ranks, by METIS
  random,         ///< owners drawn anew each time: a trial of what ranks tell each other
  printed,        ///< as `measured`, but as it is printed: each interval alone decides, whatever its noise
  printed_fixed,  ///< one range for each rank for good, with the same sum of N_e - i over its bodies i [Konno2018], 4.4
};

/// Words for policies, in their order.
inline constexpr std::array<std::string_view, 8> policy_names = {"fixed", "measured", "predicted", "by_level",
                                                                 "graph", "random",   "printed",   "printed_fixed"};

inline std::string_view name_of(Policy policy) { return policy_names[static_cast<std::size_t>(policy)]; }

/// Work of a rank in an interval, by kind: the links of each term, then kicks.
struct Work {
  std::vector<Real> seconds;        ///< of processor time
  std::vector<std::int64_t> count;  ///< how often it was done

  Real total() const;
};

/// What is due in the next base steps, as levels stand now; a policy looks at one of them at most.
struct Outlook {
  enum class Kind { nothing, bodies, chunks, bordering_chunks };

  std::vector<std::vector<Real>> due;  ///< by kind of work and body: how often a body's share of it is done in a base step
  ChunkWork chunks;                    ///< with borders only for `bordering_chunks`
};

class Balance {
public:
  explicit Balance(Policy policy) : policy_(policy) {}

  /// What `first` and `next` look at.
  Outlook::Kind looks_at() const;

  /// Owners for the first interval, of which nothing is measured yet: all kinds of work are taken for equally dear.
  Owners first(const Owners& now, const Outlook& outlook);

  /// Owners for the next interval. `work` is by rank.
  /// Noise of the clocks changes nothing: costs are smoothed over intervals and have a floor, and owners stay unless the
  /// imbalance is worth a change.
  Owners next(const Owners& now, const std::vector<Work>& work, const Outlook& outlook);

private:
  void measure_kinds(const std::vector<Work>& work);
  Owners cut_curve(const Owners& now) const;
  Owners share_out_chunks(const Owners& now, const ChunkWork& work, const std::vector<Real>& kind_cost) const;
  Owners draw(const ChunkWork& work, int ranks);
  void predict(const Owners& now, const std::vector<Work>& work, const std::vector<std::vector<Real>>& due);
  void learn_from_error(const Owners& now, const std::vector<Work>& work);

  Policy policy_;
  std::vector<Real> cost_;        ///< by body, as the next cut takes it
  std::vector<Real> kind_cost_;   ///< by kind, smoothed [s]
  std::vector<Real> predicted_;   ///< by body, before the correction; empty before the first prediction
  std::vector<Real> correction_;  ///< by body, smoothed: what its rank took over what was predicted
  std::uint64_t drawn_ = 0;       ///< how often owners were drawn
};

}  // namespace sazare::distribute
