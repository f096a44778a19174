#include "sazare/schedule/link_clock.hpp"

#include <algorithm>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::schedule {

namespace {

constexpr std::size_t serial_below = 2048;  // a link takes a few ns, waking a thread some microseconds

}  // namespace

void LinkClock::add(Index link, int level, Tick now) {
  buckets_.insert(link, level);
  const auto size = static_cast<std::size_t>(link) + 1;
  if (given_.size() < size) given_.resize(size);
  given_[size - 1] = now;
}

void LinkClock::remove(Index link) { buckets_.erase(link); }

void LinkClock::set_level(Index link, int level) {
  if (buckets_.level(link) != level) buckets_.move(link, level);
}

std::span<Due> LinkClock::collect(const Moment& now) {
  const int coarsest = coarsest_due(now.tick);
  std::size_t count = 0;
  for (int level = coarsest; level <= deepest_level; ++level) count += buckets_.at(level).size();
  if (due_.size() < count) due_.resize(count);
  Due* next = due_.data();
  for (int level = coarsest; level <= deepest_level; ++level) {
    const std::span<const Index> links = buckets_.at(level);
    parallel::parallel_for(links.size(), serial_below, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) next[n] = give(links[n], now.tick + stride(level) / 2, now);
    });
    next += links.size();
  }
  return std::span(due_).first(count);
}

/// A link whose force acts until some tick.
Due LinkClock::give(Index link, Tick until, const Moment& now) {
  const Tick before = given_[static_cast<std::size_t>(link)], given = std::max(before, until);
  given_[static_cast<std::size_t>(link)] = given;
  return {link, static_cast<Real>(given - before) * now.tick_seconds, static_cast<Real>(given - now.tick) * now.tick_seconds};
}

void LinkClock::columns(Archive& archive) {
  std::vector<std::int8_t> levels = buckets_.levels();
  archive("level", levels);
  archive("given", given_);
  if (archive.reading()) buckets_.assign(std::move(levels));
}

}  // namespace sazare::schedule
