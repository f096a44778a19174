#include "sazare/methods/spheres/load_table.hpp"

#include <iterator>
#include <span>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// Of some second spheres those that stand at `last` or beyond, each once.
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
  bond_slot_.resize(bonds.second.size());
  for (std::size_t block = 0; block + 1 < bonds.begin.size(); ++block)
    for (std::size_t bond = bonds.begin[block]; bond < bonds.begin[block + 1]; ++bond)
      bond_slot_[bond] = slot(block, bonds.second[bond]);
  send_home();
}

Index LoadTable::slot(std::size_t block, Index sphere) const {
  if (static_cast<std::size_t>(sphere) < end_of(block)) return sphere - static_cast<Index>(begin_of(block));
  const auto begin = guest_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block]),
             end = guest_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block + 1]);
  return -1 - static_cast<Index>(std::lower_bound(begin, end, sphere) - guest_.begin());
}

/// Room for the loads of guests, and where they belong.
void LoadTable::send_home() {
  guests_.assign(guest_.size(), {});
  homecoming_.assign(blocks_, {});
  first_visitor_.resize(blocks_);
  for (std::size_t block = 0; block < blocks_; ++block) first_visitor_[block] = block;
  for (std::size_t block = 0; block < blocks_; ++block)
    for (std::size_t n = guest_begin_[block]; n < guest_begin_[block + 1]; ++n) {
      const std::size_t home = static_cast<std::size_t>(guest_[n]) / neighbors::block_size;
      first_visitor_[home] = std::min(first_visitor_[home], block);
      homecoming_[home].push_back({guest_[n] - static_cast<Index>(begin_of(home)), static_cast<Index>(n)});
    }
}

void LoadTable::clear(std::size_t block, state::SphereLoad* own) {
  std::fill(own, own + (end_of(block) - begin_of(block)), state::SphereLoad{});
  std::fill(guests_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block]),
            guests_.begin() + static_cast<std::ptrdiff_t>(guest_begin_[block + 1]), state::SphereLoad{});
}

void LoadTable::gather(std::size_t block, state::SphereLoad* own) const {
  constexpr std::size_t ahead = 16;  // guests come from many blocks: what they bring is on its way so many before
  const std::vector<Guest>& guests = homecoming_[block];
  for (std::size_t n = 0; n < guests.size(); ++n) {
    if (n + ahead < guests.size()) __builtin_prefetch(&guests_[static_cast<std::size_t>(guests[n + ahead].load)]);
    const Guest& guest = guests[n];
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

void LoadTable::columns(Archive& archive) {
  std::vector<state::SphereLoad> all;
  for (const auto& loads : kept_) all.insert(all.end(), loads.begin(), loads.end());
  archive("loads", all);
  if (!archive.reading()) return;
  for (std::size_t block = 0; block < blocks_; ++block)
    std::copy(all.begin() + static_cast<std::ptrdiff_t>(begin_of(block)),
              all.begin() + static_cast<std::ptrdiff_t>(end_of(block)), kept(block));
}

}  // namespace sazare::methods::spheres
