#pragma once

/// Spheres at time levels: the contacts and bonds of each level, and who is kicked when. All in one step are at one level.
///
/// A sphere at level k could step base / 2^k. A contact or a bond has the finer level of its two spheres, or that of the one that
/// touches a wall, and is evaluated at its own steps. A sphere is kicked whenever one of them may be evaluated: its active level
/// is the finest level among its own and those of the spheres it is bonded to or may touch until pairs are found anew; spheres of
/// a clump have one level and one active level. So both spheres of a contact stand at the tick at which it is evaluated, with the
/// velocities predicted for it, and force and reaction act at one point: an asynchronous variational integrator, as of blocks
/// (docs/theory/time-levels.md).
///
/// Levels stay with their spheres; in phase are all at base steps alone, where pairs are found.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sazare/core/large_tables.hpp"
#include "sazare/methods/spheres/applied_forces.hpp"
#include "sazare/methods/spheres/bonds.hpp"
#include "sazare/methods/spheres/pair_contacts.hpp"
#include "sazare/methods/spheres/stepper/clump_motion.hpp"
#include "sazare/methods/spheres/stepper/motion.hpp"
#include "sazare/methods/spheres/stepper/work_sums.hpp"
#include "sazare/methods/spheres/wall_contacts.hpp"
#include "sazare/methods/spheres/water_forces.hpp"
#include "sazare/neighbors/pair_levels.hpp"

namespace sazare::methods::spheres {

class SphereLevels {
public:
  /// `level` by number of the sphere; empty: all at level 0. The base step [s].
  SphereLevels(std::vector<std::int8_t> level, const methods::spheres::ContactTable& table, Real base_step);

  /// Several ranks share the spheres from now on.
  void share(RankTiles& ranks) { ranks_ = &ranks; }

  /// Whether all spheres take one step.
  bool is_one() const { return levels_.size() == 1; }
  std::size_t count() const { return levels_.size(); }
  int finest() const { return static_cast<int>(count()) - 1; }
  /// The finest steps in a base step.
  std::int64_t ticks() const { return std::int64_t{1} << finest(); }
  Real tick_seconds() const { return levels_.back().step; }
  /// The coarsest level that is due at a tick of a base step; all finer ones are due as well.
  std::size_t coarsest_due(std::int64_t tick) const;
  /// By number of the sphere; empty where all are at one.
  const std::vector<std::int8_t>& by_number() const { return level_; }
  /// By place; empty where all are at one.
  std::vector<std::int8_t> by_place(const state::Spheres& spheres) const;
  std::size_t active_level(std::size_t sphere) const;
  /// The step of an active level or a level [s].
  Real step(std::size_t level) const { return levels_[level].step; }

  /// Which spheres belong together, by their present places: see neighbors::LevelsByPlace.
  struct Together {
    std::vector<neighbors::LevelsByPlace::Bonded> bonded;
    std::vector<Index> body;
  };
  /// Sorts the spheres by active level and along a curve and finds all pairs nearer than the margin [m]; what touches goes on
  /// remembering. Returns by place where each sphere comes to stand. `arrange` is to follow.
  std::vector<Index> find(state::Spheres& spheres, Real margin, Together together);
  /// The same among ranks that know their own spheres and those near them alone; none of the spheres belong together.
  std::vector<Index> find_among_ranks(state::Spheres& spheres, Real margin);
  /// Suppresses contacts as PairContacts does, in the level to which the pair belongs.
  void suppress_within(std::span<const Index> body);
  void suppress(const state::Spheres& spheres, Index one, Index other);
  void activate(const state::Spheres& spheres, Index one, Index other, Real allowed);
  /// Loads and lists of what is worked on together, from the pairs and from the bonds, which are laid out.
  void arrange(const methods::spheres::Bonds& bonds);
  /// With several ranks: finds what travels in steps, after `arrange`.
  void plan_border(bool with_turns);

  methods::spheres::PairContacts& pairs(std::size_t level) { return levels_[level].pairs; }
  const methods::spheres::PairContacts& pairs(std::size_t level) const { return levels_[level].pairs; }
  methods::spheres::LoadTable& loads(std::size_t level) { return levels_[level].loads; }
  const methods::spheres::LoadTable& loads(std::size_t level) const { return levels_[level].loads; }

  /// What a step reads but for the spheres.
  void add_to(LargePages& pages) const {
    for (const Level& level : levels_) {
      level.pairs.add_to(pages);
      level.loads.add_to(pages);
    }
  }

  /// What acts on spheres.
  struct Scene {
    state::Spheres& spheres;  ///< water sets their inverse masses, and nothing else does
    methods::spheres::WallContacts& walls;
    methods::spheres::Bonds& bonds;
    methods::spheres::WaterForces& water;
    const methods::spheres::AppliedForces& applied;
    std::span<const Real> approach;  ///< how much nearer spheres may have come since pairs were found: of all, or by tile [m]
    Real time = 0;                   ///< [s]
    bool tells_energies = true;      ///< whether somebody may ask what contacts hold at this time

    Real approach_of(std::size_t tile) const { return approach[approach.size() > 1 ? tile : 0]; }
  };
  /// Evaluates all that is due at a tick of a base step, and keeps the loads.
  void evaluate(std::int64_t tick, const Scene& scene);
  /// Evaluates tile number `n` of the finest level; its loads add up in `own`, which is zero, and `next` comes to the cache
  /// meanwhile.
  void evaluate_tile(std::size_t n, const Scene& scene, state::SphereLoad* own, const ComingLines& next);
  /// Counts the contacts of the tiles due at a tick, after all of them; `evaluate` has done so.
  void count_contacts(std::int64_t tick);
  /// What the evaluation of a tile will read.
  ComingLines coming(const state::Spheres& spheres, std::size_t n) const;

