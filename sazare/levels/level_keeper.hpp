#pragma once

/// Keeps the time level of every body and, through them, the clock of every link and the active level of every body.
///
/// A link has the finer level of its two bodies, or is inactive, at level 0. A body is kicked whenever one of its links is due:
/// its active level is the finest one among its links. So no impulse ever waits, whatever is evaluated sees every body as it is,
/// and the scheme is an asynchronous variational integrator (Lew, Marsden, Ortiz, West 2003): undamped energy keeps its bounds at
/// any mix of levels, which it does not where coarse bodies collect impulses until their own time. A level is refined at any
/// tick, and coarsened only at base steps, where every coarser step is in phase.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sazare/levels/limiters.hpp"
#include "sazare/levels/link_lists.hpp"
#include "sazare/levels/schedule/levels.hpp"
#include "sazare/levels/schedule/link_clock.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::levels {

template <int D>
using TermList = std::vector<std::unique_ptr<terms::Term<D>>>;

template <int D>
class LevelKeeper {
public:
  LevelKeeper(const StepRules& rules, const TermList<D>& terms, const state::Bodies<D>& bodies);

  const StepRules& rules() const { return rules_; }
  int level(Index body) const { return level_[static_cast<std::size_t>(body)]; }
  int active_level(Index body) const { return active_levels_.level(body); }
  int finest() const { return active_levels_.finest(); }
  Real step(int level) const { return steps_[static_cast<std::size_t>(level)]; }
  void list_bodies_from_level(int level, std::vector<Index>& bodies) const { active_levels_.list_from(level, bodies); }
  /// Takes the bodies whose active level has risen to `level` or finer since they were kicked, and which are therefore due
  /// earlier than planned.
  std::vector<Index> take_quickened(int level);
  schedule::LinkClock& clock(std::size_t term) { return clocks_[term]; }
  const schedule::LinkClock& clock(std::size_t term) const { return clocks_[term]; }

  /// At a base step: gives every body the coarsest level that the rules allow.
  void relevel(const state::Bodies<D>& bodies);

  /// Between base steps: refines what was asked for since the last tick.
  void refine_asked();

  /// Square of the largest speed with which a body keeps its level [m2/s2].
  Real fastest_squared(Index body) const { return fastest_squared_[static_cast<std::size_t>(level(body))]; }

  /// The coarsest level from a given one on that a speed allows.
  int level_for_speed(int level, Real speed_squared) const {
    while (level < schedule::deepest_level && speed_squared > fastest_squared_[static_cast<std::size_t>(level)]) ++level;
    return level;
  }

  /// Takes over a finer level that a body has begun to step with.
  void refined(Index body, int level);

  /// Follows what a term has changed.
  void apply(std::size_t term, const terms::Changes& changes, Tick now);

  /// At a base step: all forces act from now on, as at a beginning.
  void restart(Tick now) {
    for (schedule::LinkClock& clock : clocks_) clock.restart(now);
  }

  /// Whether all bodies are to make the longest step, whatever their rates ask for: then `level_by_rates` is for others to
  /// follow.
  void relax(bool relaxes) {
    relaxes_ = relaxes;
    stale_ = true;
  }
  int level_by_rates(Index body) const { return by_rates_[static_cast<std::size_t>(body)]; }

  /// The rates of these bodies may have become others, larger or smaller.
  void look_again(std::span<const Index> bodies);

  void columns(Archive& archive);

private:
  int wanted_by_rates(Index body) const;
  const Link& bodies_of(const LinkOf& link) const;
  int link_level(const LinkOf& of) const;
  bool is_inactive(const LinkOf& of) const;
  void set_inactive(const LinkOf& of, bool is_inactive);
  void join(std::size_t term, Index link, Tick now);
  void part(std::size_t term, Index link);
  void set_level(Index body, int level);
  void quicken(Index body, int level);
  int finest_around(Index body) const;
  void slow_down();
  void choose_levels(const state::Bodies<D>& bodies);
  void ask(Index body, int level);
  void ask_neighbors(Index body);
  void spread(std::vector<std::int8_t>& wanted) const;

  StepRules rules_;
  std::array<Real, schedule::level_count> steps_{};            ///< by level [s]
  std::array<Real, schedule::level_count> fastest_squared_{};  ///< by level: square of the largest speed [m2/s2]
  schedule::Buckets active_levels_;                                    ///< bodies by the level at which they are kicked
  std::vector<schedule::LinkClock> clocks_;                    ///< by term
  std::vector<std::vector<std::int8_t>> inactive_;              ///< by term and link; shorter than there are links
  LinkLists links_;                                            ///< by body
  std::vector<std::int8_t> level_;                             ///< by body
  std::vector<std::int8_t> by_rates_;                          ///< level that a body's own springs and dashpots ask for
  std::vector<std::int8_t> asked_;                             ///< level asked for since the last tick, where in `asking_`
  std::vector<Index> asking_;
  std::vector<Index> calmed_;     ///< bodies whose active level may fall at the next base step
  std::vector<Index> quickened_;  ///< see take_quickened; some more than once
  const TermList<D>* terms_ = nullptr;
  bool relaxes_ = false;
  bool stale_ = true;  ///< whether a relevel could change anything
};

extern template class LevelKeeper<2>;
extern template class LevelKeeper<3>;

}  // namespace sazare::levels
