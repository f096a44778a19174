#include "sazare/methods/spheres/load_table.hpp"

#include <iterator>
#include <span>
#include <utility>

#include "sazare/core/octets.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// Collects those of some second spheres that stand at `last` or beyond, each once.
void collect_guests(std::span<const Index> seconds, Index last, std::vector<Index>& guests) {
  std::ranges::copy_if(seconds, std::back_inserter(guests), [&](Index other) { return other >= last; });
  std::ranges::sort(guests);
  guests.erase(std::unique(guests.begin(), guests.end()), guests.end());
}

}  // namespace

void LoadTable::arrange(const neighbors::SpherePairs& pairs, const BlockLinks& bonds) {
  spheres_ = pairs.first.size() - 1;
  blocks_ = (spheres_ + neighbors::block_size - 1) / neighbors::block_size;
  forget();
  std::vector<std::vector<Index>> guests(blocks_);
  parallel::parallel_for(blocks_, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const auto last = static_cast<Index>(end_of(block));
      const std::size_t first_pair = pairs.first[begin_of(block)], last_pair = pairs.first[end_of(block)];
      collect_guests(std::span(pairs.other).subspan(first_pair, last_pair - first_pair), last, guests[block]);
      if (!bonds.begin.empty())
        collect_guests(std::span(bonds.second).subspan(bonds.begin[block], bonds.begin[block + 1] - bonds.begin[block]), last,
                       guests[block]);
    }
  });
  guest_begin_.assign(1, 0);
  for (const auto& list : guests) guest_begin_.push_back(guest_begin_.back() + list.size());
  guest_.clear();
  guest_.reserve(guest_begin_.back());
  for (const auto& list : guests) guest_.insert(guest_.end(), list.begin(), list.end());
  visited_.assign(blocks_, {});
  for (std::size_t block = 0; block < blocks_; ++block)
    for (const Index guest : guests[block])
      if (const Index home = guest / static_cast<Index>(neighbors::block_size);
          visited_[block].empty() || visited_[block].back() != home)
        visited_[block].push_back(home);
  bond_slot_.resize(bonds.second.size());
  for (std::size_t block = 0; block + 1 < bonds.begin.size(); ++block)
    for (std::size_t bond = bonds.begin[block]; bond < bonds.begin[block + 1]; ++bond)
      bond_slot_[bond] = slot(block, bonds.second[bond]);
  share_out({0, blocks_});
}

Index LoadTable::slot(std::size_t block, Index sphere) const {
  if (static_cast<std::size_t>(sphere) < end_of(block)) return sphere - static_cast<Index>(begin_of(block));
  const auto begin = guest_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block]),
             end = guest_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block + 1]);
  return -1 - static_cast<Index>(std::lower_bound(begin, end, sphere) - guest_.begin());
}

void LoadTable::share_out(std::vector<std::size_t> cuts) {
  cuts_ = std::move(cuts);
  send_home();
  late_.assign(blocks_, {});
  late_loads_.assign(blocks_, {});
  late_blocks_.assign(cuts_.size() - 1, {});
  for (std::size_t share = 1; share < late_blocks_.size(); ++share) {
    for (std::size_t block = cuts_[share]; block < cuts_[share + 1]; ++block) part_late(block, share);
    std::ranges::stable_sort(late_blocks_[share], {}, &LateBlock::after);
  }
}

/// Room for the loads of guests, and where they belong.
void LoadTable::send_home() {
  guests_.assign(guest_.size(), {});
  in_time_.assign(blocks_, {});
  for (std::size_t block = 0; block < blocks_; ++block) in_time_[block].places = {{0, end_of(block) - begin_of(block)}};
  for (std::size_t block = 0; block < blocks_; ++block)
    for (std::size_t n = guest_begin_[block]; n < guest_begin_[block + 1]; ++n) {
      const std::size_t home = static_cast<std::size_t>(guest_[n]) / neighbors::block_size;
      in_time_[home].guests.push_back({guest_[n] - static_cast<Index>(begin_of(home)), static_cast<Index>(n)});
    }
}

