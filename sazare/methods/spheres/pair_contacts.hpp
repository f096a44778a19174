#pragma once

/// Contacts between spheres: candidates, which of them touch, what they remember, and their forces in lanes.
///
/// A pair that does not touch is inactive: it is looked at again when any two spheres may have come nearer to each other by as
/// much as its gap. So a step reads one small number of each candidate, and evaluates little more than the pairs that touch.
/// These stand one after the other, tile by tile: what they remember is read and written in one stream. A pair that has come to
/// touch is put at the end, and the last one takes the place of one that parts.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/load_rows.hpp"
#include "sazare/methods/spheres/load_table.hpp"
#include "sazare/methods/spheres/ranks/rank_tiles.hpp"
#include "sazare/methods/spheres/tile_contacts.hpp"

namespace sazare::methods::spheres {

class PairContacts {
public:
  explicit PairContacts(ContactTable table) : table_(std::move(table)) {}

  /// Sorts the spheres along a curve and finds all pairs nearer than the margin [m]; what touches goes on remembering.
  /// Returns by place where each sphere comes to stand. `write_to` is to follow. Where several ranks share the spheres all of
  /// them have all spheres as they are now, and each comes to know the pairs of its own tiles; else `ranks` is nullptr.
  std::vector<Index> find(state::Spheres& spheres, Real margin, RankTiles* ranks);

  /// Goes over to these pairs of spheres that are sorted anew; `new_place` says by place where each of them comes to stand. What
  /// touches goes on remembering. `write_to` is to follow.
  void go_over(neighbors::SpherePairs pairs, const std::vector<Index>& new_place, RankTiles* ranks);

  /// Tells the contacts where their loads add up.
  void write_to(const LoadTable& loads);

  /// A pair of places that is bonded has no contact until it is activated.
  void suppress(Index one, Index other) { set_inactive(one, other, suppressed); }
  /// The pair may touch from the next evaluation on, and pushes beyond the overlap `allowed` alone [m]. Does nothing where it is
  /// not suppressed.
  void activate(Index one, Index other, Real allowed, const LoadTable& loads);

  /// Suppresses all pairs of one body that do not touch, as `suppress` does; `body` says by place which, below 0 where none.
  void suppress_within(std::span<const Index> body);

  /// A tile, and where its forces go.
  struct Task {
    std::size_t tile = 0;
    Real approach = 0;  ///< how much nearer any two spheres may have come since `find` [m]
    Real step = 0;      ///< [s]
    LoadTable& loads;
    state::SphereLoad* own;      ///< the loads of the tile's spheres
    ComingLines coming = {};     ///< what will be needed next, asked for on the way
    bool tells_energies = true;  ///< whether the sums are to tell what contacts hold; works they always tell
  };

  /// Adds the forces of a tile's pairs to the loads.
  ContactSums evaluate(const state::Spheres& spheres, Task task);

  /// What the evaluation of a tile will read.
  ComingLines coming(const state::Spheres& spheres, const LoadTable& loads, std::size_t tile) const;

  /// What a step reads.
  void add_to(LargePages& pages) const;

  /// Calls `visit(one, other, initial_overlap)` with the places of the spheres of every contact of a tile and the overlap beyond
  /// which it pushes [m].
  template <class Visit>
  void visit_contacts(std::size_t of_tile, Visit&& visit) const {
    const TileContacts& tile = contacts_[of_tile];
    for (std::size_t n = 0; n < tile.size(); ++n) visit(tile[n].first.place(), tile[n].second.place(), tile.initial_overlap(n));
  }

  /// The candidates of a tile, and its contacts, which count them from its first one.
  struct TilePart {
    std::vector<std::uint32_t> counts;  ///< of candidates, by sphere
    std::vector<Index> other;
    std::vector<float> inactive_until;
    TileContacts contacts;

    template <class Parcel>
    void carry(Parcel& parcel) {
      parcel(counts);
      parcel(other);
      parcel(inactive_until);
      contacts.carry(parcel);
    }
  };
  TilePart part(std::size_t tile) const;
  std::size_t tiles() const { return contacts_.size(); }
  /// Takes all tiles in place of what was there; those of other ranks may have no candidates.
  void assemble(std::vector<TilePart> by_tile);

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
    std::vector<Turning> turning;              ///< by pair; empty where nothing resists rolling or twisting
    std::vector<laws::SlipBands<Real>> bands;  ///< by pair; empty where friction does not slip in part
    std::vector<Real> initial_overlap;         ///< by pair [m]; empty where none has an initial overlap

    /// Adds one of another list, or all of it.
    void take(const Touches& from, std::size_t n) {
      pairs.push_back(from.pairs[n]);
      if (!from.turning.empty()) turning.push_back(from.turning[n]);
      if (!from.bands.empty()) bands.push_back(from.bands[n]);
      if (from.initial_overlap.empty()) return;
      initial_overlap.resize(pairs.size() - 1, 0);
      initial_overlap.push_back(from.initial_overlap[n]);
    }
    void take_all(const Touches& from) {
      for (std::size_t n = 0; n < from.pairs.size(); ++n) take(from, n);
      if (!initial_overlap.empty()) initial_overlap.resize(pairs.size(), 0);
    }

    template <class Parcel>
    void carry(Parcel& parcel) {
      parcel(pairs);
      parcel(turning);
      parcel(bands);
      parcel(initial_overlap);
    }
  };

  /// In place of how long a pair is inactive.
  static constexpr float looked_at_next = -1, suppressed = std::numeric_limits<float>::max(),
                         in_contact = std::numeric_limits<float>::infinity();

  void set_inactive(Index one, Index other, float until);
  Touches take_touches(const std::vector<Index>& new_place);
  static Touches hand_on(const Touches& touches, RankTiles& ranks);
  void lay_out();
  void find_first_spheres();
  std::size_t pair_of(Index one, Index other) const;
  void go_on(const Touches& touches);
  void go_on(std::size_t tile, const Touches& touches, std::span<const Index> touch_of);
  void activate_those_due(const state::Spheres& spheres, const Task& task);
  Lanes gaps(const state::Spheres& spheres, const BoxLanes<Lanes>& box, const Task& task,
             std::span<const std::uint32_t, lane_count> pairs) const;
  void begin_contact(std::size_t tile, std::size_t pair, const LoadTable& loads);
  static constexpr float rounded_down = 1 - 1e-6F;
  void stay_inactive(std::size_t pair, Real until) { inactive_until_[pair] = rounded_down * static_cast<float>(until); }

  template <class Law, bool rolls>
  ContactSums evaluate_with(const state::Spheres& spheres, Task& task);
  template <class Law, bool rolls, bool has_initial_overlap>
  ContactSums evaluate_those(const state::Spheres& spheres, Task& task);

  template <class Law, bool rolls, bool has_initial_overlap>
  friend class ContactKernel;

  ContactTable table_;
  neighbors::SpherePairs pairs_;
  std::vector<std::uint16_t> owner_;    ///< by pair: place in its tile of its first sphere
  std::vector<float> inactive_until_;   ///< by pair: the approach at which it may touch [m], or one of the words above
  std::vector<TileContacts> contacts_;  ///< by tile
};

}  // namespace sazare::methods::spheres
