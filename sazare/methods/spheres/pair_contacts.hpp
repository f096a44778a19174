#pragma once

/// Contacts between spheres: candidates, which of them touch, what they remember, and their forces in lanes.

#include <cstdint>
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

  /// Adds the forces of a block's pairs to the loads.
  ContactSums evaluate(const state::Spheres& spheres, std::size_t block, Real step, LoadTable& loads);

  const neighbors::SpherePairs& pairs() const { return pairs_; }
  const ContactTable& table() const { return table_; }
  bool touches(std::size_t pair) const { return touches_[pair] != 0; }

  void columns(Archive& archive);

  /// Four doubles, as lanes read them.
  struct alignas(32) Memory {
    Real x = 0, y = 0, z = 0, unused = 0;
  };

 private:
  struct Hit {
    Index sphere = 0;
    std::uint32_t pair = 0;
  };

  template <bool periodic>
  std::size_t find_hits(const state::Spheres& spheres, std::size_t sphere, Hit* hits);
  void forget(std::size_t pair);
  void carry_over(const neighbors::SpherePairs& before, const std::vector<Index>& new_place);

  template <laws::ContactModel model, bool rolls>
  ContactSums evaluate_with(const state::Spheres& spheres, std::size_t block, Real step, LoadTable& loads);

  template <laws::ContactModel model, bool rolls>
  friend class ContactKernel;

  ContactTable table_;
  neighbors::SpherePairs pairs_;
  std::vector<std::uint8_t> touches_;  ///< by pair
  std::vector<Memory> sliding_;        ///< by pair; zero where they do not touch
  std::vector<Memory> rolling_;        ///< by pair; empty where nothing resists rolling
};

}  // namespace sazare::methods::spheres
