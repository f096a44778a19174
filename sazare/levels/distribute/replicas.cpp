#include "sazare/levels/distribute/replicas.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace sazare::distribute {

namespace {

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
  divide(cut_equally(bodies.size(), ranks.size()));
}

template <int D>
void Replicas<D>::share_out(std::span<const Index> bodies, std::vector<Index>& own, std::vector<Index>& seen) const {
  for (const Index body : bodies) {
    const Role role = role_[at(body)];
    if (role != Role::unseen) (role == Role::own ? own : seen).push_back(body);
  }
}

template <int D>
void Replicas<D>::add_link(const terms::Term<D>& term, Index number) {
  const Link& link = term.links()[at(number)];
  if (!viewers_.add(link, term.looks_at_steps(), owners_)) return;
  for (const Index body : {link.first, link.second})
    if (!owns(body) && (owns(link.first) || owns(link.second))) role_[at(body)] = Role::seen;
}

/// Calls act(record, size) for all parts of what a rank sees of a body, see BorderBytes.
template <int D>
template <class Act>
void Replicas<D>::carry_at_border(Index body, const Viewer& viewer, Act&& act) {
  state::Motion<D>& motion = bodies_->motion[at(body)];
  act(&motion, state::bytes_for_forces<D>);
  act(&motion.due, sizeof(Tick));
  if (!bodies_->strain.empty()) act(&bodies_->strain[at(body)], sizeof(state::Strain));
  if (!viewer.sees_steps) return;
  act(&motion.velocity, sizeof(motion.velocity));
  act(&motion.spin, sizeof(motion.spin));
}

template <int D>
void Replicas<D>::exchange(std::span<const Index> kicked, std::span<const Index> kicked_elsewhere) {
  const BorderBytes<D> size(*bodies_);
  sent_.clear();
  received_.clear();
  for (const Index body : kicked)
    for (const Viewer& viewer : viewers_.of(body)) {
      auto& bytes = bytes_for(sent_, viewer.rank);
      carry_at_border(body, viewer, [&](const void* record, std::size_t count) {
        const auto* begin = static_cast<const std::byte*>(record);
        bytes.insert(bytes.end(), begin, begin + count);
      });
    }
  const auto how = [&](Index body) -> const Viewer& { return viewers_.find(body, ranks_->rank()); };
  for (const Index body : kicked_elsewhere) {
    auto& bytes = bytes_for(received_, owners_.owner(body));
    bytes.resize(bytes.size() + size.for_viewer(how(body)));
  }
  if (sent_.empty() && received_.empty()) return;
  ranks_->exchange(sent_, received_, parallel::Topic::motion);
  std::vector<const std::byte*> next;
  for (const parallel::Message& message : received_) next.push_back(message.bytes.data());
  for (const Index body : kicked_elsewhere) {
    const auto from = std::ranges::find(received_, owners_.owner(body), &parallel::Message::rank) - received_.begin();
    const std::byte*& bytes = next[static_cast<std::size_t>(from)];
    carry_at_border(body, how(body), [&](void* record, std::size_t count) {
      std::memcpy(record, bytes, count);
      bytes += count;
    });
  }
}

template <int D>
void Replicas<D>::show_borders() {
  sent_.clear();
  received_.clear();
  for (const BodyRange& range : own_ranges())
    for (Index body = range.begin; body < range.end; ++body)
      for (const Viewer& viewer : viewers_.of(body)) {
        const auto motion = std::as_bytes(std::span(&bodies_->motion[at(body)], 1));
        auto& bytes = bytes_for(sent_, viewer.rank);
        bytes.insert(bytes.end(), motion.begin(), motion.end());
      }
  const auto for_seen = [&](auto&& act) {
    for (Index body = 0; body < bodies_->size(); ++body)
      if (role_[at(body)] == Role::seen) act(body, bytes_for(received_, owners_.owner(body)));
  };
  for_seen([](Index, std::vector<std::byte>& bytes) { bytes.resize(bytes.size() + sizeof(state::Motion<D>)); });
  ranks_->exchange(sent_, received_, parallel::Topic::rows);
  std::vector<std::size_t> next(at(ranks_->size()), 0);
  for_seen([&](Index body, std::vector<std::byte>& bytes) {
    std::size_t& place = next[at(owners_.owner(body))];
    std::memcpy(static_cast<void*>(&bodies_->motion[at(body)]), bytes.data() + place, sizeof(state::Motion<D>));
    place += sizeof(state::Motion<D>);
  });
}

