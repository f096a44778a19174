#pragma once

/// Walks spheres in equal steps: leapfrog, with contacts evaluated at the velocity predicted for their time.
///
///     v(k+1/2) = v(k-1/2) + h a(k)     x(k+1) = x(k) + h v(k+1/2)     predicted v(k+1) = v(k+1/2) + h a(k)/2
///
/// so the step is of second order with dashpots too. The spheres stand in memory along a curve, sorted anew whenever pairs are.
/// Where spheres have time levels, a step is a base step, in which each takes as many steps as its level asks for. Where all
/// take one step, and no clump waits for the forces on all its spheres, tiles are evaluated and kicked in one walk.

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "sazare/methods/spheres/bonded_bodies.hpp"
#include "sazare/methods/spheres/pair_contacts.hpp"
#include "sazare/methods/spheres/ranks/clump_border.hpp"
#include "sazare/methods/spheres/ranks/rank_tiles.hpp"
#include "sazare/methods/spheres/step_load.hpp"
#include "sazare/methods/spheres/stepper/levels.hpp"
#include "sazare/methods/spheres/stepper/motion_sums.hpp"
#include "sazare/methods/spheres/stepper/tile_shares.hpp"
#include "sazare/methods/spheres/stepper/work_sums.hpp"
#include "sazare/methods/spheres/wall_contacts.hpp"
#include "sazare/parallel/progress.hpp"
#include "sazare/parallel/sum_over_ranges.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/state/clumps.hpp"

namespace sazare::methods::spheres {

struct SphereRules {
  Real step = 0;                        ///< h; with levels the base step [s]
  Vector3 gravity = Vector3::Zero();    ///< [m/s2]
  Real margin = 0;                      ///< spheres nearer than this are kept as pairs until they may have come closer [m]
  Real wall_margin = 0;                 ///< of walls [m]; as `margin`, at least twice the longest neck of the contact law
  std::vector<std::int8_t> level = {};  ///< by number of the sphere; empty: all in one step. Those of a clump go by its finest
};

/// Where the energy is, and where it went; their sum without the works of walls stays.
struct SphereEnergies {
  Real translation = 0;   ///< [J]
  Real rotation = 0;      ///< [J]
  Real elastic = 0;       ///< in normal springs of contacts [J]
  Real sliding = 0;       ///< in springs of sliders [J]
  Real potential = 0;     ///< of gravity [J]
  Real dashpot_work = 0;  ///< lost in normal dashpots, and where contacts were pulled apart, since the start [J]
  Real sliding_work = 0;  ///< lost in sliders since the start [J]
  Real wall_work = 0;     ///< brought in by moving walls, and by spheres that are driven, since the start [J]
  Real bonds = 0;         ///< in bonds [J]
  Real bond_drag = 0;     ///< lost in dashpots of bonds since the start [J]
  Real fracture = 0;      ///< lost by damage of bonds since the start [J]
  Real water_work = 0;    ///< of water on spheres since the start [J]
  Real applied_work = 0;  ///< of forces from outside since the start [J]

  Real sum() const {
    return translation + rotation + elastic + sliding + potential + dashpot_work + sliding_work - wall_work + bonds + bond_drag +
           fracture - water_work - applied_work;
  }
};

/// From the sums of all parts.
SphereEnergies energies_of(const WorkSums& works, const MotionEnergies& motion);

/// Spheres that fall until they rest, before the beginning.
struct RainRules {
  std::vector<std::uint8_t> rains;  ///< by number of the sphere; all or none of a clump
  Real damping = 0;                 ///< every velocity falls at this rate besides [1/s]
  std::int64_t most_steps = 0;
  std::function<bool(std::int64_t steps, Real unrest)> goes_on;  ///< asked now and then
};

struct RainEnd {
  std::int64_t steps = 0;
  Real unrest = 0;  ///< 1 or less: all that fell rests
  bool goes_on = true;
};

class SphereStepper {
public:
  SphereStepper(state::Spheres spheres, const methods::spheres::ContactTable& table, std::vector<methods::spheres::Wall> walls,
                const SphereRules& rules, methods::spheres::Bonds bonds = {}, state::Clumps clumps = {},
                methods::spheres::BondedBodies bodies = {});

  /// Adds a surface that moves with its nodes, before `start` or a resume; one at most.
  void add_surface(methods::spheres::Wall wall) { walls_.add_surface(std::move(wall)); }

  /// Water around the spheres, before `start` or a resume.
  void set_water(methods::spheres::WaterForces water) { water_ = std::move(water); }

  /// Forces by number of the sphere [N], which act from `time()` on until others are given; before `start` from the beginning.
  void apply(std::vector<Vector3> forces);

