#pragma once

/// The contacts of a tile of spheres: the pairs that touch, one after the other in memory, with what they remember in lanes.

#include <cstdint>
#include <vector>

#include "sazare/core/coming_lines.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/core/time.hpp"
#include "sazare/core/vector_of.hpp"
#include "sazare/core/twin_lanes.hpp"
#include "sazare/laws/granular_contact.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/sphere_at.hpp"

namespace sazare::methods::spheres {

struct Contact {
  SphereAt first, second;
  Index slot = 0;          ///< where the load of the second adds up, see LoadTable
  std::uint32_t pair = 0;  ///< its number among the candidates
};

class TileContacts {
public:
  static constexpr std::size_t at_once = TwinLanes::count;  ///< contacts that are evaluated together

  std::size_t size() const { return contacts_.size(); }
  const Contact& operator[](std::size_t contact) const { return contacts_[contact]; }

  /// Room for so many and some more.
  void reserve(std::size_t count, const Remembered& remembered) {
    contacts_.reserve(count);
    if (remembered.bands)
      bands_.reserve(groups_of(count));
    else
      sliding_.reserve(groups_of(count));
    if (!remembered.rolls) return;
    rolling_.reserve(groups_of(count));
    twisting_.reserve(groups_of(count));
  }

  /// A contact that remembers nothing yet.
  void add(const Contact& contact, const Remembered& remembered) {
    const std::size_t n = contacts_.size();
    if (n == contacts_.capacity()) reserve(n + n / 8 + spare, remembered);
    contacts_.push_back(contact);
    if (remembered.bands)
      bands_.resize(groups_of(n + 1));
    else
      sliding_.resize(groups_of(n + 1));
    if (remembered.rolls) {
      rolling_.resize(groups_of(n + 1));
      twisting_.resize(groups_of(n + 1));
    }
    remember(n, {});
    if (remembered.bands) set_bands(n, {});
    if (initial_overlap_.empty()) return;
    initial_overlap_.resize(groups_of(n + 1));
    set_initial_overlap(n, 0);
  }

  void add_to(ComingLines& coming) const {
    coming.add_row(std::span(contacts_));
    coming.add_row(std::span(sliding_));
    coming.add_row(std::span(bands_));
    coming.add_row(std::span(rolling_));
    coming.add_row(std::span(twisting_));
  }

  void add_to(LargePages& pages) const {
    pages.add(contacts_);
    pages.add(sliding_);
    pages.add(bands_);
    pages.add(rolling_);
    pages.add(twisting_);
  }

  void set_slot(std::size_t contact, Index slot) { contacts_[contact].slot = slot; }
  /// Counts the numbers of candidates from another beginning.
  void shift_pairs(std::uint32_t by) {
    for (Contact& contact : contacts_) contact.pair += by;
  }

  /// Everything, on its way to another process.
  template <class Parcel>
  void carry(Parcel& parcel) {
    parcel(contacts_);
    parcel(sliding_);
    parcel(bands_);
    parcel(rolling_);
    parcel(twisting_);
    parcel(initial_overlap_);
  }

  /// The last contact takes the place of one that goes.
  void remove(std::size_t contact) {
    const std::size_t last = contacts_.size() - 1;
    contacts_[contact] = contacts_[last];
    contacts_.pop_back();
    remember(contact, memory(last));
    if (bands_.empty()) {
      sliding_.resize(groups_of(last));
    } else {
      set_bands(contact, bands(last));
      bands_.resize(groups_of(last));
    }
    if (!rolling_.empty()) {
      rolling_.resize(groups_of(last));
      twisting_.resize(groups_of(last));
    }
    if (initial_overlap_.empty()) return;
    set_initial_overlap(contact, initial_overlap(last));
    initial_overlap_.resize(groups_of(last));
  }

