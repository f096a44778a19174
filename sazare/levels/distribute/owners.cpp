#include "sazare/levels/distribute/owners.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sazare::distribute {

Owners::Owners(std::vector<int> owner, int ranks) : owner_(std::move(owner)), ranges_(static_cast<std::size_t>(ranks)) {
  for (Index body = 0; body < bodies(); ++body) {
    auto& own = ranges_[static_cast<std::size_t>(this->owner(body))];
    if (own.empty() || own.back().end != body)
      own.push_back({body, body + 1});
    else
      ++own.back().end;
  }
}

Index Owners::size(int rank) const {
  Index sum = 0;
  for (const BodyRange& range : ranges(rank)) sum += range.end - range.begin;
  return sum;
}

Owners cut_evenly(std::span<const Real> cost, int ranks) {
  const auto bodies = static_cast<Index>(cost.size());
  const Real total = std::accumulate(cost.begin(), cost.end(), Real{0});
  std::vector<int> owner(cost.size(), ranks - 1);
  Index begin = 0, next = 0;
  Real sum = 0;
  for (int rank = 1; rank < ranks; ++rank) {
    const Real share = total * rank / ranks;
    while (next < bodies && sum + cost[static_cast<std::size_t>(next)] / 2 < share) sum += cost[static_cast<std::size_t>(next++)];
    const Index least = std::min(begin + 1, bodies), most = std::max(bodies - (ranks - rank), least);
    const Index end = std::clamp(next, least, most);
    for (; next < end; ++next) sum += cost[static_cast<std::size_t>(next)];
    for (; next > end; --next) sum -= cost[static_cast<std::size_t>(next - 1)];
    std::fill(owner.begin() + begin, owner.begin() + end, rank - 1);
    begin = end;
  }
  return {std::move(owner), ranks};
}

Owners cut_equally(Index bodies, int ranks) { return cut_evenly(std::vector<Real>(static_cast<std::size_t>(bodies), 1), ranks); }

}  // namespace sazare::distribute
