#pragma once

/// Sorting what several ranks hold, each a part of it, without anyone holding all.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/parallel/give.hpp"
#include "sazare/parallel/plain_records.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::parallel {

namespace sorting {

/// Keys that cut all into a range for each rank, about as large: the first key of each range but the first one.
template <class Key>
std::vector<Key> cuts_of(const Ranks& ranks, const std::vector<Key>& sorted, Topic topic) {
  constexpr std::size_t samples = 64;  // of each rank
  std::vector<Key> own;
  for (std::size_t n = 0; n < samples && !sorted.empty(); ++n) own.push_back(sorted[sorted.size() * (2 * n + 1) / (2 * samples)]);
  std::vector<Key> all = records_in<Key>(ranks.gather(bytes_of(own), topic).bytes);
  std::ranges::sort(all);
  std::vector<Key> cuts;
  const auto parts = static_cast<std::size_t>(ranks.size());
  for (std::size_t part = 1; part < parts && !all.empty(); ++part) cuts.push_back(all[all.size() * part / parts]);
  return cuts;
}

}  // namespace sorting

/// Where each of a rank's keys comes to stand among the keys of all ranks in order, counted from 0. No two keys are equal. Each
/// rank sorts a range of the keys, of which samples say where to cut. All call it.
template <class Key>
std::vector<Index> places_among_ranks(const Ranks& ranks, const std::vector<Key>& own, Topic topic) {
  static_assert(std::is_trivially_copyable_v<Key>);
  std::vector<std::size_t> order(own.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t n) { return own[n]; });
  std::vector<Key> sorted;
  for (const std::size_t n : order) sorted.push_back(own[n]);

  const std::vector<Key> cuts = sorting::cuts_of(ranks, sorted, topic);
  std::vector<std::vector<std::byte>> to_each;
  auto begin = sorted.begin();
  for (std::size_t rank = 0; rank < static_cast<std::size_t>(ranks.size()); ++rank) {
    const auto end = rank < cuts.size() ? std::lower_bound(begin, sorted.end(), cuts[rank]) : sorted.end();
    to_each.push_back(bytes_of(std::span<const Key>(begin, end)));
    begin = end;
  }

  struct Arrived {
    Key key;
    std::size_t rank = 0;
  };
  std::vector<Arrived> arrived;
  const auto given = give(ranks, std::move(to_each), topic);
  for (std::size_t rank = 0; rank < given.size(); ++rank)
    for (const Key& key : records_in<Key>(given[rank])) arrived.push_back({key, rank});
  std::ranges::sort(arrived, {}, &Arrived::key);  // of one rank they stay in their order

  const auto count = static_cast<std::uint64_t>(arrived.size());
  const auto counts = records_in<std::uint64_t>(ranks.gather(std::as_bytes(std::span(&count, 1)), topic).bytes);
  auto place = static_cast<Index>(std::accumulate(counts.begin(), counts.begin() + ranks.rank(), std::uint64_t{0}));
  std::vector<std::vector<Index>> answers(given.size());
  for (const Arrived& one : arrived) answers[one.rank].push_back(place++);
  std::vector<std::vector<std::byte>> back;
  for (const auto& answer : answers) back.push_back(bytes_of(answer));

  std::vector<Index> places(own.size());
  std::size_t next = 0;
  for (const auto& answer : give(ranks, std::move(back), topic))
    for (const Index at : records_in<Index>(answer)) places[order[next++]] = at;
  return places;
}

}  // namespace sazare::parallel