  /// What the `at_once` contacts from a multiple of it on remember [m]; lanes beyond the last contact may hold anything.
  VectorOf<TwinLanes>& sliding_of(std::size_t contact) { return sliding_[contact / at_once]; }
  laws::SlipBands<TwinLanes>& bands_of(std::size_t contact) { return bands_[contact / at_once]; }
  VectorOf<TwinLanes>& rolling_of(std::size_t contact) { return rolling_[contact / at_once]; }
  TwinLanes& twisting_of(std::size_t contact) { return twisting_[contact / at_once]; }

  laws::ContactMemory<Real> memory(std::size_t contact) const {
    const Vector3 sliding = sliding_.empty() ? Vector3(Vector3::Zero()) : get(sliding_, contact);
    if (rolling_.empty()) return {sliding, Vector3::Zero(), 0};
    return {sliding, get(rolling_, contact), twisting_[contact / at_once][lane_of(contact)]};
  }
  void remember(std::size_t contact, const laws::ContactMemory<Real>& memory) {
    if (!sliding_.empty()) put(sliding_, contact, memory.sliding);
    if (rolling_.empty()) return;
    put(rolling_, contact, memory.rolling);
    twisting_[contact / at_once].set(lane_of(contact), memory.twisting);
  }

  /// The slip bands of a contact; without stretch where the law has none.
  laws::SlipBands<Real> bands(std::size_t contact) const {
    laws::SlipBands<Real> alone;
    if (bands_.empty()) return alone;
    visit_numbers(bands_[contact / at_once], alone,
                  [lane = lane_of(contact)](const TwinLanes& in_lanes, Real& number) { number = in_lanes[lane]; });
    return alone;
  }
  /// Where there are bands.
  void set_bands(std::size_t contact, const laws::SlipBands<Real>& bands) {
    visit_numbers(bands_[contact / at_once], bands,
                  [lane = lane_of(contact)](TwinLanes& in_lanes, const Real& number) { in_lanes.set(lane, number); });
  }

  /// Whether some contact has an initial overlap, beyond which alone it pushes [m].
  bool has_initial_overlap() const { return !initial_overlap_.empty(); }
  TwinLanes& initial_overlap_of(std::size_t contact) { return initial_overlap_[contact / at_once]; }
  Real initial_overlap(std::size_t contact) const {
    return initial_overlap_.empty() ? 0 : initial_overlap_[contact / at_once][lane_of(contact)];
  }
  void set_initial_overlap(std::size_t contact, Real overlap) {
    if (initial_overlap_.empty()) initial_overlap_.resize(groups_of(contacts_.size()));
    initial_overlap_[contact / at_once].set(lane_of(contact), overlap);
  }

private:
  using Memory = std::vector<VectorOf<TwinLanes>>;
  static constexpr std::size_t spare = 32;

  static std::size_t groups_of(std::size_t count) { return (count + at_once - 1) / at_once; }
  static int lane_of(std::size_t contact) { return static_cast<int>(contact % at_once); }
  static Vector3 get(const Memory& memory, std::size_t contact) {
    const VectorOf<TwinLanes>& group = memory[contact / at_once];
    const int lane = lane_of(contact);
    return {group[0][lane], group[1][lane], group[2][lane]};
  }
  static void put(Memory& memory, std::size_t contact, const Vector3& value) {
    VectorOf<TwinLanes>& group = memory[contact / at_once];
    const int lane = lane_of(contact);
    for (int axis = 0; axis < 3; ++axis) group[axis].set(lane, value[axis]);
  }

  std::vector<Contact> contacts_;
  Memory sliding_;                                 ///< empty where there are bands
  std::vector<laws::SlipBands<TwinLanes>> bands_;  ///< empty where friction does not slip in part
  Memory rolling_;                                 ///< empty, like the next, where nothing resists rolling or twisting
  std::vector<TwinLanes> twisting_;                ///< beside it
  std::vector<TwinLanes> initial_overlap_;         ///< empty where none has an initial overlap
};

}  // namespace sazare::methods::spheres
