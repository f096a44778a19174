#include "sazare/methods/spheres/load_table.hpp"

#include <algorithm>

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
  guest_begin_.assign(1, spheres_);
  for (const auto& list : guests) guest_begin_.push_back(guest_begin_.back() + list.size());
  slot_.resize(pairs.other.size());
  parallel::parallel_for(blocks_, 2, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> place(spheres_);
    for (std::size_t block = begin; block < end; ++block) {
      for (std::size_t n = 0; n < guests[block].size(); ++n)
        place[static_cast<std::size_t>(guests[block][n])] = static_cast<Index>(guest_begin_[block] + n);
      const auto last = static_cast<Index>(end_of(block));
      for (std::size_t p = pairs.first[begin_of(block)]; p < pairs.first[end_of(block)]; ++p)
        slot_[p] = pairs.other[p] < last ? pairs.other[p] : place[static_cast<std::size_t>(pairs.other[p])];
    }
  });
  loads_.assign(guest_begin_.back(), {});
  homecoming_.assign(blocks_, {});
  for (std::size_t block = 0; block < blocks_; ++block)
    for (std::size_t n = 0; n < guests[block].size(); ++n) {
      const auto sphere = static_cast<std::size_t>(guests[block][n]);
      homecoming_[sphere / neighbors::block_size].push_back({guests[block][n], static_cast<Index>(guest_begin_[block] + n)});
    }
}

void LoadTable::clear(std::size_t block) {
  std::fill(loads_.begin() + static_cast<std::ptrdiff_t>(begin_of(block)), loads_.begin() + static_cast<std::ptrdiff_t>(end_of(block)),
            state::SphereLoad{});
  std::fill(loads_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block]),
            loads_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block + 1]), state::SphereLoad{});
}

void LoadTable::gather(std::size_t block) {
  for (const Guest& guest : homecoming_[block]) {
    state::SphereLoad& load = loads_[static_cast<std::size_t>(guest.sphere)];
    const state::SphereLoad& brought = loads_[static_cast<std::size_t>(guest.load)];
    load.fx += brought.fx;
    load.fy += brought.fy;
    load.fz += brought.fz;
    load.mx += brought.mx;
    load.my += brought.my;
    load.mz += brought.mz;
  }
}

void LoadTable::columns(Archive& archive) {
  std::vector<state::SphereLoad> own(loads_.begin(), loads_.begin() + static_cast<std::ptrdiff_t>(spheres_));
  archive("loads", own);
  if (archive.reading()) std::ranges::copy(own, loads_.begin());
}

}  // namespace sazare::methods::spheres