  /// From `time()` on, at which forces are kept, the surface's nodes go from these places with these velocities [m; m/s].
  void lead(std::vector<Vector3> from, std::vector<Vector3> with) {
    works_.wall_work += walls_.lead(time(), rules_.step, std::move(from), std::move(with));
  }

  /// Several ranks share the spheres from now on, before `start` or a resume; there is no surface with nodes. Every rank then
  /// makes the same calls, but for those that only look.
  void share(const parallel::Ranks& ranks, Division division);
  /// The part of this rank in what all share; nullptr where there is one alone.
  const RankTiles* ranks() const { return ranks_.get(); }
  /// What had to be sent in steps so far, by the lists of ghosts and of clumps.
  parallel::Sent expected_to_send() const;
  /// Makes energies and sums at `time()` known to the first rank, and where asked for the motion of all spheres.
  void survey(bool with_motion);
  /// Makes all that `columns` writes known to the first rank.
  void collect();

  /// Evaluates the beginning; call once before the first `advance`, not after a resume.
  void start();

  /// Lets spheres fall until they rest, and takes their last velocity from them; all others, and the walls, stand still
  /// meanwhile, and no time passes. To be called before `start`; contacts go on with what they remember.
  RainEnd rain(const RainRules& rules);

  /// A step: forces at `time()`, kick and drift.
  void advance();

  /// Evaluates the forces at `time()` and keeps them: to be called before anything below is asked for. The next `advance` goes on
  /// from them, with the same bits.
  void evaluate_now();

  /// Whether `start` or a resume has been; forces and what follows from them are known since.
  bool has_begun() const { return levels_.loads(0).tiles() > 0; }
  std::int64_t steps() const { return step_; }
  Real time() const { return static_cast<Real>(step_) * rules_.step; }
  const SphereRules& rules() const { return rules_; }
  const state::Spheres& spheres() const { return spheres_; }
  const methods::spheres::WallContacts& walls() const { return walls_; }
  const SphereLevels& levels() const { return levels_; }
  const methods::spheres::Bonds& bonds() const { return bonds_; }
  const state::Clumps& clumps() const { return clumps_; }
  const methods::spheres::BondedBodies& bodies() const { return bodies_; }
  const methods::spheres::WaterForces& water() const { return water_; }

  /// At `time()`: of contacts, bonds, and of water but for what its added mass takes.
  state::SphereLoad load(std::size_t sphere) const;
  Vector3 velocity(std::size_t sphere) const;
  Vector3 spin(std::size_t sphere) const;
  SphereEnergies energies() const {
    return ranks_ == nullptr ? energies_of(works_, motion_energies()) : energies_of(surveyed_.works, surveyed_.motion);
  }
  Vector3 momentum() const { return momenta().linear.value(); }
  /// About the origin [kg m2/s].
  Vector3 angular_momentum() const { return momenta().angular.value(); }
  /// What these follow from, in sums of parts.
  const WorkSums& works() const { return works_; }
  MotionEnergies motion_energies() const;
  Momenta momenta() const;

  /// Touching pairs of spheres, and of spheres and walls.
  std::int64_t contacts() const { return all_works().contacts; }
  std::int64_t searches() const { return searches_; }
  /// Bonds that have broken so far.
  std::int64_t broken_bonds() const { return all_works().broken; }
  /// The largest speed in the last step [m/s]; infinite when one is no number.
  Real largest_speed() const { return largest_speed_; }
  /// What contacts and spheres did so far; with several ranks at the last survey.
  const SphereLevels::Counts& counts() const { return ranks_ == nullptr ? levels_.counts() : surveyed_counts_; }
  /// Steps of single spheres so far.
  std::int64_t particle_steps() const { return levels_.counts().kicks; }
  /// With several levels: whether two spheres came so fast within a base step that they may have met before they were sought as a
  /// pair.
  bool missed_pairs() const { return missed_pairs_; }
  /// Where a sphere's centre went through a surface of triangles, which pushes it on since; nothing where none did.
  const std::optional<methods::spheres::Passage>& passage() const { return walls_.passage(); }
  /// Looks how much of a stable step the present contacts take; searches do so as well, at times.
  void look_at_step();
  /// The largest one that was seen so far.
  const methods::spheres::StepLoad& step_load() const { return step_load_; }
  /// With one step for all: how far a sphere came in a step in which it may have gone through a surface unseen; 0 where there was
  /// none [m].
  Real missed_way() const { return missed_way_; }

