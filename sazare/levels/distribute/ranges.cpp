#include "sazare/levels/distribute/ranges.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sazare::distribute {

Ranges::Ranges(std::vector<Index> begin) : begin_(std::move(begin)) {
  owner_.resize(static_cast<std::size_t>(begin_.back()));
  for (int rank = 0; rank < count(); ++rank) std::fill(owner_.begin() + this->begin(rank), owner_.begin() + end(rank), rank);
}

Ranges cut_evenly(std::span<const Real> cost, int ranks) {
  const auto bodies = static_cast<Index>(cost.size());
  const Real total = std::accumulate(cost.begin(), cost.end(), Real{0});
  std::vector<Index> begin = {0};
  Real sum = 0;
  Index next = 0;
  for (int rank = 1; rank < ranks; ++rank) {
    const Real share = total * rank / ranks;
    while (next < bodies && sum + cost[static_cast<std::size_t>(next)] / 2 < share) sum += cost[static_cast<std::size_t>(next++)];
    const Index least = begin.back() + 1, most = bodies - (ranks - rank);
    begin.push_back(std::clamp(next, std::min(least, bodies), std::max(most, std::min(least, bodies))));
    for (; next < begin.back(); ++next) sum += cost[static_cast<std::size_t>(next)];
    for (; next > begin.back(); --next) sum -= cost[static_cast<std::size_t>(next - 1)];
  }
  begin.push_back(bodies);
  return Ranges(std::move(begin));
}

}  // namespace sazare::distribute
