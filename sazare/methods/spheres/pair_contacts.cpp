#include "sazare/methods/spheres/pair_contacts.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sazare/methods/spheres/contact_kernel.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

template <class T>
void permute(std::vector<T>& records, const std::vector<Index>& order) {
  std::vector<T> sorted(records.size());
  for (std::size_t n = 0; n < order.size(); ++n) sorted[n] = records[static_cast<std::size_t>(order[n])];
  records = std::move(sorted);
}

}  // namespace

std::vector<Index> PairContacts::find(state::Spheres& spheres, Real margin) {
  std::vector<Index> order = neighbors::order_along_curve(spheres, margin);
  permute(spheres.place, order);
  permute(spheres.spin, order);
  permute(spheres.kick, order);
  if (!spheres.turn.empty()) permute(spheres.turn, order);
  permute(spheres.number, order);
  std::vector<Index> new_place(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) new_place[static_cast<std::size_t>(order[n])] = static_cast<Index>(n);
  const Touches touches = take_touches(new_place);
  pairs_ = neighbors::find_pairs(spheres, margin);
  lay_out();
  for (std::size_t n = 0; n < touches.pairs.size(); ++n) remember(touches.pairs[n], table_.rolls ? touches.rolling[n] : Memory{});
  return order;
}

/// The touching pairs by the new places of their spheres. What was remembered by pair is given up before new pairs are sought.
PairContacts::Touches PairContacts::take_touches(const std::vector<Index>& new_place) {
  Touches touches;
  touches.pairs.reserve(static_cast<std::size_t>(std::ranges::count(sleeps_until_, 0.0F)));
  for (std::size_t p = 0; p < owner_.size(); ++p) {
    if (sleeps_until_[p] != 0) continue;
    const Memory& slid = sliding_[p];
    Touch touch{new_place[static_cast<std::size_t>(owner_[p])],
                new_place[static_cast<std::size_t>(pairs_.other[p])],
                {slid.x, slid.y, slid.z}};
    if (touch.one > touch.other) {
      // Seen from the other sphere, sliding changes its sign; rolling does not.
      std::swap(touch.one, touch.other);
      touch.sliding = Triple<Real>{} - touch.sliding;
    }
    touches.pairs.push_back(touch);
    if (table_.rolls) touches.rolling.push_back(rolling_[p]);
  }
  pairs_ = {};
  owner_ = {};
  sleeps_until_ = {};
  sliding_ = {};
  rolling_ = {};
  return touches;
}

/// All that stands beside the pairs, as for pairs that are new.
void PairContacts::lay_out() {
  const std::size_t count = pairs_.other.size();
  owner_.resize(count);
  for (std::size_t i = 0; i + 1 < pairs_.first.size(); ++i)
    std::fill(owner_.begin() + pairs_.first[i], owner_.begin() + pairs_.first[i + 1], static_cast<Index>(i));
  sleeps_until_.assign(count, looked_at_next);
  sliding_.resize(count);
  if (table_.rolls) rolling_.resize(count);
}

void PairContacts::remember(const Touch& touch, const Memory& rolled) {
  const auto row = static_cast<std::size_t>(touch.one);
  for (std::size_t p = pairs_.first[row]; p < pairs_.first[row + 1]; ++p) {
    if (pairs_.other[p] != touch.other) continue;
    sleeps_until_[p] = 0;
    sliding_[p] = {touch.sliding.x, touch.sliding.y, touch.sliding.z, 0};
    if (table_.rolls) rolling_[p] = rolled;
    return;
  }
}

void PairContacts::set_sleep(Index one, Index other, float until) {
  const auto row = static_cast<std::size_t>(std::min(one, other));
  for (std::size_t p = pairs_.first[row]; p < pairs_.first[row + 1]; ++p)
    if (pairs_.other[p] == std::max(one, other)) sleeps_until_[p] = until;
}

void PairContacts::rest_within(std::span<const Index> body) {
  for (std::size_t p = 0; p < owner_.size(); ++p) {
    const Index of = body[static_cast<std::size_t>(owner_[p])];
    if (of >= 0 && of == body[static_cast<std::size_t>(pairs_.other[p])])
      sleeps_until_[p] = std::numeric_limits<float>::infinity();
  }
}

template <laws::ContactModel model, bool rolls>
ContactSums PairContacts::evaluate_with(const state::Spheres& spheres, const Task& task) {
  constexpr std::size_t at_once = 512;  // candidates; what they touch stays in the cache
  constexpr std::size_t ahead = 48;     // pairs whose spheres are on their way to the cache: the second ones stand anywhere
  std::array<AwakePair, at_once + lane_count> awake;
  ContactKernel<model, rolls> kernel(*this, spheres, task);
  std::size_t count = 0;
  const std::size_t end = pairs_.first[task.loads.end_of(task.block)];
  const auto now = static_cast<float>(task.approach);
  for (std::size_t begin = pairs_.first[task.loads.begin_of(task.block)]; begin < end; begin += at_once) {
    for (std::size_t p = begin; p < std::min(begin + at_once, end); ++p) {
      awake[count] = {owner_[p], pairs_.other[p], static_cast<std::uint32_t>(p)};
      count += sleeps_until_[p] <= now ? 1 : 0;
    }
    std::size_t next = 0;
    for (std::size_t soon = 0; soon < std::min(count, ahead); ++soon) kernel.fetch(awake[soon]);
    for (; next + lane_count <= count; next += lane_count) {
      for (std::size_t soon = next + ahead; soon < std::min(next + ahead + lane_count, count); ++soon) kernel.fetch(awake[soon]);
      kernel.evaluate(&awake[next], lane_count);
    }
    std::copy(awake.begin() + next, awake.begin() + count, awake.begin());
    count -= next;
  }
  if (count > 0) kernel.evaluate(awake.data(), static_cast<int>(count));
  return kernel.sums();
}

ContactSums PairContacts::evaluate(const state::Spheres& spheres, const Task& task) {
  using enum laws::ContactModel;
  if (table_.model == hertz)
    return table_.rolls ? evaluate_with<hertz, true>(spheres, task) : evaluate_with<hertz, false>(spheres, task);
  return table_.rolls ? evaluate_with<linear, true>(spheres, task) : evaluate_with<linear, false>(spheres, task);
}

void PairContacts::columns(Archive& archive) {
  archive("first", pairs_.first);
  archive("other", pairs_.other);
  archive("owner", owner_);
  archive("sleeps_until", sleeps_until_);
  archive("sliding", sliding_);
  archive("rolling", rolling_);
}

}  // namespace sazare::methods::spheres