template <int D>
void Replicas<D>::unite(std::vector<Index>& list) const {
  const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(list)), parallel::Topic::changes);
  list.resize(all.bytes.size() / sizeof(Index));
  if (!list.empty()) std::memcpy(list.data(), all.bytes.data(), all.bytes.size());
  Peers::unite(list);
}

template <int D>
std::vector<std::byte> Replicas<D>::gather(std::span<const std::byte> own) const {
  return ranks_->gather(own, parallel::Topic::changes).bytes;
}

template <int D>
void Replicas<D>::carry_all_of(Index body, Parcel& parcel) {
  parcel(bodies_->motion[at(body)]);
  parcel(bodies_->inertia[at(body)]);
  if (!bodies_->strain.empty()) parcel(bodies_->strain[at(body)]);
}

template <int D>
void Replicas<D>::fetch(std::span<const Index> bodies) {
  Parcel own;
  for (const Index body : bodies)
    if (owns(body)) carry_all_of(body, own);
  const parallel::Gathered all = ranks_->gather(own.packed(), parallel::Topic::search);
  std::vector<Parcel> from;
  from.reserve(at(ranks_->size()));
  for (int rank = 0; rank < ranks_->size(); ++rank) from.emplace_back(all.of(rank));
  for (const Index body : bodies) carry_all_of(body, from[at(owners_.owner(body))]);
}

template <int D>
void Replicas<D>::fetch_all() {
  std::vector<Index> all(at(bodies_->size()));
  std::iota(all.begin(), all.end(), 0);
  fetch(all);
}

template <int D>
void Replicas<D>::carry_bodies(int rank, std::vector<terms::CauseWork>& work, Parcel& parcel) {
  for (const BodyRange& range : owners_.ranges(rank))
    for (Index body = range.begin; body < range.end; ++body) {
      carry_all_of(body, parcel);
      parcel(work[at(body)]);
    }
  for (const auto& term : *terms_) {
    const auto links = term->links();
    for (std::size_t link = 0; link < links.size(); ++link)
      if (links[link].first != Link::outside && owners_.owner(links[link].first) == rank)
        term->carry(static_cast<Index>(link), parcel);
  }
}

template <int D>
void Replicas<D>::collect(std::vector<terms::CauseWork>& work, parallel::To to) {
  Parcel own;
  if (to == parallel::To::all || !ranks_->is_first()) carry_bodies(ranks_->rank(), work, own);
  const parallel::Gathered all = ranks_->gather(own.packed(), parallel::Topic::state, to);
  if (to == parallel::To::first && !ranks_->is_first()) return;
  for (int rank = 0; rank < ranks_->size(); ++rank) {
    if (rank == ranks_->rank()) continue;
    Parcel arrived(all.of(rank));
    carry_bodies(rank, work, arrived);
  }
  for (const auto& term : *terms_) term->carried();
}

template <int D>
void Replicas<D>::divide(Owners owners) {
  owners_ = std::move(owners);
  viewers_.begin(bodies_->size());
  role_.assign(at(bodies_->size()), Role::unseen);
  for (const BodyRange& range : own_ranges()) std::fill(role_.begin() + range.begin, role_.begin() + range.end, Role::own);
  for (const auto& term : *terms_)
    for (const Index link : term->first_links()) add_link(*term, link);
}

template class Replicas<2>;
template class Replicas<3>;

}  // namespace sazare::distribute
