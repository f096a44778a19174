#pragma once

/// Contacts between spheres: candidates, which of them touch, what they remember, and their forces in lanes.
///
/// A pair that does not touch sleeps: it is looked at again when any two spheres may have come nearer to each other by as much as
/// its gap. So a step reads one small number of each candidate, and evaluates little more than the pairs that touch. These stand
/// one after the other, block by block: what they remember is read and written in one stream. A pair that has come to touch is
/// put at the end, and the last one takes the place of one that parts.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sazare/methods/spheres/block_contacts.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/load_rows.hpp"
#include "sazare/methods/spheres/load_table.hpp"

namespace sazare::methods::spheres {

class PairContacts {
public:
  explicit PairContacts(ContactTable table) : table_(std::move(table)) {}

  /// Sorts the spheres along a curve and finds all pairs nearer than the margin [m]; what touches goes on remembering.
  /// Returns the place before of each sphere. `write_to` is to follow.
  std::vector<Index> find(state::Spheres& spheres, Real margin);

  /// Goes over to these pairs of spheres that are sorted anew; `new_place` says by place where each of them comes to stand. What
  /// touches goes on remembering. `write_to` is to follow.
  void go_over(neighbors::SpherePairs pairs, const std::vector<Index>& new_place);

  /// Tells the contacts where their loads add up.
  void write_to(const LoadTable& loads);

  /// A pair of places that is bonded has no contact until it is woken.
  void rest(Index one, Index other) { set_sleep(one, other, at_rest); }
  /// The pair may touch from the next evaluation on, and pushes beyond the overlap `allowed` alone [m]. Does nothing where it is
  /// awake.
  void wake(Index one, Index other, Real allowed, const LoadTable& loads);

  /// Lets all pairs of one body that do not touch rest, as `rest` does; `body` says by place which, below 0 where none.
  void rest_within(std::span<const Index> body);

  /// A block, and where its forces go.
  struct Task {
    std::size_t block = 0;
    Real approach = 0;  ///< how much nearer any two spheres may have come since `find` [m]
    Real step = 0;      ///< [s]
    LoadTable& loads;
    state::SphereLoad* own;      ///< the loads of the block's spheres
    ComingLines coming = {};     ///< what will be needed next, asked for on the way
    bool tells_energies = true;  ///< whether the sums are to tell what contacts hold; works they always tell
  };

  /// Adds the forces of a block's pairs to the loads.
  ContactSums evaluate(const state::Spheres& spheres, Task task);

  /// What the evaluation of a block will read.
  ComingLines coming(const state::Spheres& spheres, const LoadTable& loads, std::size_t block) const;

  /// What a step reads.
  void add_to(LargePages& pages) const;

  /// Calls `visit(one, other, rest)` with the places of the spheres of every contact and the overlap beyond which it pushes [m].
  template <class Visit>
  void visit_contacts(Visit&& visit) const {
    for (const BlockContacts& block : contacts_)
      for (std::size_t n = 0; n < block.size(); ++n) visit(block[n].first.place(), block[n].second.place(), block.rest(n));
  }

  const neighbors::SpherePairs& pairs() const { return pairs_; }
  const ContactTable& table() const { return table_; }

  void columns(Archive& archive);

private:
  /// A contact that goes on when pairs are found anew.
  struct Touch {
    Index one, other;  ///< places
    Vector3 sliding = Vector3::Zero();
  };
  /// What else it remembers: few tables resist rolling, and all contacts are held twice while pairs are found.
  struct Turning {
    Vector3 rolling = Vector3::Zero();
    Real twisting = 0;
  };
  struct Touches {
    std::vector<Touch> pairs;
    std::vector<Turning> turning;  ///< by pair; empty where nothing resists rolling or twisting
    std::vector<laws::SlipBands<Real>> bands;  ///< by pair; empty where friction does not slip in part
    std::vector<Real> rest;        ///< by pair [m]; empty where none has an overlap at rest
  };

  /// In place of how long a pair sleeps.
  static constexpr float looked_at_next = -1, at_rest = std::numeric_limits<float>::max(),
                         in_contact = std::numeric_limits<float>::infinity();

  void set_sleep(Index one, Index other, float until);
  Touches take_touches(const std::vector<Index>& new_place);
  void lay_out();
  std::size_t pair_of(Index one, Index other) const;
  void go_on(const Touches& touches);
  void go_on(std::size_t block, const Touches& touches, std::span<const Index> touch_of);
  void wake_those_due(const state::Spheres& spheres, const Task& task);
  Lanes gaps(const state::Spheres& spheres, const BoxLanes<Lanes>& box, const Task& task,
             std::span<const std::uint32_t, lane_count> pairs) const;
  void begin_contact(std::size_t block, std::size_t pair, const LoadTable& loads);
  static constexpr float rounded_down = 1 - 1e-6F;
  void sleep_on(std::size_t pair, Real until) { sleeps_until_[pair] = rounded_down * static_cast<float>(until); }

  template <class Law, bool rolls>
  ContactSums evaluate_with(const state::Spheres& spheres, Task& task);
  template <class Law, bool rolls, bool rests>
  ContactSums evaluate_those(const state::Spheres& spheres, Task& task);

  template <class Law, bool rolls, bool rests>
  friend class ContactKernel;

  ContactTable table_;
  neighbors::SpherePairs pairs_;
  std::vector<std::uint16_t> owner_;     ///< by pair: place in its block of its first sphere
  std::vector<float> sleeps_until_;      ///< by pair: the approach at which it may touch [m], or one of the words above
  std::vector<BlockContacts> contacts_;  ///< by block
};

}  // namespace sazare::methods::spheres
