#pragma once

/// Walks the ticks: the only place where a step is written.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "sazare/levels/distribute/balance.hpp"
#include "sazare/levels/distribute/replicas.hpp"
#include "sazare/levels/level_keeper.hpp"
#include "sazare/levels/motion/step.hpp"
#include "sazare/levels/terms/events.hpp"
#include "sazare/levels/terms/term.hpp"

namespace sazare::levels {

/// What the run has cost so far.
struct Counters {
  std::int64_t ticks = 0;                ///< ticks at which anything was due
  std::int64_t kicks = 0;                ///< steps of bodies
  std::int64_t pair_evaluations = 0;     ///< links of two bodies
  std::int64_t uniform_evaluations = 0;  ///< what they would have been had all bodies stepped with the finest
};

/// Wall-clock time by part of the step.
struct PartTime {
  std::string part;
  Real seconds = 0;
};

/// Positions and velocities of all bodies at a base step.
template <int D>
struct Snapshot {
  std::vector<state::Pose<D>> pose;
  std::vector<Vector<D>> velocity;
  std::vector<Angular<D>> angular_momentum;
  std::vector<state::StrainNow> strain;  ///< none where all bodies are rigid
};

/// One body of a snapshot.
template <int D>
struct BodyNow {
  state::Pose<D> pose;
  Vector<D> velocity;
  Angular<D> angular_momentum;
  state::StrainNow strain;
};

/// What a row of a history tells of.
template <int D>
struct Survey {
  Snapshot<D> bodies;
  std::vector<state::MeanMotion<D>> ahead;  ///< see terms::Synchronized
  terms::EnergyBalance energy;
};

/// What acts on a body in all, but for what its locks take up.
template <int D>
struct Load {
  Vector<D> force = Vector<D>::Zero();     ///< [N]
  Angular<D> moment = Angular<D>::Zero();  ///< about its centre [N m]
  Vector6 on_strain = Vector6::Zero();     ///< [N m]
};

/// The force on a body that nothing balances, as a share of one that means something there.
struct Unbalance {
  Index body = -1;
  Real share = 0;
};

/// How the work is shared out among the processes of a run.
struct Sharing {
  const parallel::Ranks* ranks = nullptr;  ///< none: this process does it all
  distribute::Policy policy = distribute::Policy::predicted;
  std::int64_t interval = 50;  ///< base steps after which owners are chosen anew
};

/// What one rank had to do until owners were chosen anew.
struct RankWork {
  Tick tick = 0;
  int rank = 0;
  Real seconds = 0;                ///< processor time of evaluations and kicks in the interval
  parallel::Traffic traffic;       ///< since the run began
  parallel::Sent expected_motion;  ///< about bodies at the borders, as foretold from levels and owners, see Replicas
  Real lock_step = 1;              ///< mean over ranks of evaluations and kicks over the largest, of all ticks of the interval
  Index border = 0;                ///< own bodies that others see
  Index ranges = 0;                ///< pieces of the curve that it owns
  std::array<Index, schedule::level_count> bodies{};  ///< that it owns, by active level

  Index body_count() const { return std::accumulate(bodies.begin(), bodies.end(), Index{0}); }
};

/// What a number of ranks would have to do and to say.
struct SharingForecast {
  Real lock_step = 1;  ///< as in RankWork
  Index fewest = 0;    ///< bodies of a rank
  Index most = 0;
  Real twice = 0;         ///< share of the evaluations of links that two ranks do
  parallel::Sent motion;  ///< about bodies at the borders in a base step: of the rank that sends most
};

template <int D>
class Simulation {
public:
  Simulation(state::Bodies<D> bodies, TermList<D> terms, const StepRules& rules, const Sharing& sharing = {});
  Simulation(const Simulation&) = delete;  // the levels look at its terms
  Simulation& operator=(const Simulation&) = delete;

  /// Evaluates the beginning; call once before the first `advance`, not after a resume.
  void start();

  /// To the next base step, or until `pause`, asked now and then on the way, says so: then false. Deep levels make a long way
  /// of it; the next call goes on from there. With several processes all ask at the same ticks.
  bool advance(const std::function<bool()>& pause = {}) {
    if (!approach(pause)) return false;
    arrive();
    return true;
  }

