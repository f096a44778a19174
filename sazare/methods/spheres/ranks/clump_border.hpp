#pragma once

/// Rigid clumps that several ranks share. The rank that works for the first sphere of a clump moves it: it gets the loads of
/// those of its spheres that are other ranks', and gives these the motion of the clump, from which they place their spheres.

#include <cstdint>
#include <span>
#include <vector>

#include "sazare/methods/spheres/load_table.hpp"
#include "sazare/methods/spheres/ranks/step_messages.hpp"
#include "sazare/methods/spheres/ranks/tile_owners.hpp"
#include "sazare/methods/spheres/water_forces.hpp"
#include "sazare/parallel/ranks.hpp"
#include "sazare/state/clumps.hpp"

namespace sazare::methods::spheres {

class ClumpBorder {
public:
  explicit ClumpBorder(const parallel::Ranks& ranks) : ranks_(&ranks), messages_(ranks) {}

  /// How spheres and clumps stand: places by number of the sphere, loads by time level, and how many spheres have each active
  /// level or a finer one.
  struct Scene {
    std::span<const Index> place;
    std::vector<LoadTable*> loads;
    std::vector<std::size_t> spheres;
  };
  /// Finds who moves which clumps, and what is to travel.
  void plan(const TileOwners& owners, const state::Clumps& clumps, Scene scene);

  int owner(std::size_t clump) const { return owner_[clump]; }
  bool owns(std::size_t clump) const { return owner_[clump] == ranks_->rank(); }

  /// Brings the loads of the levels from a coarsest one on to those who move the clumps, and the added masses of water where
  /// there is some. All call it.
  void bring_loads(std::size_t coarsest, WaterForces& water);
  /// Shows the clumps that were kicked at a tick at which this level was the coarsest, and places their spheres. All call it.
  void show(state::Clumps& clumps, state::Spheres& spheres, std::size_t coarsest);
  /// Every rank's own clumps become known to all, or to the first one. All call it.
  void share(state::Clumps& clumps, parallel::To to, parallel::Topic topic) const;
  /// To all, and nobody moves them until the next plan.
  void share_for_good(state::Clumps& clumps) {
    share(clumps, parallel::To::all, parallel::Topic::state);
    owner_.clear();
  }

  /// What `bring_loads` and `show` had to send so far.
  const parallel::Sent& expected() const { return messages_.planned(); }

private:
  /// A sphere of a clump.
  struct Member {
    Index place = 0, number = 0;
  };
  /// What travels between this rank and another one; both have the same lists of it.
  struct Side {
    int rank = 0;
    std::vector<Member> to_owner, from_members;  ///< own spheres of its clumps, and its spheres of own clumps
    std::vector<std::size_t> taken, given;       ///< its clumps that have own spheres, and own clumps that have its spheres
  };

  bool is_kicked(Index place, std::size_t coarsest) const { return static_cast<std::size_t>(place) < scene_.spheres[coarsest]; }
  std::size_t bytes_of(const std::vector<Member>& members, std::size_t coarsest, bool with_water) const;
  std::size_t bytes_of(const std::vector<std::size_t>& clumps, std::size_t coarsest) const;
  template <class Carry>
  void carry_loads(const std::vector<Member>& members, std::size_t coarsest, Carry&& carry) const;

  const parallel::Ranks* ranks_;
  Scene scene_;
  std::vector<int> owner_;          ///< by clump
  std::vector<Index> first_place_;  ///< by clump: of its first sphere
  std::vector<Side> sides_;         ///< by rank
  StepMessages messages_;
};

}  // namespace sazare::methods::spheres