  /// Adds what the tiles due have taken at a tick to the works of `sums`; at a base step also sets what contacts and bonds hold.
  /// Returns how many bonds broke.
  std::int64_t add_work(std::int64_t tick, WorkSums& sums) const;

  /// What of the spheres all kicks have in common.
  struct Kick {
    Vector3 gravity = Vector3::Zero();  ///< [m/s2]
    Vector3 drift = Vector3::Zero();    ///< from which speeds are seen [m/s]
    bool drives = false;                ///< some held sphere moves
  };

  /// Kicks the spheres due at a tick that are of no clump, and moves each to its next time. Adds what driven ones bring in [J].
  void kick(std::int64_t tick, state::Spheres& spheres, const Kick& rules, ExactSum& driven_work);
  /// Counts the kicks of one step of all spheres, which did not go by `kick`.
  void count_kicks(std::size_t spheres) { counts_.kicks += static_cast<std::int64_t>(spheres); }
  /// Further speeds of bodies of an active level, after their kick.
  void take(std::size_t active_level, const SphereSpeeds& speeds) { levels_[active_level].speeds.take(speeds); }
  /// Those of a rank's own tiles, by tile, since their last kick; where there is one level.
  void take_speeds(std::span<SphereSpeeds> by_tile) const;
  /// The largest speeds of all spheres, each since its last kick.
  SphereSpeeds speeds() const;

  /// The loads of all levels on a body of an active level which is kicked at a tick. A load evaluated at t acts from half a step
  /// of its level before t to half a step after it.
  std::vector<TimedTable> acting(std::size_t active_level, std::int64_t tick) const;
  /// The loads where forces are kept and the kick of this base step is still to come: nothing given yet, half a step of each
  /// level ahead.
  std::vector<TimedTable> acting_until_now(std::size_t active_level) const;

  /// Where forces are kept, adds one to the load on a sphere. Returns the step over which it acts [s].
  Real add_to_load(const state::Spheres& spheres, std::size_t sphere, const Vector3& force);

  /// At a base step whose forces are kept: the load on a sphere, and what its momenta lack.
  state::SphereLoad load(std::size_t sphere) const;
  state::SphereLoad half_impulse(std::size_t sphere) const;

  /// How often since the start.
  struct Counts {
    std::int64_t kicks = 0;                ///< of spheres
    std::int64_t evaluations = 0;          ///< of contacts
    std::int64_t uniform_evaluations = 0;  ///< with the finest step for all, as many as touch at base steps
  };
  const Counts& counts() const { return counts_; }
  void count_anew() { counts_ = {}; }

  /// Pairs and counts; `arrange` is to follow a reading, and then `load_columns` where loads are kept.
  void columns(Archive& archive);
  void load_columns(Archive& archive);

  /// With several ranks: the first one comes to know all pairs and contacts, for the next `columns` that writes, and
  /// `forget_collected` gives their memory back. After a reading a rank keeps those of its own tiles alone.
  void collect();
  void forget_collected() { collected_.clear(); }
  void keep_own();
  /// The first one comes to know all kept loads; all call it.
  void collect_loads();
  /// The counts of all ranks, in the first one; all call it.
  Counts all_counts() const;
  /// What `columns` writes of counts from now on; what was read counts in the first rank alone.
  void take_counts(const Counts& all) { collected_counts_ = all; }

private:
  struct Level {
    Real step = 0;  ///< [s]
    methods::spheres::PairContacts pairs;
    methods::spheres::LoadTable loads;  ///< of the spheres that have this active level or a finer one
    std::size_t spheres = 0;            ///< so many: they stand before all others
    std::int64_t contacts = 0;          ///< that touched when it was last evaluated
    SphereSpeeds speeds;  ///< of the bodies of this very active level since their last kick
  };
  /// A tile of a level, to be evaluated together.
  struct Tile {
    std::size_t level = 0, tile = 0;
  };
  /// Spheres of one active level in a tile, to be kicked together.
  struct Batch {
    std::size_t active_level = 0, begin = 0, end = 0;
  };

  bool owns(std::size_t tile) const { return ranks_ == nullptr || ranks_->owners().owns(tile); }
  Level& level_of(const state::Spheres& spheres, Index one, Index other);
  void fly(std::size_t n, std::int64_t tick, state::Spheres& spheres, const Kick& rules);

  std::vector<std::int8_t> level_;  ///< by number of the sphere; empty where all are at one
  std::vector<Level> levels_;
  std::vector<Tile> tiles_;                               ///< finest level first
  std::vector<Batch> batches_;                            ///< finest active level first
  std::vector<std::size_t> tiles_until_, batches_until_;  ///< by level: so many are of it or of finer ones
  std::vector<methods::spheres::ContactSums> sums_;       ///< by tile
  std::vector<SphereSpeeds> speeds_;                      ///< by batch
  std::vector<Real> driven_work_;                         ///< by batch, of the last kick [J]
  Counts counts_;
  RankTiles* ranks_ = nullptr;
  std::vector<methods::spheres::PairContacts> collected_;  ///< by level
  std::optional<Counts> collected_counts_;
};

}  // namespace sazare::methods::spheres
