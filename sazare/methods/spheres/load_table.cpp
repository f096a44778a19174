#include "sazare/methods/spheres/load_table.hpp"

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

void LoadTable::arrange(const neighbors::SpherePairs& pairs) {
  spheres_ = pairs.first.size() - 1;
  blocks_ = (spheres_ + neighbors::block_size - 1) / neighbors::block_size;
  std::vector<std::vector<Index>> guests(blocks_);
  parallel::parallel_for(blocks_, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const auto last = static_cast<Index>(end_of(block));
      for (std::size_t p = pairs.first[begin_of(block)]; p < pairs.first[end_of(block)]; ++p)
        if (pairs.other[p] >= last) guests[block].push_back(pairs.other[p]);
      std::ranges::sort(guests[block]);
      guests[block].erase(std::unique(guests[block].begin(), guests[block].end()), guests[block].end());
    }
  });
  guest_begin_.assign(1, 0);
  for (const auto& list : guests) guest_begin_.push_back(guest_begin_.back() + list.size());
  slot_.resize(pairs.other.size());
  parallel::parallel_for(blocks_, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const auto first = static_cast<Index>(begin_of(block)), last = static_cast<Index>(end_of(block));
      for (std::size_t p = pairs.first[begin_of(block)]; p < pairs.first[end_of(block)]; ++p) {
        const Index other = pairs.other[p];
        const auto place = std::ranges::lower_bound(guests[block], other) - guests[block].begin();
        slot_[p] = other < last ? other - first
                                : static_cast<Index>(-1 - static_cast<Index>(guest_begin_[block]) - static_cast<Index>(place));
      }
    }
  });
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