  void columns(Archive& archive);

private:
  const WorkSums& all_works() const { return ranks_ == nullptr ? works_ : surveyed_.works; }
  Vector3 acceleration(std::size_t sphere) const;
  Vector3 half_kick(std::size_t sphere) const;
  Vector3 half_turning_kick(std::size_t sphere) const;
  void add_energies(std::size_t sphere, MotionEnergies& sums) const;
  void add_energies(const state::Clump& clump, MotionEnergies& sums) const;
  void add_momenta(std::size_t sphere, Momenta& sums) const;
  bool is_member(std::size_t sphere) const {
    return !body_.empty() && body_[static_cast<std::size_t>(spheres_.number[sphere])] >= 0;
  }

  Real time_of(std::int64_t tick) const { return time() + static_cast<Real>(tick) * levels_.tick_seconds(); }
  SphereLevels::Scene scene(std::int64_t tick) {
    const std::span<const Real> all(&approach_, 1);
    return {spheres_, walls_, bonds_, water_, applied_, tile_approach_.empty() ? all : tile_approach_, time_of(tick)};
  }
  void evaluate(std::int64_t tick);
  void add_work(std::int64_t tick);
  SphereSpeeds kick(std::int64_t tick);
  void hold_clumps();
  Real carry_water(state::Clump& clump, std::span<const state::ClumpMember> members) const;
  void kick_clumps(std::size_t active_level, std::int64_t tick);
  void measure(const SphereSpeeds& speeds);
  void measure_tiles(std::span<const SphereSpeeds> by_tile);
  Real wall_approach_in(Real seconds, const SphereSpeeds& speeds) const;

  std::size_t own_tiles() const {
    return ranks_ == nullptr ? neighbors::tiles_of(spheres_.size()) : ranks_->owners().own().size();
  }
  std::size_t own_tile(std::size_t n) const { return ranks_ == nullptr ? n : ranks_->owners().own()[n]; }
  /// Calls visit(place) for the spheres for which this process works.
  template <class Visit>
  void visit_own(Visit&& visit) const {
    for (std::size_t n = 0; n < own_tiles(); ++n) visit_tile(own_tile(n), visit);
  }
  /// And for those of other ranks that it knows.
  template <class Visit>
  void visit_known(Visit&& visit) const {
    if (!knows_part())
      for (std::size_t i = 0; i < spheres_.size(); ++i) visit(i);
    else
      for (const Index i : ranks_->known()) visit(static_cast<std::size_t>(i));
  }
  template <class Visit>
  void visit_tile(std::size_t tile, Visit&& visit) const {
    const std::size_t end = std::min((tile + 1) * neighbors::tile_size, spheres_.size());
    for (std::size_t i = tile * neighbors::tile_size; i < end; ++i) visit(i);
  }
  /// What add(place, sums) adds up without rounding over these spheres, on several threads.
  template <class Sums, class Add>
  Sums sum_own(Add&& add) const {
    Sums sums;
    parallel::sum_over_ranges(own_tiles(), 2, sums, [&](std::size_t begin, std::size_t end, Sums& part) {
      for (std::size_t n = begin; n < end; ++n) visit_tile(own_tile(n), [&](std::size_t i) { add(i, part); });
    });
    return sums;
  }
  /// Does work whose processor time counts for the tiles of this rank.
  template <class Work>
  void spend(const Work& work) {
    if (ranks_ == nullptr) return work();
    const Real began = parallel::processor_seconds(), at_border = ranks_->border().seconds();
    work();
    ranks_->spent(parallel::processor_seconds() - began - (ranks_->border().seconds() - at_border));
  }
  bool owns_clump(std::size_t clump) const { return ranks_ == nullptr || clump_border_->owns(clump); }
  int owner_of_body(std::size_t sphere) const;
  SphereSpeeds advance_own(std::int64_t tick);
  void collect_motion(parallel::Topic topic);
  void share_bodies();
  void share_added_masses(parallel::Topic topic);
  void agree_on_passage();
  void plan_borders();

  bool can_walk() const;
  SphereSpeeds walk();
  void walk(std::size_t share, parallel::Progress& progress);
  SphereSpeeds move(std::size_t tile, std::span<const methods::spheres::PlaceRange> places, state::SphereLoad* loads);
  void find_work_of_driven(std::size_t begin, std::size_t end, const state::SphereLoad* loads);
  void add_work_of_driven();
  ComingLines coming(std::size_t tile) const;
  void ask_for_deferred(std::size_t tile) const;
  /// Which deferred tile of each share is the next one to be taken.
  using NextDeferred = std::vector<std::atomic<std::size_t>>;
  void kick_deferred(std::size_t share, const parallel::Progress& progress, NextDeferred& next_deferred);
  void share_out();
  void balance();