  /// The two parts of it: all bodies have come to where they are at the next base step, and then its forces are evaluated.
  bool approach(const std::function<bool()>& pause = {});
  void arrive();

  /// Before `start`: time does not begin with it, but with `begin_time`. What acts at times does not act until then, and bodies
  /// make steps that only lead to an equilibrium: all of them the longest one, those whose rates do not allow it as if they were
  /// heavier.
  void relax();

  /// Between `approach` and `arrive`, or before `start`: all bodies have these velocities, or stand still, and do not turn;
  /// forces act as from a beginning.
  void stand(std::span<const Vector<D>> velocity = {});

  /// Instead of `arrive`, in a run that relaxes: time begins with this base step, at 0, and so do energies and counters. Which
  /// bodies have got other rates.
  void begin_time(std::span<const Index> changed);

  /// Of the steps that bodies are making while they relax [J]. With several processes all call it, and all know it.
  Real kinetic_energy();

  /// At a base step: the largest force on a body, with its moment and the force on its strain over its reach, as a share of the
  /// force that is given for each body [N]. With several processes all call it, and all know it.
  Unbalance largest_unbalance(std::span<const Real> meaningful);

  /// Columns that only a run has that has relaxed, beside `columns`.
  void relaxation_columns(Archive& archive);

  Instant now() const { return now_; }
  const state::Bodies<D>& bodies() const { return bodies_; }
  const LevelKeeper<D>& levels() const { return levels_; }
  const Counters& counters() const { return counters_; }
  /// Where the time of all ticks went; not each of many short ones is measured.
  std::vector<PartTime> part_times() const;

  /// Motion and energy at `now()`. With several processes each finds what is its own: all call it, all know the motion then, and
  /// the first one the energy. In the memory of a former one, where one is given.
  Survey<D> survey(Survey<D> former = {}) const;

  /// With several processes: makes all that is read below true in the first one, for the present base step. All call it.
  void collect();

  /// With several processes: the same list in all of them, rising. All call it.
  void unite(std::vector<Index>& list) { peers().unite(list); }
  bool owns(Index body) const { return replicas_ == nullptr || replicas_->owns(body); }

  /// What so many processes would have to do and to say, as levels stand now.
  SharingForecast forecast(distribute::Policy policy, int ranks) const;

  /// With several processes: work of every rank since the last call, interval by interval. Empty when alone.
  std::vector<RankWork> take_rank_work() { return std::exchange(rank_work_, {}); }

  /// Positions and velocities at `now()`: the part of the last kicks that acts after it is taken back.
  Snapshot<D> snapshot() const {
    Snapshot<D> now;
    const distribute::BodyRange all{0, bodies_.size()};
    take_snapshot({&all, 1}, now);
    return now;
  }
  /// At a base step, alone: kicks bodies once more, as if their last kick had had these impulses in it as well. Their work is
  /// that of loads. The term whose they are has entered its forces before; each body stands in the list once.
  void add_to_kicks(std::span<const Index> which, std::span<const state::Impulse<D>> more);
  /// One body of it; with several processes, one that this process works for.
  BodyNow<D> body_now(Index body) const;
  /// Work on a body so far by cause [J]; with several processes, one that this process works for.
  const terms::CauseWork& work_on(Index body) const { return work_[at(body)]; }
  /// Forces on all bodies as last evaluated [N].
  std::vector<Vector<D>> forces() const;
  terms::EnergyBalance energy_balance() const { return energy_balance(snapshot()); }
  terms::EnergyBalance energy_balance(const Snapshot<D>& at_now) const {  ///< with a snapshot that is known already
    std::vector<state::MeanMotion<D>> ahead;
    return close(energy_sums(at_now, nullptr, ahead));
  }

  /// Smallest step since the last call [s].
  Real take_smallest_step();

