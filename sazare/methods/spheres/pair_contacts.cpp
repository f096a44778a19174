#include "sazare/methods/spheres/pair_contacts.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sazare/core/lane_choice.hpp"
#include "sazare/methods/spheres/contact_kernel.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

std::vector<Index> PairContacts::find(state::Spheres& spheres, Real margin, RankTiles* ranks) {
  const std::vector<Index> order = neighbors::order_by_cell(spheres, margin);
  std::vector<Index> new_place = neighbors::places_after(order);
  Touches touches = take_touches(new_place);
  neighbors::put_in_order(spheres, order);
  if (ranks == nullptr) {
    pairs_ = neighbors::find_pairs(spheres, margin);
  } else {
    ranks->divide(std::array{spheres.size()});
    touches = hand_on(touches, *ranks);
    pairs_ = neighbors::find_pairs(spheres, margin, ranks->owners().is_own());
  }
  lay_out();
  go_on(touches);
  return new_place;
}

void PairContacts::go_over(neighbors::SpherePairs pairs, const std::vector<Index>& new_place, RankTiles* ranks) {
  Touches touches = take_touches(new_place);
  pairs_ = std::move(pairs);
  if (ranks != nullptr) {
    touches = hand_on(touches, *ranks);
    neighbors::keep_wanted(pairs_, ranks->owners().is_own());
  }
  lay_out();
  go_on(touches);
}

/// The contacts by the new places of their spheres. All that is kept by pair is given up before new pairs are sought.
PairContacts::Touches PairContacts::take_touches(const std::vector<Index>& new_place) {
  std::vector<std::size_t> first{0};  // touch of each tile
  bool some_initial_overlap = false;
  for (const TileContacts& tile : contacts_) {
    first.push_back(first.back() + tile.size());
    some_initial_overlap = some_initial_overlap || tile.has_initial_overlap();
  }
  Touches touches;
  touches.pairs.resize(first.back());
  if (table_.rolls) touches.turning.resize(first.back());
  if (table_.slips_in_part()) touches.bands.resize(first.back());
  if (some_initial_overlap) touches.initial_overlap.resize(first.back());
  parallel::parallel_for(contacts_.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile)
      for (std::size_t n = 0; n < contacts_[tile].size(); ++n) {
        const std::size_t to = first[tile] + n;
        const Contact& contact = contacts_[tile][n];
        const laws::ContactMemory<Real> memory = contacts_[tile].memory(n);
        Touch& touch = touches.pairs[to];
        touch = {new_place[static_cast<std::size_t>(contact.first.place())],
                 new_place[static_cast<std::size_t>(contact.second.place())], memory.sliding};
        if (!touches.bands.empty()) touches.bands[to] = contacts_[tile].bands(n);
        if (touch.one > touch.other) {
          // Seen from the other sphere, sliding changes its sign; rolling and twisting do not.
          std::swap(touch.one, touch.other);
          touch.sliding = zero_vector<Real>() - touch.sliding;
          if (!touches.bands.empty())
            for (Vector3& stretch : touches.bands[to].stretch) stretch = -stretch;
        }
        if (table_.rolls) touches.turning[to] = {memory.rolling, memory.twisting};
        if (some_initial_overlap) touches.initial_overlap[to] = contacts_[tile].initial_overlap(n);
      }
  });
  pairs_ = {};
  owner_ = {};
  inactive_until_ = {};
  contacts_ = {};
  return touches;
}

/// Gives each contact that goes on to the rank which works for its first sphere from now on.
PairContacts::Touches PairContacts::hand_on(const Touches& touches, RankTiles& ranks) {
  std::vector<Touches> to_each(static_cast<std::size_t>(ranks.ranks().size()));
  for (std::size_t n = 0; n < touches.pairs.size(); ++n)
    to_each[static_cast<std::size_t>(ranks.owners().owner_of_sphere(touches.pairs[n].one))].take(touches, n);
  Touches own;
  for (Touches& arrived : ranks.hand_on(std::move(to_each))) own.take_all(arrived);
  return own;
}

/// All that stands beside the pairs, as for pairs that are new.
void PairContacts::lay_out() {
  find_first_spheres();
  inactive_until_.assign(pairs_.other.size(), looked_at_next);
}

void PairContacts::find_first_spheres() {
  owner_.resize(pairs_.other.size());
  for (std::size_t i = 0; i + 1 < pairs_.first.size(); ++i)
    std::fill(owner_.begin() + pairs_.first[i], owner_.begin() + pairs_.first[i + 1],
              static_cast<std::uint16_t>(i % neighbors::tile_size));
}

