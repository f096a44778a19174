#include "sazare/levels/schedule/levels.hpp"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include <algorithm>
#include <bit>

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

namespace {

/// Writes the places of levels that are as fine as one, and past the last of them.
void list_rising(std::span<const std::int8_t> levels, int level, Index* next) {
  std::size_t item = 0;
#ifdef __AVX512F__  // a register of places at a time, those that are listed pushed together
  constexpr std::size_t width = 16;
  const __m128i least = _mm_set1_epi8(static_cast<char>(level));
  __m512i places = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (; item + width <= levels.size(); item += width) {
    const __m128i some = _mm_loadu_si128(reinterpret_cast<const __m128i*>(levels.data() + item));
    const __mmask16 listed = _mm_cmpge_epi8_mask(some, least);
    _mm512_mask_storeu_epi32(next, static_cast<__mmask16>((1U << std::popcount(listed)) - 1),
                             _mm512_maskz_compress_epi32(listed, places));
    next += std::popcount(listed);
    places = _mm512_add_epi32(places, _mm512_set1_epi32(width));
  }
#endif
  for (; item < levels.size(); ++item) {
    *next = static_cast<Index>(item);
    next += levels[item] >= level ? 1 : 0;
  }
}

}  // namespace

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
    list_rising(level_, level, next);
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
