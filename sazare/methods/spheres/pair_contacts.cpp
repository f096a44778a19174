#include "sazare/methods/spheres/pair_contacts.hpp"

#include <array>
#include <cmath>
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
  permute(spheres.number, order);
  std::vector<Index> new_place(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) new_place[static_cast<std::size_t>(order[n])] = static_cast<Index>(n);
  const neighbors::SpherePairs before = std::exchange(pairs_, neighbors::find_pairs(spheres, margin));
  carry_over(before, new_place);
  return order;
}

void PairContacts::carry_over(const neighbors::SpherePairs& before, const std::vector<Index>& new_place) {
  const auto touched = std::exchange(touches_, std::vector<std::uint8_t>(pairs_.other.size()));
  const auto slid = std::exchange(sliding_, std::vector<Memory>(pairs_.other.size()));
  const auto rolled = std::exchange(rolling_, std::vector<Memory>(table_.rolls ? pairs_.other.size() : 0));
  if (before.first.empty()) return;
  for (std::size_t i = 0; i + 1 < before.first.size(); ++i)
    for (std::size_t p = before.first[i]; p < before.first[i + 1]; ++p) {
      if (touched[p] == 0) continue;
      const Index one = new_place[i], other = new_place[static_cast<std::size_t>(before.other[p])];
      const auto row = static_cast<std::size_t>(std::min(one, other));
      for (std::size_t q = pairs_.first[row]; q < pairs_.first[row + 1]; ++q) {
        if (pairs_.other[q] != std::max(one, other)) continue;
        touches_[q] = 1;
        sliding_[q] = slid[p];
        // Seen from the other sphere, sliding changes its sign; rolling does not.
        if (one > other) sliding_[q] = {-slid[p].x, -slid[p].y, -slid[p].z, 0};
        if (table_.rolls) rolling_[q] = rolled[p];
      }
    }
}

void PairContacts::forget(std::size_t pair) {
  sliding_[pair] = {};
  if (table_.rolls) rolling_[pair] = {};
}

template <bool periodic>
std::size_t PairContacts::find_hits(const state::Spheres& spheres, std::size_t sphere, Hit* hits) {
  const state::SpherePlace own = spheres.place[sphere];
  const Vector3 length = spheres.box.length, inverse = spheres.box.inverse();
  std::size_t count = 0;
  for (std::uint32_t p = pairs_.first[sphere]; p < pairs_.first[sphere + 1]; ++p) {
    const state::SpherePlace& other = spheres.place[static_cast<std::size_t>(pairs_.other[p])];
    Real dx = other.x - own.x, dy = other.y - own.y, dz = other.z - own.z;
    if constexpr (periodic) {
      dx -= length.x() * std::nearbyint(dx * inverse.x());
      dy -= length.y() * std::nearbyint(dy * inverse.y());
      dz -= length.z() * std::nearbyint(dz * inverse.z());
    }
    const Real reach = own.radius + other.radius;
    const bool now = dx * dx + dy * dy + dz * dz < reach * reach;
    hits[count] = {static_cast<Index>(sphere), p};
    count += now ? 1 : 0;
    if (touches_[p] > static_cast<std::uint8_t>(now)) forget(p);
    touches_[p] = static_cast<std::uint8_t>(now);
  }
  return count;
}

template <laws::ContactModel model, bool rolls>
ContactSums PairContacts::evaluate_with(const state::Spheres& spheres, std::size_t block, Real step, LoadTable& loads) {
  constexpr std::size_t enough = 256;
  std::vector<Hit> hits(enough);
  ContactKernel<model, rolls> kernel(*this, spheres, step, loads);
  std::size_t count = 0;
  const bool periodic = spheres.box.repeats();
  for (std::size_t i = loads.begin_of(block); i < loads.end_of(block); ++i) {
    const std::size_t most = count + pairs_.first[i + 1] - pairs_.first[i];
    if (most >= hits.size()) hits.resize(2 * most);
    count += periodic ? find_hits<true>(spheres, i, &hits[count]) : find_hits<false>(spheres, i, &hits[count]);
    if (count < enough) continue;
    std::size_t next = 0;
    for (; next + lane_count <= count; next += lane_count) kernel.evaluate(&hits[next], lane_count);
    std::copy(hits.begin() + static_cast<std::ptrdiff_t>(next), hits.begin() + static_cast<std::ptrdiff_t>(count), hits.begin());
    count -= next;
  }
  for (std::size_t next = 0; next < count; next += lane_count)
    kernel.evaluate(&hits[next], static_cast<int>(std::min<std::size_t>(count - next, lane_count)));
  return kernel.sums();
}

ContactSums PairContacts::evaluate(const state::Spheres& spheres, std::size_t block, Real step, LoadTable& loads) {
  using enum laws::ContactModel;
  if (table_.model == hertz)
    return table_.rolls ? evaluate_with<hertz, true>(spheres, block, step, loads) : evaluate_with<hertz, false>(spheres, block, step, loads);
  return table_.rolls ? evaluate_with<linear, true>(spheres, block, step, loads) : evaluate_with<linear, false>(spheres, block, step, loads);
}

void PairContacts::columns(Archive& archive) {
  archive("first", pairs_.first);
  archive("other", pairs_.other);
  archive("touches", touches_);
  archive("sliding", sliding_);
  archive("rolling", rolling_);
}

}  // namespace sazare::methods::spheres