/// The contacts of each tile, by pair.
void PairContacts::go_on(const Touches& touches) {
  const std::size_t spheres = pairs_.first.size() - 1;
  contacts_.resize(neighbors::tiles_of(spheres));
  std::vector<Index> touch_of(pairs_.other.size(), -1);
  parallel::parallel_for(touches.pairs.size(), 10000, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      if (const std::size_t pair = pair_of(touches.pairs[n].one, touches.pairs[n].other); pair < touch_of.size())
        touch_of[pair] = static_cast<Index>(n);
  });
  parallel::parallel_for(contacts_.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile)
      go_on(tile, touches, std::span(touch_of).first(pairs_.first[std::min((tile + 1) * neighbors::tile_size, spheres)]));
  });
}

/// The contacts of a tile. `touch_of`: by pair, to the last one of the tile, which touch it had; below 0 where none.
void PairContacts::go_on(std::size_t tile, const Touches& touches, std::span<const Index> touch_of) {
  TileContacts& contacts = contacts_[tile];
  const std::size_t begin = pairs_.first[tile * neighbors::tile_size];
  const auto apart = std::ranges::count(touch_of.subspan(begin), -1);
  contacts.reserve(touch_of.size() - begin - static_cast<std::size_t>(apart), table_.remembered());
  for (std::size_t p = begin; p < touch_of.size(); ++p) {
    if (touch_of[p] < 0) continue;
    const auto n = static_cast<std::size_t>(touch_of[p]);
    const Touch& touch = touches.pairs[n];
    contacts.add({SphereAt::at(touch.one), SphereAt::at(touch.other), 0, static_cast<std::uint32_t>(p)}, table_.remembered());
    const Turning turning = table_.rolls ? touches.turning[n] : Turning{};
    contacts.remember(contacts.size() - 1, {touch.sliding, turning.rolling, turning.twisting});
    if (!touches.bands.empty()) contacts.set_bands(contacts.size() - 1, touches.bands[n]);
    if (!touches.initial_overlap.empty() && touches.initial_overlap[n] > 0)
      contacts.set_initial_overlap(contacts.size() - 1, touches.initial_overlap[n]);
    inactive_until_[p] = in_contact;
  }
}

PairContacts::TilePart PairContacts::part(std::size_t tile) const {
  const std::size_t spheres = pairs_.first.size() - 1, begin = tile * neighbors::tile_size,
                    end = std::min(begin + neighbors::tile_size, spheres);
  const auto first = static_cast<std::ptrdiff_t>(pairs_.first[begin]), last = static_cast<std::ptrdiff_t>(pairs_.first[end]);
  TilePart part;
  for (std::size_t i = begin; i < end; ++i) part.counts.push_back(pairs_.first[i + 1] - pairs_.first[i]);
  part.other.assign(pairs_.other.begin() + first, pairs_.other.begin() + last);
  part.inactive_until.assign(inactive_until_.begin() + first, inactive_until_.begin() + last);
  part.contacts = contacts_[tile];
  part.contacts.shift_pairs(-pairs_.first[begin]);
  return part;
}

void PairContacts::assemble(std::vector<TilePart> by_tile) {
  pairs_ = {{0}, {}};
  inactive_until_ = {};
  contacts_ = {};
  for (TilePart& part : by_tile) {
    part.contacts.shift_pairs(pairs_.first.back());
    for (const std::uint32_t count : part.counts) pairs_.first.push_back(pairs_.first.back() + count);
    pairs_.other.insert(pairs_.other.end(), part.other.begin(), part.other.end());
    inactive_until_.insert(inactive_until_.end(), part.inactive_until.begin(), part.inactive_until.end());
    contacts_.push_back(std::move(part.contacts));
  }
  find_first_spheres();
}

void PairContacts::write_to(const LoadTable& loads) {
  parallel::parallel_for(contacts_.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile)
      for (std::size_t n = 0; n < contacts_[tile].size(); ++n)
        contacts_[tile].set_slot(n, loads.slot(tile, contacts_[tile][n].second.place()));
  });
}

/// The number of a pair of places; beyond the last one where it is no candidate.
std::size_t PairContacts::pair_of(Index one, Index other) const {
  const auto row = static_cast<std::size_t>(std::min(one, other));
  for (std::size_t p = pairs_.first[row]; p < pairs_.first[row + 1]; ++p)
    if (pairs_.other[p] == std::max(one, other)) return p;
  return pairs_.other.size();
}

