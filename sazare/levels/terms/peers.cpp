#include "sazare/levels/terms/peers.hpp"

#include <algorithm>

namespace sazare::terms {

void Peers::unite(std::vector<Index>& list) const {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace sazare::terms