  /// All columns of a checkpoint. After reading, the run goes on as if it had never stopped.
  void columns(Archive& archive);

private:
  void tick();
  void collect_due();
  std::int64_t collect_links(std::size_t term);
  void call_back();
  void take_refined();
  void divide_anew();
  void begin_sharing();
  void take_owners(distribute::Owners next);
  void foretell_motion();
  distribute::Outlook outlook(distribute::Outlook::Kind kind, const distribute::Owners& owners) const;
  distribute::ChunkWork chunk_work(int ranks, bool with_borders) const;
  std::vector<std::vector<Real>> work_at_levels(const distribute::Owners& owners) const;
  RankWork own_rank_work() const;
  template <class Visit>
  void visit_links(Visit&& visit) const;
  std::vector<std::vector<Real>> due_in_base_step(const distribute::Owners& owners) const;
  void count_work(std::size_t kind, std::size_t count, Real since);
  terms::Peers& peers() { return replicas_ ? static_cast<terms::Peers&>(*replicas_) : alone_; }
  bool travels() const;
  std::span<const distribute::BodyRange> own_ranges(const distribute::BodyRange& all) const {
    return replicas_ ? replicas_->own_ranges() : std::span(&all, 1);
  }
  std::vector<Load<D>> loads(std::span<const distribute::BodyRange> ranges) const;
  void kick_all();
  void add_mass();
  void take_off_mass();
  template <class Change>
  void change_mass(Change&& change);
  void kick_chunk(std::span<const Index> which);
  void kick_strain(Index body);
  motion::Stride stride(Index body, int active) const;
  int active_after(Index body, state::Impulse<D> given);
  state::MeanMotion<D> step_at(int active, Index body, const state::Impulse<D>& given);
  state::MeanMotion<D> step_faster(Index body, state::Impulse<D> given);
  void kick_again(Index body, const state::Impulse<D>& more);
  state::Impulse<D> gather_one(Index body, Real until_next) const;
  terms::StrainGathered gather_strain(Index body, Real until_next) const;
  state::StrainNow strain_now(Index body) const;
  std::int64_t post_step(std::int64_t since);
  std::int64_t add_time(std::size_t part, std::int64_t since);
  template <class Take>
  void gather(Index begin, Index end, Real until_next, Take&& take) const;
  void take_snapshot(std::span<const distribute::BodyRange> ranges, Snapshot<D>& at_now) const;
  void sum_body_energies(const Snapshot<D>& at_now, const distribute::Replicas<D>* shared,
                         std::vector<state::MeanMotion<D>>& ahead, terms::EnergySums& sums) const;
  terms::EnergySums energy_sums(const Snapshot<D>& at_now, const distribute::Replicas<D>* shared,
                     std::vector<state::MeanMotion<D>>& ahead) const;
  terms::EnergyBalance close(const terms::EnergySums& sums) const;

  state::Bodies<D> bodies_;
  TermList<D> terms_;
  std::vector<const terms::Term<D>*> strain_terms_;  ///< those that act on strains; none where all bodies are rigid
  LevelKeeper<D> levels_;
  Instant now_;
  std::vector<Index> due_bodies_;
  std::vector<Index> due_elsewhere_;             ///< with several processes: those of others that are seen here
  std::vector<std::span<const Due>> due_links_;  ///< by term
  terms::Events refined_;                        ///< levels that kicked bodies have given themselves, see take_refined
  std::vector<terms::CauseWork> work_;           ///< by body
  Counters counters_;
  std::vector<PartTime> times_;  ///< as measured, see part_times
  std::int64_t stepped_ = 0;     ///< time of all ticks [ns]
  std::int64_t counts_for_ = 0;  ///< so many ticks like the present one: 0 where it is not measured
  bool ticks_are_long_ = false;  ///< the last one that was measured; all are measured then
  int finest_seen_ = 0;
  std::vector<std::int8_t> added_;  ///< by body, as long as it relaxes: its mass is 4 to this power times its own in a kick
  terms::EnergyBalance at_start_;   ///< what energies count from

  terms::Peers alone_;
  std::unique_ptr<distribute::Replicas<D>> replicas_;  ///< none when alone
  distribute::Balance balance_;
  distribute::Work own_work_;
  std::int64_t interval_ = 0;
  std::vector<std::int32_t> tick_work_;  ///< evaluations and kicks of this rank at each tick of the interval
  parallel::Sent expected_motion_;       ///< until the end of the interval
  std::vector<RankWork> rank_work_;
};

extern template class Simulation<2>;
extern template class Simulation<3>;

}  // namespace sazare::levels
