#include "sazare/levels/schedule/levels.hpp"

#include <algorithm>

namespace sazare::schedule {

int level_for(Real step_seconds, Real base_seconds) {
  int level = 0;
  while (level < deepest_level && base_seconds > step_seconds) {
    base_seconds /= 2;
    ++level;
  }
  return level;
}

void Buckets::insert(Index item, int level) {
  const auto at = static_cast<std::size_t>(item);
  if (at >= level_.size()) {
    level_.resize(at + 1, absent);
    place_.resize(at + 1, 0);
  }
  auto& members = members_[static_cast<std::size_t>(level)];
  if (!members.empty() && members.back() > item) unsorted_[static_cast<std::size_t>(level)] = true;
  level_[at] = static_cast<std::int8_t>(level);
  place_[at] = static_cast<Index>(members.size());
  members.push_back(item);
  used_ |= 1U << level;
  ++size_;
}

void Buckets::erase(Index item) {
  const auto at = static_cast<std::size_t>(item);
  const auto level = static_cast<std::size_t>(level_[at]);
  auto& members = members_[level];
  const auto place = static_cast<std::size_t>(place_[at]);
  if (place + 1 != members.size()) {
    members[place] = members.back();
    place_[static_cast<std::size_t>(members[place])] = static_cast<Index>(place);
    unsorted_[level] = true;
  }
  members.pop_back();
  if (members.empty()) used_ &= ~(1U << level);
  level_[at] = absent;
  --size_;
}

void Buckets::move(Index item, int level) {
  erase(item);
  insert(item, level);
}

void Buckets::list_from(int level, std::vector<Index>& items) const {
  constexpr std::size_t many = 2048;  // most of fewer is in the cache of a core
  std::size_t count = 0;
  visit_from(level, [&](int finer) { count += at(finer).size(); });
  items.resize(count + 1);  // a place for what the loop below writes and does not count
  Index* next = items.data();
  if (count < many || count < level_.size() / 4) {
    visit_from(level, [&](int finer) {
      for (const Index item : at(finer)) *next++ = item;
    });
  } else {
    for (std::size_t item = 0; item < level_.size(); ++item) {  // without a branch: nobody foretells which are listed
      *next = static_cast<Index>(item);
      next += level_[item] >= level ? 1 : 0;
    }
  }
  items.resize(count);
}

void Buckets::sort() {
  if (std::ranges::find(unsorted_, true) == unsorted_.end()) return;
  for (std::size_t level = 0; level < members_.size(); ++level)
    if (unsorted_[level]) members_[level].clear();
  for (std::size_t item = 0; item < level_.size(); ++item) {
    if (level_[item] == absent || !unsorted_[static_cast<std::size_t>(level_[item])]) continue;
    auto& members = members_[static_cast<std::size_t>(level_[item])];
    place_[item] = static_cast<Index>(members.size());
    members.push_back(static_cast<Index>(item));
  }
  unsorted_.fill(false);
}

void Buckets::assign(std::vector<std::int8_t> levels) {
  for (auto& members : members_) members.clear();
  unsorted_.fill(false);
  used_ = 0;
  size_ = 0;
  level_.assign(levels.size(), absent);
  place_.assign(levels.size(), 0);
  for (std::size_t item = 0; item < levels.size(); ++item)
    if (levels[item] != absent) insert(static_cast<Index>(item), levels[item]);
}

}  // namespace sazare::schedule
