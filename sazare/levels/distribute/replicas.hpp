#pragma once

/// Every rank holds every body and every link, but works only for its own bodies.
///
/// A rank kicks its own bodies and evaluates all links that have one of them: those between two ranks are evaluated by both,
/// with the same result, and no force ever travels. What travels at a tick is what forces need of those kicked bodies that
/// share a link with a body of another rank; lists of what has broken; and, where a search looks farther, the bodies it looks
/// at. All else of other ranks' bodies grows old here until `collect`.
///
/// What is linked, and every level, is known everywhere: all ranks take the same decisions from the same lists.

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "sazare/levels/distribute/owners.hpp"
#include "sazare/levels/distribute/viewers.hpp"
#include "sazare/levels/terms/peers.hpp"
#include "sazare/levels/terms/term.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::distribute {

template <int D>
class Replicas final : public terms::Peers {
public:
  using Terms = std::vector<std::unique_ptr<terms::Term<D>>>;

  /// The bodies and terms are those of the simulation, and stay. Begins with as many bodies for each rank.
  Replicas(const parallel::Ranks& ranks, state::Bodies<D>& bodies, const Terms& terms);

  const parallel::Ranks& ranks() const { return *ranks_; }
  const Owners& owners() const { return owners_; }
  std::span<const BodyRange> own_ranges() const { return owners_.ranges(ranks_->rank()); }

  bool alone() const override { return false; }
  bool owns(Index body) const override { return role_[static_cast<std::size_t>(body)] == Role::own; }
  /// Whether a link is evaluated here.
  bool holds(const Link& link) const { return owns(link.first) || (link.second != Link::outside && owns(link.second)); }

  /// Appends own bodies to one list, and to the other one those of other ranks whose motion is known here at every tick.
  void share_out(std::span<const Index> bodies, std::vector<Index>& own, std::vector<Index>& seen) const;

  /// Makes a new link's bodies seen by both their owners.
  void add_link(const terms::Term<D>& term, Index link);

  /// Hands on the motion of own bodies that were kicked, and takes over that of seen bodies that were kicked elsewhere.
  /// Both lists are in the order in which bodies are due everywhere.
  void exchange(std::span<const Index> kicked, std::span<const Index> kicked_elsewhere);

  /// Makes the whole motion of all seen bodies known here, not only what forces need of it.
  void show_borders();

  /// Who sees whose bodies.
  const Viewers& viewers() const { return viewers_; }

  void unite(std::vector<Index>& list) const override;
  std::vector<std::byte> gather(std::span<const std::byte> own) const override;
  void fetch(std::span<const Index> bodies) override;

  void fetch_all();

  /// Fills in what other ranks have found for their bodies; a record by body.
  template <class Record>
  void complete(std::vector<Record>& by_body) const;

  /// Every rank's record to the first one, by rank; the others learn only their own.
  template <class Record>
  std::vector<Record> give_first(const Record& own) const;

  /// Brings everything up to date, everywhere or in the first rank: bodies, their work, and what links remember.
  void collect(std::vector<terms::CauseWork>& work, parallel::To to);

  /// New owners; everything must have been collected before.
  void divide(Owners owners);

private:
  enum class Role : std::uint8_t { unseen, seen, own };

  template <class Act>
  void carry_at_border(Index body, const Viewer& viewer, Act&& act);
  void carry_all_of(Index body, Parcel& parcel);
  void carry_bodies(int rank, std::vector<terms::CauseWork>& work, Parcel& parcel);

  const parallel::Ranks* ranks_;
  state::Bodies<D>* bodies_;
  const Terms* terms_;
  Owners owners_;
  std::vector<Role> role_;  ///< by body, here
  Viewers viewers_;
  std::vector<parallel::Message> sent_, received_;
};

template <int D>
template <class Record>
void Replicas<D>::complete(std::vector<Record>& by_body) const {
  std::vector<Record> own;
  own.reserve(static_cast<std::size_t>(owners_.size(ranks_->rank())));
  for (const BodyRange& range : own_ranges()) own.insert(own.end(), by_body.begin() + range.begin, by_body.begin() + range.end);
  const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(own)), parallel::Topic::rows);
  const std::byte* next = all.bytes.data();
  for (int rank = 0; rank < ranks_->size(); ++rank)
    for (const BodyRange& range : owners_.ranges(rank)) {
      const auto bytes = static_cast<std::size_t>(range.end - range.begin) * sizeof(Record);
      std::memcpy(static_cast<void*>(by_body.data() + range.begin), next, bytes);
      next += bytes;
    }
}

template <int D>
template <class Record>
std::vector<Record> Replicas<D>::give_first(const Record& own) const {
  const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(&own, 1)), parallel::Topic::rows, parallel::To::first);
  if (!ranks_->is_first()) return {own};
  std::vector<Record> records(all.bytes.size() / sizeof(Record));
  std::memcpy(static_cast<void*>(records.data()), all.bytes.data(), all.bytes.size());
  return records;
}

extern template class Replicas<2>;
extern template class Replicas<3>;

}  // namespace sazare::distribute