void PairContacts::set_inactive(Index one, Index other, float until) {
  if (const std::size_t pair = pair_of(one, other); pair < inactive_until_.size()) inactive_until_[pair] = until;
}

void PairContacts::activate(Index one, Index other, Real allowed, const LoadTable& loads) {
  const std::size_t pair = pair_of(one, other);
  if (pair >= inactive_until_.size() || inactive_until_[pair] != suppressed) return;
  inactive_until_[pair] = looked_at_next;
  if (!(allowed > 0)) return;
  const std::size_t tile = static_cast<std::size_t>(std::min(one, other)) / neighbors::tile_size;
  begin_contact(tile, pair, loads);
  contacts_[tile].set_initial_overlap(contacts_[tile].size() - 1, allowed);
}

void PairContacts::suppress_within(std::span<const Index> body) {
  for (std::size_t i = 0; i + 1 < pairs_.first.size(); ++i)
    for (std::size_t p = pairs_.first[i]; p < pairs_.first[i + 1]; ++p)
      if (body[i] >= 0 && body[i] == body[static_cast<std::size_t>(pairs_.other[p])] && inactive_until_[p] != in_contact)
        inactive_until_[p] = suppressed;
}

/// Looks at the pairs of a tile that may touch by now: those that do become contacts, the others stay inactive.
[[gnu::flatten]] void PairContacts::activate_those_due(const state::Spheres& spheres, const Task& task) {
  constexpr std::size_t at_once = 256;
  std::array<std::uint32_t, at_once + choice_spare> due;
  const auto now = static_cast<float>(task.approach);
  const BoxLanes<Lanes> box(spheres.box);
  const std::size_t last = pairs_.first[task.loads.end_of(task.tile)];
  for (std::size_t begin = pairs_.first[task.loads.begin_of(task.tile)]; begin < last; begin += at_once) {
    const std::span some_inactive = std::span(inactive_until_).subspan(begin, std::min(at_once, last - begin));
    const std::size_t count = choose_up_to(now, some_inactive, static_cast<std::uint32_t>(begin), due);
    std::fill_n(due.begin() + static_cast<std::ptrdiff_t>(count), lane_count,
                due[count > 0 ? count - 1 : 0]);  // what is too much repeats one
    for (std::size_t n = 0; n < count; n += lane_count) {
      const std::span<const std::uint32_t, lane_count> some(&due[n], lane_count);
      const Lanes gap = gaps(spheres, box, task, some);
      const auto until = rounded_down * single(task.approach + gap);
      const std::size_t lanes = std::min<std::size_t>(lane_count, count - n);
      for (std::size_t lane = 0; lane < lane_count; ++lane) inactive_until_[some[lane]] = until[lane];
      if (!any(gap < 0.0)) continue;
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (gap[lane] < 0) begin_contact(task.tile, some[lane], task.loads);
    }
  }
}

/// Gaps of as many pairs of a tile as there are lanes [m].
inline Lanes PairContacts::gaps(const state::Spheres& spheres, const BoxLanes<Lanes>& box, const Task& task,
                                std::span<const std::uint32_t, lane_count> pairs) const {
  const state::SpherePlace* const own = &spheres.place[task.loads.begin_of(task.tile)];
  const auto first = load_quads([&](std::size_t lane) { return &own[owner_[pairs[lane]]].x; });
  const auto second =
      load_quads([&](std::size_t lane) { return &spheres.place[static_cast<std::size_t>(pairs_.other[pairs[lane]])].x; });
  LaneVector apart{second[0] - first[0], second[1] - first[1], second[2] - first[2]};
  return square_root(box.square_of_nearest(apart)) - (first[3] + second[3]);
}

[[gnu::noinline]] void PairContacts::begin_contact(std::size_t tile, std::size_t pair, const LoadTable& loads) {
  const Index first = static_cast<Index>(loads.begin_of(tile)) + owner_[pair], second = pairs_.other[pair];
  inactive_until_[pair] = in_contact;
  contacts_[tile].add({SphereAt::at(first), SphereAt::at(second), loads.slot(tile, second), static_cast<std::uint32_t>(pair)},
                      table_.remembered());
}

template <class Law, bool rolls>
ContactSums PairContacts::evaluate_with(const state::Spheres& spheres, Task& task) {
  return contacts_[task.tile].has_initial_overlap() ? evaluate_those<Law, rolls, true>(spheres, task)
                                                    : evaluate_those<Law, rolls, false>(spheres, task);
}

