#include "sazare/levels/distribute/replicas.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace sazare::distribute {

namespace {

/// Adds the first bytes of a record.
template <class T>
void append(std::vector<std::byte>& bytes, const T& record, std::size_t count) {
  const auto* begin = reinterpret_cast<const std::byte*>(&record);
  bytes.insert(bytes.end(), begin, begin + count);
}

/// The message for a rank, begun where there is none yet.
std::vector<std::byte>& bytes_for(std::vector<parallel::Message>& messages, int rank) {
  const auto known = std::ranges::find(messages, rank, &parallel::Message::rank);
  if (known != messages.end()) return known->bytes;
  return messages.emplace_back(parallel::Message{rank, {}}).bytes;
}

}  // namespace

template <int D>
Replicas<D>::Replicas(const parallel::Ranks& ranks, state::Bodies<D>& bodies, const Terms& terms)
    : ranks_(&ranks), bodies_(&bodies), terms_(&terms) {
  divide(cut_evenly(std::vector<Real>(at(bodies.size()), 1), ranks.size()));
}

template <int D>
void Replicas<D>::share_out(std::span<const Index> bodies, std::vector<Index>& own, std::vector<Index>& seen) const {
  for (const Index body : bodies) {
    const Role role = role_[at(body)];
    if (role != Role::unseen) (role == Role::own ? own : seen).push_back(body);
  }
}

template <int D>
void Replicas<D>::add_link(const Link& link) {
  if (link.first == Link::outside || link.second == Link::outside) return;
  const int first = ranges_.owner(link.first), second = ranges_.owner(link.second);
  if (first == second) return;
  const auto show = [&](Index body, int rank) {
    auto& viewers = viewers_[at(body)];
    if (std::ranges::find(viewers, rank) == viewers.end()) viewers.push_back(rank);
    if (rank == ranks_->rank()) role_[at(body)] = Role::seen;
  };
  show(link.first, second);
  show(link.second, first);
}

template <int D>
typename Replicas<D>::Moving Replicas<D>::moving(Index body) const {
  return {bodies_->motion[at(body)], bodies_->inertia[at(body)],
          bodies_->strain.empty() ? state::Strain{} : bodies_->strain[at(body)]};
}

template <int D>
void Replicas<D>::take(Index body, const Moving& moving) {
  bodies_->motion[at(body)] = moving.motion;
  bodies_->inertia[at(body)] = moving.inertia;
  if (!bodies_->strain.empty()) bodies_->strain[at(body)] = moving.strain;
}

template <int D>
void Replicas<D>::exchange(std::span<const Index> kicked, std::span<const Index> kicked_elsewhere) {
  sent_.clear();
  received_.clear();
  for (const Index body : kicked)
    for (const int rank : viewers_[at(body)]) append(bytes_for(sent_, rank), moving(body), moving_size());
  for (const Index body : kicked_elsewhere) {
    auto& bytes = bytes_for(received_, ranges_.owner(body));
    bytes.resize(bytes.size() + moving_size());
  }
  if (sent_.empty() && received_.empty()) return;
  ranks_->exchange(sent_, received_);
  std::vector<std::size_t> next(received_.size(), 0);
  for (const Index body : kicked_elsewhere) {
    const auto from = std::ranges::find(received_, ranges_.owner(body), &parallel::Message::rank);
    std::size_t& place = next[static_cast<std::size_t>(from - received_.begin())];
    Moving arrived;
    std::memcpy(static_cast<void*>(&arrived), from->bytes.data() + place, moving_size());
    place += moving_size();
    take(body, arrived);
  }
}

template <int D>
void Replicas<D>::unite(std::vector<Index>& list) const {
  const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(list)));
  list.resize(all.bytes.size() / sizeof(Index));
  if (!list.empty()) std::memcpy(list.data(), all.bytes.data(), all.bytes.size());
  Peers::unite(list);
}

template <int D>
std::vector<std::byte> Replicas<D>::gather(std::span<const std::byte> own) const {
  return ranks_->gather(own).bytes;
}

template <int D>
void Replicas<D>::fetch(std::span<const Index> bodies) {
  Parcel own;
  for (const Index body : bodies)
    if (owns(body)) {
      Moving known = moving(body);
      own(known);
    }
  const parallel::Gathered all = ranks_->gather(own.packed());
  std::vector<Parcel> from;
  from.reserve(at(ranks_->size()));
  for (int rank = 0; rank < ranks_->size(); ++rank) from.emplace_back(all.of(rank));
  for (const Index body : bodies) {
    Moving arrived;
    from[at(ranges_.owner(body))](arrived);
    if (!owns(body)) take(body, arrived);
  }
}

template <int D>
void Replicas<D>::fetch_all() {
  std::vector<Index> all(at(bodies_->size()));
  std::iota(all.begin(), all.end(), 0);
  fetch(all);
}

template <int D>
void Replicas<D>::carry_range(int rank, std::vector<terms::CauseWork>& work, Parcel& parcel) {
  for (Index body = ranges_.begin(rank); body < ranges_.end(rank); ++body) {
    parcel(bodies_->motion[at(body)]);
    parcel(bodies_->inertia[at(body)]);
    if (!bodies_->strain.empty()) parcel(bodies_->strain[at(body)]);
    parcel(work[at(body)]);
  }
  for (const auto& term : *terms_) {
    const auto links = term->links();
    for (std::size_t link = 0; link < links.size(); ++link)
      if (links[link].first != Link::outside && ranges_.owner(links[link].first) == rank)
        term->carry(static_cast<Index>(link), parcel);
  }
}

template <int D>
void Replicas<D>::collect(std::vector<terms::CauseWork>& work, parallel::To to) {
  Parcel own;
  if (to == parallel::To::all || !ranks_->is_first()) carry_range(ranks_->rank(), work, own);
  const parallel::Gathered all = ranks_->gather(own.packed(), to);
  if (to == parallel::To::first && !ranks_->is_first()) return;
  for (int rank = 0; rank < ranks_->size(); ++rank) {
    if (rank == ranks_->rank()) continue;
    Parcel arrived(all.of(rank));
    carry_range(rank, work, arrived);
  }
  for (const auto& term : *terms_) term->carried();
}

template <int D>
void Replicas<D>::divide(Ranges ranges) {
  ranges_ = std::move(ranges);
  viewers_.assign(at(bodies_->size()), {});
  role_.assign(at(bodies_->size()), Role::unseen);
  std::fill_n(role_.begin() + ranges_.begin(ranks_->rank()), ranges_.size(ranks_->rank()), Role::own);
  for (const auto& term : *terms_) {
    const auto links = term->links();
    for (const Index link : term->first_links()) add_link(links[at(link)]);
  }
}

template class Replicas<2>;
template class Replicas<3>;

}  // namespace sazare::distribute
