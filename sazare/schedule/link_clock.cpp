#include "sazare/schedule/link_clock.hpp"

#include <algorithm>
#include <utility>

namespace sazare::schedule {

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

Due LinkClock::take(Index link, const Moment& now) {
  const auto at = static_cast<std::size_t>(link);
  const Tick until = now.tick + stride(buckets_.level(link)) / 2;
  const Tick acting = std::max<Tick>(0, until - given_[at]);
  given_[at] += acting;
  return {link, static_cast<Real>(acting) * now.tick_seconds, static_cast<Real>(given_[at] - now.tick) * now.tick_seconds};
}

void LinkClock::collect(const Moment& now, std::vector<Due>& due) {
  for (int level = coarsest_due(now.tick); level <= deepest_level; ++level)
    for (const Index link : buckets_.at(level)) due.push_back(take(link, now));
}

void LinkClock::columns(Archive& archive) {
  std::vector<std::int8_t> levels = buckets_.levels();
  archive("level", levels);
  archive("given", given_);
  if (archive.reading()) buckets_.assign(std::move(levels));
}

}  // namespace sazare::schedule
