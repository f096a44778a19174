#pragma once

/// Spheres at time levels: the contacts of each level, and who is kicked when.
///
/// A sphere at level k could step base / 2^k. A contact has the finer level of its two spheres, or that of the one that touches a
/// wall, and is evaluated at its own steps. A sphere is kicked whenever one of its contacts may be evaluated: its pace is the
/// finest level among its own and those of the spheres it may touch until pairs are found anew. So both spheres of a contact
/// stand at the tick at which it is evaluated, with the velocities foreseen for it, and force and reaction act at one point: an
/// asynchronous variational integrator, as of blocks (docs/theory/time-levels.md).
///
/// Levels stay with their spheres; in phase are all at base steps alone, where pairs are found.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sazare/engine/sphere_motion.hpp"
#include "sazare/methods/spheres/pair_contacts.hpp"
#include "sazare/methods/spheres/wall_contacts.hpp"

namespace sazare::engine {

class SphereLevels {
public:
  /// All in one step.
  SphereLevels() = default;
  /// `level` by number of the sphere, of which the finest is above 0; the base step [s].
  SphereLevels(std::vector<std::int8_t> level, const methods::spheres::ContactTable& table, Real base_step);

  bool empty() const { return levels_.empty(); }
  /// All in one step count as one level.
  std::size_t count() const { return std::max<std::size_t>(levels_.size(), 1); }
  int finest() const { return static_cast<int>(count()) - 1; }
  /// Of a base step.
  std::int64_t ticks() const { return std::int64_t{1} << finest(); }
  Real tick_seconds() const { return levels_.back().step; }
  /// Of the levels due at a tick of a base step; all finer ones are due as well.
  int coarsest_due(std::int64_t tick) const;

  /// Sorts the spheres by pace and along a curve and finds all pairs nearer than the margin [m]; what touches goes on
  /// remembering. Returns the place before of each sphere.
  std::vector<Index> find(state::Spheres& spheres, Real margin);

  /// By place; empty where all take one step.
  std::vector<std::int8_t> by_place(const state::Spheres& spheres) const;

  /// Evaluates the contacts of the levels due at a tick of a base step. `approach`: how much nearer any two spheres may have come
  /// since pairs were found [m].
  void evaluate(std::int64_t tick, const state::Spheres& spheres, methods::spheres::WallContacts& walls, Real approach);

  /// Adds what the levels due have taken at a tick to the works of `sums`; at a base step also sets what contacts hold.
  void book(std::int64_t tick, methods::spheres::ContactSums& sums) const;

  /// What of the spheres all kicks have in common.
  struct Kick {
    Vector3 gravity = Vector3::Zero();  ///< [m/s2]
    Vector3 drift = Vector3::Zero();    ///< from which speeds are seen [m/s]
    bool drives = false;                ///< some held sphere moves
  };

  /// Kicks the spheres due at a tick, and moves each to its next time. Returns the speeds of all.
  SphereSpeeds kick(std::int64_t tick, state::Spheres& spheres, const Kick& rules);
  /// What driven spheres brought in at the last kick [J].
  Real driven_work() const;

  /// At a base step whose forces are kept: the load on a sphere, and what half a step of each level gives.
  state::SphereLoad load(std::size_t sphere) const;
  state::SphereLoad half_impulse(std::size_t sphere) const;
  /// Of a sphere's pace [s].
  Real step_of(std::size_t sphere) const { return levels_[static_cast<std::size_t>(pace(sphere))].step; }

  /// How often since the start.
  struct Counts {
    std::int64_t kicks = 0;                ///< of spheres
    std::int64_t evaluations = 0;          ///< of contacts
    std::int64_t uniform_evaluations = 0;  ///< with the finest step for all, as many as touch at base steps
  };
  const Counts& counts() const { return counts_; }
  void count_anew() { counts_ = {}; }

  void columns(Archive& archive, bool loads_are_kept);

private:
  struct Level {
    Real step = 0;  ///< [s]
    methods::spheres::PairContacts pairs;
    methods::spheres::LoadTable loads;  ///< of the spheres that have this pace or a finer one
    std::size_t spheres = 0;            ///< so many: they stand before all others
    methods::spheres::ContactSums sums;
    SphereSpeeds speeds;  ///< of the spheres of this very pace since their last kick
  };
  /// A block of a level, to be evaluated together.
  struct Block {
    int level = 0;
    std::size_t block = 0;
  };
  /// Spheres of one pace in a block, to be kicked together.
  struct Flock {
    int pace = 0;
    std::size_t begin = 0, end = 0;
  };

  int pace(std::size_t sphere) const;
  void arrange();
  ComingLines coming(const state::Spheres& spheres, const Block& block) const;
  std::vector<TimedLoads> loads_on(const Flock& flock, std::int64_t tick) const;

  std::vector<std::int8_t> level_;  ///< by number of the sphere
  std::vector<Level> levels_;
  std::vector<Block> blocks_;                             ///< finest level first
  std::vector<Flock> flocks_;                             ///< finest pace first
  std::vector<std::size_t> blocks_until_, flocks_until_;  ///< by level: so many are of it or of finer ones
  std::vector<methods::spheres::ContactSums> sums_;       ///< by block
  std::vector<SphereSpeeds> speeds_;                      ///< by flock
  std::vector<Real> driven_work_;                         ///< by flock, of the last kick [J]
  Counts counts_;
};

}  // namespace sazare::engine
