#include "sazare/schedule/link_clock.hpp"

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

void LinkClock::columns(Archive& archive) {
  std::vector<std::int8_t> levels = buckets_.levels();
  archive("level", levels);
  archive("given", given_);
  if (archive.reading()) buckets_.assign(std::move(levels));
}

}  // namespace sazare::schedule
