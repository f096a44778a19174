#pragma once

/// Contacts between spheres: candidates, which of them touch, what they remember, and their forces in lanes.
///
/// A pair that does not touch sleeps: it is looked at again when any two spheres may have come nearer to each other by as much as
/// its gap. So a step reads one small number of each candidate, and evaluates little more than the pairs that touch.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/load_table.hpp"

namespace sazare::methods::spheres {

class PairContacts {
public:
  explicit PairContacts(ContactTable table) : table_(std::move(table)) {}

  /// Sorts the spheres along a curve and finds all pairs nearer than the margin [m]; what touches goes on remembering.
  /// Returns the place before of each sphere.
  std::vector<Index> find(state::Spheres& spheres, Real margin);

  /// A pair of places that is bonded has no contact until it is woken.
  void rest(Index one, Index other) { set_sleep(one, other, std::numeric_limits<float>::infinity()); }
  void wake(Index one, Index other) { set_sleep(one, other, looked_at_next); }

  /// The same for good, for all pairs of one body; `body` says by place which, below 0 where none.
  void rest_within(std::span<const Index> body);

  /// A block, and where its forces go.
  struct Task {
    std::size_t block = 0;
    Real approach = 0;  ///< how much nearer any two spheres may have come since `find` [m]
    Real step = 0;      ///< [s]
    LoadTable& loads;
    state::SphereLoad* own;  ///< the loads of the block's spheres
  };

  /// Adds the forces of a block's pairs to the loads.
  ContactSums evaluate(const state::Spheres& spheres, const Task& task);

  const neighbors::SpherePairs& pairs() const { return pairs_; }
  const ContactTable& table() const { return table_; }

  void columns(Archive& archive);

  /// Four doubles, as lanes read them.
  struct alignas(32) Memory {
    Real x = 0, y = 0, z = 0, unused = 0;
  };

private:
  struct AwakePair {
    Index first, second;
    std::uint32_t pair;
  };

  struct Touch {
    Index one, other;
    Triple<Real> sliding;
  };

  struct Touches {
    std::vector<Touch> pairs;
    std::vector<Memory> rolling;  ///< by pair; empty where nothing resists rolling
  };

  static constexpr float looked_at_next = -1;

  void set_sleep(Index one, Index other, float until);
  Touches take_touches(const std::vector<Index>& new_place);
  void lay_out();
  void remember(const Touch& touch, const Memory& rolled);

  template <laws::ContactModel model, bool rolls>
  ContactSums evaluate_with(const state::Spheres& spheres, const Task& task);

  template <laws::ContactModel model, bool rolls>
  friend class ContactKernel;

  ContactTable table_;
  neighbors::SpherePairs pairs_;
  std::vector<Index> owner_;         ///< by pair: its first sphere
  std::vector<float> sleeps_until_;  ///< by pair: the approach at which it may touch [m]; 0 while it touches, -1 when it is new
  std::vector<Memory> sliding_;      ///< by pair; zero where they do not touch
  std::vector<Memory> rolling_;      ///< by pair; empty where nothing resists rolling
};

}  // namespace sazare::methods::spheres
