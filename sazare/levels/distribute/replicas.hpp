#pragma once

/// Every rank holds every body and every link, but works only for its own range of bodies.
///
/// A rank kicks its own bodies and evaluates all links that have one of them: those between two ranges are evaluated twice,
/// with the same result, and no force ever travels. What travels at a tick is the motion of those kicked bodies that share
/// a link with another range; lists of what has broken; and, where a search looks farther, the bodies it looks at. All else
/// of other ranges grows old here until `collect`.
///
/// What is linked, and every level, is known everywhere: all ranks take the same decisions from the same lists.

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "sazare/levels/distribute/ranges.hpp"
#include "sazare/levels/terms/peers.hpp"
#include "sazare/levels/terms/term.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::distribute {

template <int D>
class Replicas final : public terms::Peers {
public:
  using Terms = std::vector<std::unique_ptr<terms::Term<D>>>;

  /// The bodies and terms are those of the simulation, and stay. Begins with equal ranges.
  Replicas(const parallel::Ranks& ranks, state::Bodies<D>& bodies, const Terms& terms);

  const parallel::Ranks& ranks() const { return *ranks_; }
  const Ranges& ranges() const { return ranges_; }

  bool alone() const override { return false; }
  bool owns(Index body) const override { return role_[static_cast<std::size_t>(body)] == Role::own; }
  /// Whether a link is evaluated here.
  bool holds(const Link& link) const { return owns(link.first) || (link.second != Link::outside && owns(link.second)); }

  /// Appends own bodies to one list, and to the other one those of other ranges whose motion is known here at every tick.
  void share_out(std::span<const Index> bodies, std::vector<Index>& own, std::vector<Index>& seen) const;

  /// Makes a new link's bodies seen by both their owners.
  void add_link(const Link& link);

  /// Hands on the motion of own bodies that were kicked, and takes over that of seen bodies that were kicked elsewhere.
  /// Both lists are in the order in which bodies are due everywhere.
  void exchange(std::span<const Index> kicked, std::span<const Index> kicked_elsewhere);

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

  /// New ranges; everything must have been collected before.
  void divide(Ranges ranges);

private:
  enum class Role : std::uint8_t { unseen, seen, own };

  struct Moving {
    state::Motion<D> motion;
    state::Inertia<D> inertia;
    state::Strain strain;  ///< sent only where bodies have one
  };
  /// Bytes of it that are sent.
  std::size_t moving_size() const { return bodies_->strain.empty() ? offsetof(Moving, strain) : sizeof(Moving); }

  Moving moving(Index body) const;
  void take(Index body, const Moving& moving);
  void carry_range(int rank, std::vector<terms::CauseWork>& work, Parcel& parcel);

  const parallel::Ranks* ranks_;
  state::Bodies<D>* bodies_;
  const Terms* terms_;
  Ranges ranges_;
  std::vector<Role> role_;                 ///< by body, here
  std::vector<std::vector<int>> viewers_;  ///< by body: other ranks that see it
  std::vector<parallel::Message> sent_, received_;
};

template <int D>
template <class Record>
void Replicas<D>::complete(std::vector<Record>& by_body) const {
  const auto own = std::span(by_body).subspan(static_cast<std::size_t>(ranges_.begin(ranks_->rank())),
                                              static_cast<std::size_t>(ranges_.size(ranks_->rank())));
  const parallel::Gathered all = ranks_->gather(std::as_bytes(own));
  std::memcpy(static_cast<void*>(by_body.data()), all.bytes.data(), all.bytes.size());
}

template <int D>
template <class Record>
std::vector<Record> Replicas<D>::give_first(const Record& own) const {
  const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(&own, 1)), parallel::To::first);
  if (!ranks_->is_first()) return {own};
  std::vector<Record> records(all.bytes.size() / sizeof(Record));
  std::memcpy(static_cast<void*>(records.data()), all.bytes.data(), all.bytes.size());
  return records;
}

extern template class Replicas<2>;
extern template class Replicas<3>;

}  // namespace sazare::distribute
