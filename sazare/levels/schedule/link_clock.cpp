#include "sazare/levels/schedule/link_clock.hpp"

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

/// Many are listed share by share, as many as there are threads, each with its part of every level: neighbours of all levels then
/// stay with one thread.
std::span<Due> LinkClock::collect(const Instant& now) {
  const int coarsest = coarsest_due(now.tick);
  std::size_t count = 0;
  buckets_.visit_from(coarsest, [&](int level) { count += buckets_.at(level).size(); });
  if (due_.size() < count) due_.resize(count);
  const std::size_t shares = count < serial_below ? 1 : static_cast<std::size_t>(parallel::threads());
  const auto part = [&](int level, std::size_t share) {
    const std::span<const Index> links = buckets_.at(level);
    const std::size_t begin = links.size() * share / shares, end = links.size() * (share + 1) / shares;
    return links.subspan(begin, end - begin);
  };
  parallel::parallel_for(shares, 2, [&](std::size_t first, std::size_t last) {
    Due* next = due_.data();
    for (std::size_t share = 0; share < last; ++share)
      buckets_.visit_from(coarsest, [&](int level) {
        const auto links = part(level, share);
        if (share >= first) give(links, level, now, next);
        next += links.size();
      });
  });
  return std::span(due_).first(count);
}

/// Forces of some links of a level act until the middle of its coming step, most of them from that of the last one.
void LinkClock::give(std::span<const Index> links, int level, Instant now, Due* due) {
  const Tick until = now.tick + stride(level) / 2;
  const auto window = [&](Index link, Tick before, Tick after) {
    return Due{link, static_cast<Real>(after - before) * now.tick_seconds,
               static_cast<Real>(after - now.tick) * now.tick_seconds};
  };
  Due usual = window(0, until - stride(level), until);
  Tick* const given = given_.data();
  for (const Index link : links) {
    const Tick before = given[link], after = std::max(before, until);
    given[link] = after;
    usual.link = link;
    *due++ = before == until - stride(level) ? usual : window(link, before, after);
  }
}

void LinkClock::columns(Archive& archive) {
  std::vector<std::int8_t> levels = buckets_.levels();
  archive("level", levels);
  archive("given", given_);
  if (archive.reading()) buckets_.assign(std::move(levels));
}

}  // namespace sazare::schedule
