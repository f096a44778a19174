#pragma once

/// What ranks tell each other in a step. The contacts of a tile act on its own spheres and on ghosts, spheres of later tiles:
/// those of other ranks get their loads from it, in the order of tiles as ever, and it gets their motion from them. So no contact
/// is evaluated twice, and no sum is added up in another order than by one process.
///
/// With several time levels each has its own ghosts. At a tick the loads of the levels that are due travel, and the motion of the
/// spheres that were kicked: these stand before all others.

#include <span>
#include <vector>

#include "sazare/methods/spheres/load_table.hpp"
#include "sazare/methods/spheres/ranks/step_messages.hpp"
#include "sazare/methods/spheres/ranks/tile_owners.hpp"
#include "sazare/methods/spheres/stepper/motion.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::methods::spheres {

class Border {
public:
  /// Force and moment of a ghost; place, velocity and spin of a sphere that is shown; its turn, where spheres have one.
  static constexpr std::size_t bytes_of_load = sizeof(LoadNumbers), bytes_of_motion = 9 * sizeof(Real),
                               bytes_of_turn = 4 * sizeof(Real);

  explicit Border(const parallel::Ranks& ranks) : ranks_(&ranks), messages_(ranks) {}

  /// The ghosts of own tiles are known, by tile; those of other ranks' tiles become the own spheres at which these look. All call
  /// it.
  void complete(const TileOwners& owners, std::vector<std::vector<Index>>& ghosts);

  /// What is known by place of own spheres becomes known of the ghosts of own tiles, as planned. All call it.
  void tell_of_ghosts(std::vector<Index>& by_place) const;

  /// The loads of a time level, and how many spheres are kicked at its ticks: those that stand first.
  struct Level {
    LoadTable* loads = nullptr;
    std::size_t spheres = 0;
  };
  /// Finds what is to travel, once the ghosts of all levels are complete.
  void plan(const TileOwners& owners, std::vector<Level> levels, bool with_turns);

  /// Brings the loads of ghosts to their owners, when all own tiles of the levels from a coarsest one on are evaluated. All call
  /// it.
  void bring_loads(std::size_t coarsest);
  /// Shows the motion of own spheres that were kicked at a tick at which this level was the coarsest to those that look at them,
  /// and with one level the speeds of their tiles. All call it.
  void show_motion(state::Spheres& spheres, std::span<SphereSpeeds> by_tile, std::size_t coarsest);

  /// Processor time of bringing and showing so far, waiting included [s].
  Real seconds() const { return seconds_; }
  /// Own spheres at which other ranks look, each counted for each rank.
  std::int64_t shown() const;
  /// What `bring_loads` and `show_motion` had to send so far, by the lists of ghosts.
  const parallel::Sent& expected() const { return messages_.planned(); }

private:
  /// What travels between this rank and another one; both have the same lists of it.
  struct Side {
    int rank = 0;
    std::vector<std::vector<Index>> loads;  ///< by level: which ghosts of its table
    std::vector<Index> spheres;             ///< their places, each once, in order
    std::vector<std::size_t> kicked;        ///< by level: how many of them are kicked where it is the coarsest
    std::vector<std::size_t> tiles;         ///< in which these are; with one level alone
  };

  void finish(std::vector<Side>& sides) const;
  std::size_t bytes_of_loads(const Side& side, std::size_t coarsest) const;
  std::size_t bytes_of_spheres(const Side& side, std::size_t coarsest) const;
  /// Plans an exchange of as many bytes as bytes(side) says.
  template <class Bytes>
  void plan(const std::vector<Side>& to, const std::vector<Side>& from, Bytes&& bytes);

  const parallel::Ranks* ranks_;
  std::vector<Level> levels_;
  bool with_turns_ = false;
  std::vector<Side> theirs_;  ///< by rank whose spheres are ghosts of own tiles
  std::vector<Side> ours_;    ///< by rank at whose tiles own spheres are ghosts
  StepMessages messages_;
  Real seconds_ = 0;
};

}  // namespace sazare::methods::spheres
