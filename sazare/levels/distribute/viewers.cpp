#include "sazare/levels/distribute/viewers.hpp"

#include <algorithm>

namespace sazare::distribute {

bool Viewers::add(const Link& link, bool looks_at_steps, const Owners& owners) {
  if (link.first == Link::outside || link.second == Link::outside) return false;
  const int first = owners.owner(link.first), second = owners.owner(link.second);
  if (first == second) return false;
  const auto show = [&](Index body, int rank) {
    auto& viewers = by_body_[static_cast<std::size_t>(body)];
    const auto known = std::ranges::find(viewers, rank, &Viewer::rank);
    if (known == viewers.end())
      viewers.push_back({rank, looks_at_steps});
    else
      known->sees_steps |= looks_at_steps;
  };
  show(link.first, second);
  show(link.second, first);
  return true;
}

const Viewer& Viewers::find(Index body, int rank) const { return *std::ranges::find(of(body), rank, &Viewer::rank); }

Index Viewers::seen_of(int rank, const Owners& owners) const {
  Index count = 0;
  for (const BodyRange& range : owners.ranges(rank))
    for (Index body = range.begin; body < range.end; ++body) count += of(body).empty() ? 0 : 1;
  return count;
}

}  // namespace sazare::distribute