/// Tells the late spheres of a block from the others.
void LoadTable::part_late(std::size_t block, std::size_t share) {
  const std::size_t count = end_of(block) - begin_of(block);
  std::vector<std::uint8_t> is_late((count + together - 1) / together, 0);
  const std::vector<Guest> guests = std::move(in_time_[block].guests);
  const auto late_of = [&](const Guest& guest) -> std::uint8_t& {
    return is_late[static_cast<std::size_t>(guest.local) / together];
  };
  std::size_t after = 0;
  for (const Guest& guest : guests) {
    const auto load = static_cast<std::size_t>(guest.load);
    if (load >= guest_begin_[cuts_[share]]) break;  // guests stand in the order of the blocks that they visit
    late_of(guest) = 1;
    while (guest_begin_[after] <= load) ++after;
  }
  in_time_[block] = {};
  for (const Guest& guest : guests) (late_of(guest) != 0 ? late_ : in_time_)[block].guests.push_back(guest);
  for (std::size_t begin = 0; begin < count; begin += together) {
    auto& places = (is_late[begin / together] != 0 ? late_ : in_time_)[block].places;
    const std::size_t end = std::min(begin + together, count);
    if (!places.empty() && places.back().end == begin)
      places.back().end = end;
    else
      places.push_back({begin, end});
  }
  if (late_[block].places.empty()) return;
  late_blocks_[share].push_back({block, after});
  std::size_t late_count = 0;
  for (const PlaceRange& range : late_[block].places) late_count += range.end - range.begin;
  late_loads_[block].resize(late_count);
}

void LoadTable::clear_guests(std::size_t block) {
  std::fill(guests_.end() - static_cast<std::ptrdiff_t>(guest_begin_[block + 1]),
            guests_.end() - static_cast<std::ptrdiff_t>(guest_begin_[block]), state::SphereLoad{});
}

void LoadTable::add(const std::vector<Guest>& guests, state::SphereLoad* own) const {
  if (guests.empty()) return;
  constexpr std::size_t ahead = 16;  // guests come from many blocks: what they bring is on its way so many before
  const state::SphereLoad* const first = guests_.data() + guests_.size() - 1;
  for (std::size_t n = 0; n < guests.size(); ++n) {
    if (n + ahead < guests.size()) __builtin_prefetch(first - guests[n + ahead].load);
    const Guest& guest = guests[n];
    Real* const load = &own[guest.local].fx;
    (Octet::load(load) + Octet::load(&(first - guest.load)->fx)).store(load);
  }
}

void LoadTable::gather_in_time(std::size_t block, state::SphereLoad* own) {
  auto kept = late_loads_[block].begin();
  for (const PlaceRange& range : late_[block].places) {
    kept = std::copy(own + range.begin, own + range.end, kept);
    std::fill(own + range.begin, own + range.end, state::SphereLoad{});
  }
  add(in_time_[block].guests, own);
}

void LoadTable::gather_late(std::size_t block, state::SphereLoad* own) const {
  auto kept = late_loads_[block].begin();
  for (const PlaceRange& range : late_[block].places) {
    const auto last = kept + static_cast<std::ptrdiff_t>(range.end - range.begin);
    std::copy(kept, last, own + range.begin);
    kept = last;
  }
  add(late_[block].guests, own);
}

void LoadTable::columns(Archive& archive) {
  std::vector<state::SphereLoad> all;
  for (const auto& loads : kept_) all.insert(all.end(), loads.begin(), loads.end());
  archive("loads", all);
  if (!archive.reading()) return;
  for (std::size_t block = 0; block < blocks_; ++block)
    std::copy(all.begin() + static_cast<std::ptrdiff_t>(begin_of(block)),
              all.begin() + static_cast<std::ptrdiff_t>(end_of(block)), kept(block).begin());
}

}  // namespace sazare::methods::spheres