  using ContactsByTile = std::vector<std::vector<std::vector<ContactPoint>>>;  ///< by level and tile
  /// Those of other ranks that act on bodies of this one, with spheres and with walls.
  struct OthersContacts {
    ContactsByTile pairs, walls;
  };
  OthersContacts contacts_of_others() const;
  template <class Visit>
  void visit_contacts_of(std::size_t tile, std::size_t level, const Visit& visit) const;
  template <class Visit>
  void visit_wall_contacts_of(std::size_t tile, std::size_t level, const Visit& visit) const;
  void visit_contacts(const OthersContacts& of_others, const std::function<void(const ContactPoint&)>& visit) const;
  bool knows_part() const;
  bool seek_in_time(const SphereSpeeds& speeds);
  bool may_pass_unseen(const SphereSpeeds& speeds) const;
  void find_pairs();
  void arrange();
  void find_drift();
  Real margin_for_step() const;
  void find_places();
  void ask_for_large_pages() const;
  SphereLevels::Together together();
  void suppress_within_bodies();
  void wake_broken_within_pieces();
  void find_walls(std::span<const Index> new_place);
  /// What `of_number` says of a sphere, by place.
  template <class OfNumber>
  std::vector<Index> by_place(OfNumber&& of_number) const {
    std::vector<Index> values(spheres_.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = of_number(spheres_.number[i]);
    return values;
  }
  void part_broken(std::size_t coarsest);
  void part_pieces(Index body);

  void slow(Real kept);
  Real unrest();
  void add_unrest(std::size_t sphere, UnrestSums& sums) const;
  void add_unrest_of_clump(std::size_t clump, UnrestSums& sums) const;

  state::Spheres spheres_;
  methods::spheres::WallContacts walls_;
  methods::spheres::Bonds bonds_;
  state::Clumps clumps_;
  methods::spheres::BondedBodies bodies_;
  methods::spheres::WaterForces water_;
  methods::spheres::AppliedForces applied_;
  std::vector<Index> body_;   ///< by number of the sphere: its clump, below 0 where none; empty without clumps
  std::vector<Index> place_;  ///< by number, where the spheres stand; empty without bodies and bonds
  std::vector<Index> clump_at_;  ///< by place: which of `clumps_` a sphere is of, below 0 where none; empty without clumps
  std::vector<std::vector<Index>> clumps_at_active_level_;
  SphereRules rules_;
  std::shared_ptr<RankTiles> ranks_;           ///< nullptr alone; steppers that are copied, in a coupling, are
  std::shared_ptr<ClumpBorder> clump_border_;  ///< beside it
  SphereLevels levels_;
  std::int64_t step_ = 0, searches_ = 0;
  bool drives_ = false;              ///< some held sphere moves
  bool evaluated_ = false;           ///< the forces at `time()` are kept, and the kick is still to come
  Vector3 drift_ = Vector3::Zero();  ///< mean velocity when pairs were last found [m/s]
  Real approach_ = 0;                ///< how much nearer any two may have come since then [m]
  std::vector<Real> tile_approach_;  ///< by tile, of its candidate pairs [m]; empty with several levels
  Real wall_approach_ = 0;           ///< how much nearer a sphere and a wall may have come since then [m]
  Real margin_ = 0;                  ///< at which pairs were last found [m]
  bool missed_pairs_ = false;
  Real missed_way_ = 0;       ///< [m]
  Real smallest_radius_ = 0;  ///< [m]
  Real wall_radius_ = 0;      ///< of the spheres about the pivots of the walls [m]
  Real largest_speed_ = 0;
  WorkSums works_;
  /// With several ranks, in the first one: the sums of all of them at the last survey.
  struct Surveyed {
    WorkSums works;
    MotionEnergies motion;
  };
  Surveyed surveyed_;
  SphereLevels::Counts surveyed_counts_;
  std::optional<WorkSums> collected_works_;  ///< likewise, for the next `columns` that writes
  std::vector<Real> clumps_carried_;  ///< by clump of an active level: ContactSums::carried_energy of the last kick [J]
  methods::spheres::StepLoad step_load_;
  std::int64_t looked_at_step_ = -1;  ///< when `look_at_step` did so last

  // Results of a walk over the tiles.
  std::vector<SphereSpeeds> speeds_;  ///< by tile
  std::vector<Real> driven_work_;     ///< by deferred group: work of driven spheres in the last step [J]; empty without them
  std::vector<std::size_t> cuts_;     ///< of the tiles into shares, see LoadTable
  std::vector<Real> share_seconds_;   ///< by share of the tiles: processor time since costs were learnt [s]
  TileCosts tile_costs_;
};

}  // namespace sazare::methods::spheres
