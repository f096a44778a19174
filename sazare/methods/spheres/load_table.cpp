#include "sazare/methods/spheres/load_table.hpp"

#include <iterator>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

void LoadTable::arrange(const neighbors::SpherePairs& pairs, const BlockLinks& bonds) {
  spheres_ = pairs.first.size() - 1;
  blocks_ = (spheres_ + neighbors::block_size - 1) / neighbors::block_size;
  const auto pairs_of = [&](std::size_t block) {
    const std::size_t begin = pairs.first[begin_of(block)];
    return std::pair(begin, pairs.first[end_of(block)] - begin);
  };
  const auto bonds_of = [&](std::size_t block) {
    return bonds.begin.empty() ? std::pair(std::size_t{0}, std::size_t{0})
                               : std::pair(bonds.begin[block], bonds.begin[block + 1] - bonds.begin[block]);
  };
  const auto part = [](auto& column, const std::pair<std::size_t, std::size_t>& range) {
    return std::span(column).subspan(range.first, range.second);
  };
  std::vector<std::vector<Index>> guests(blocks_);
  parallel::parallel_for(blocks_, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const auto last = static_cast<Index>(end_of(block));
      for (const auto& seconds : {part(pairs.other, pairs_of(block)), part(bonds.second, bonds_of(block))})
        std::ranges::copy_if(seconds, std::back_inserter(guests[block]), [&](Index other) { return other >= last; });
      std::ranges::sort(guests[block]);
      guests[block].erase(std::unique(guests[block].begin(), guests[block].end()), guests[block].end());
    }
  });
  guest_begin_.assign(1, 0);
  for (const auto& list : guests) guest_begin_.push_back(guest_begin_.back() + list.size());
  slot_.resize(pairs.other.size());
  bond_slot_.resize(bonds.second.size());
  parallel::parallel_for(blocks_, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      find_slots(block, guests[block], part(pairs.other, pairs_of(block)), part(slot_, pairs_of(block)));
      find_slots(block, guests[block], part(bonds.second, bonds_of(block)), part(bond_slot_, bonds_of(block)));
    }
  });
  send_home(guests);
}

void LoadTable::find_slots(std::size_t block, const std::vector<Index>& guests, std::span<const Index> seconds,
                           std::span<Index> slots) const {
  const auto first = static_cast<Index>(begin_of(block)), last = static_cast<Index>(end_of(block));
  const auto guest_begin = static_cast<Index>(guest_begin_[block]);
  for (std::size_t n = 0; n < seconds.size(); ++n) {
    const auto place = static_cast<Index>(std::ranges::lower_bound(guests, seconds[n]) - guests.begin());
    slots[n] = seconds[n] < last ? seconds[n] - first : -1 - guest_begin - place;
  }
}

/// Room for all loads, and where the guests of each block belong.
void LoadTable::send_home(const std::vector<std::vector<Index>>& guests) {
  loads_.resize(spheres_);
  guests_.assign(guest_begin_.back(), {});
  homecoming_.assign(blocks_, {});
  first_visitor_.resize(blocks_);
  for (std::size_t block = 0; block < blocks_; ++block) first_visitor_[block] = block;
  for (std::size_t block = blocks_; block-- > 0;)
    for (const Index guest : guests[block]) first_visitor_[static_cast<std::size_t>(guest) / neighbors::block_size] = block;
  for (std::size_t block = 0; block < blocks_; ++block)
    for (std::size_t n = 0; n < guests[block].size(); ++n) {
      const std::size_t home = static_cast<std::size_t>(guests[block][n]) / neighbors::block_size;
      homecoming_[home].push_back(
          {guests[block][n] - static_cast<Index>(begin_of(home)), static_cast<Index>(guest_begin_[block] + n)});
    }
}

void LoadTable::clear(std::size_t block, state::SphereLoad* own) {
  std::fill(own, own + (end_of(block) - begin_of(block)), state::SphereLoad{});
  std::fill(guests_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block]),
            guests_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block + 1]), state::SphereLoad{});
}

void LoadTable::gather(std::size_t block, state::SphereLoad* own) const {
  for (const Guest& guest : homecoming_[block]) {
    state::SphereLoad& load = own[guest.local];
    const state::SphereLoad& brought = guests_[static_cast<std::size_t>(guest.load)];
    load.fx += brought.fx;
    load.fy += brought.fy;
    load.fz += brought.fz;
    load.mx += brought.mx;
    load.my += brought.my;
    load.mz += brought.mz;
  }
}

void LoadTable::columns(Archive& archive) { archive("loads", loads_); }

}  // namespace sazare::methods::spheres