template <class Law, bool rolls, bool has_initial_overlap>
ContactSums PairContacts::evaluate_those(const state::Spheres& spheres, Task& task) {
  TileContacts& contacts = contacts_[task.tile];
  ContactKernel<Law, rolls, has_initial_overlap> kernel(*this, spheres, task);
  const std::size_t lines_at_once = 1 + task.coming.lines() * contacts.at_once / std::max<std::size_t>(contacts.size(), 1);
  for (std::size_t next = 0; next < contacts.size(); next += kernel.at_once) kernel.evaluate(next, task.coming, lines_at_once);
  kernel.part();
  return kernel.sums();
}

ContactSums PairContacts::evaluate(const state::Spheres& spheres, Task task) {
  activate_those_due(spheres, task);
  return visit_law(table_, [&]<class Law, class Rolls>(Law, Rolls) { return evaluate_with<Law, Rolls::value>(spheres, task); });
}

ComingLines PairContacts::coming(const state::Spheres& spheres, const LoadTable& loads, std::size_t tile) const {
  const std::span place(spheres.place);
  const std::span spin(spheres.spin);
  const std::size_t begin = loads.begin_of(tile), end = loads.end_of(tile), first = pairs_.first[begin],
                    count = pairs_.first[end] - first;
  ComingLines coming;
  coming.add(place, loads.ghosts(tile));
  coming.add(spin, loads.ghosts(tile));
  coming.add_row(loads.loads_of_ghosts(tile));
  coming.add_row(place.subspan(begin, end - begin));
  coming.add_row(spin.subspan(begin, end - begin));
  coming.add_row(std::span(inactive_until_).subspan(first, count));
  coming.add_row(std::span(owner_).subspan(first, count));
  coming.add_row(std::span(pairs_.other).subspan(first, count));
  contacts_[tile].add_to(coming);
  return coming;
}

void PairContacts::add_to(LargePages& pages) const {
  pages.add(inactive_until_);
  pages.add(owner_);
  pages.add(pairs_.other);
  for (const TileContacts& tile : contacts_) tile.add_to(pages);
}

void PairContacts::columns(Archive& archive) {
  archive("first", pairs_.first);
  archive("other", pairs_.other);
  archive("owner", owner_);
  archive("inactive_until", inactive_until_);
  std::vector<std::uint64_t> counts;
  std::vector<Contact> contacts;
  std::vector<Vector3> sliding, rolling;
  std::vector<Real> twisting, initial_overlap;
  std::vector<laws::SlipBands<Real>> bands;
  for (const TileContacts& tile : contacts_) {
    counts.push_back(tile.size());
    for (std::size_t n = 0; n < tile.size(); ++n) {
      const laws::ContactMemory<Real> memory = tile.memory(n);
      contacts.push_back(tile[n]);
      sliding.push_back(memory.sliding);
      initial_overlap.push_back(tile.initial_overlap(n));
      if (table_.slips_in_part()) bands.push_back(tile.bands(n));
      if (!table_.rolls) continue;
      rolling.push_back(memory.rolling);
      twisting.push_back(memory.twisting);
    }
  }
  if (std::ranges::all_of(initial_overlap, [](Real overlap) { return overlap == 0; })) initial_overlap.clear();
  archive("contacts_of_tiles", counts);
  archive("contact_records", contacts);
  archive("sliding", sliding);
  archive("rolling", rolling);
  archive("twisting", twisting);
  archive("initial_overlap", initial_overlap);
  if (table_.slips_in_part()) archive("bands", bands);
  if (!archive.reading()) return;
  contacts_.assign(counts.size(), {});
  std::size_t next = 0;
  for (std::size_t tile = 0; tile < counts.size(); ++tile) {
    contacts_[tile].reserve(counts[tile], table_.remembered());
    for (std::size_t n = 0; n < counts[tile]; ++n, ++next) {
      contacts_[tile].add(contacts[next], table_.remembered());
      laws::ContactMemory<Real> memory{.sliding = sliding[next]};
      if (table_.rolls) memory.rolling = rolling[next], memory.twisting = twisting[next];
      contacts_[tile].remember(n, memory);
      if (!bands.empty()) contacts_[tile].set_bands(n, bands[next]);
      if (!initial_overlap.empty() && initial_overlap[next] > 0) contacts_[tile].set_initial_overlap(n, initial_overlap[next]);
    }
  }
}

}  // namespace sazare::methods::spheres
