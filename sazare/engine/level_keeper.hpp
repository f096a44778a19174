#pragma once

/// Keeps every body's time level and, through them, the clock of every link.
///
/// A level is refined at any time of the body's own, or at once when the body is woken; it is coarsened only at base
/// steps, where every coarser step is in phase.

#include <memory>
#include <span>
#include <vector>

#include "sazare/engine/limiters.hpp"
#include "sazare/schedule/levels.hpp"
#include "sazare/schedule/link_clock.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::engine {

template <int D>
using TermList = std::vector<std::unique_ptr<terms::Term<D>>>;

/// A link of one of the terms.
struct LinkOf {
  Index term = 0;
  Index link = 0;
};

template <int D>
class LevelKeeper {
 public:
  LevelKeeper(const StepRules& rules, const TermList<D>& terms, const state::Bodies<D>& bodies);

  const StepRules& rules() const { return rules_; }
  int level(Index body) const { return bodies_.level(body); }
  int finest() const { return bodies_.finest(); }
  Real step(int level) const { return rules_.base_step / static_cast<Real>(Tick{1} << level); }
  std::span<const Index> bodies_at(int level) const { return bodies_.at(level); }
  schedule::LinkClock& clock(std::size_t term) { return clocks_[term]; }

  /// At a base step: gives every body the coarsest level that the rules allow.
  void relevel(const state::Bodies<D>& bodies);

  /// Between base steps: refines what was asked for since the last tick. A body that is not due now is taken back to now
  /// and steps on from here, with a level that is in phase.
  void wake(const Moment& now, state::Bodies<D>& bodies);

  /// Level for the coming step of a body that has just been kicked; finer than its present one where its speed asks for it.
  int level_for_speed(Index body, Real speed) const;

  /// Takes over a finer level that a body has begun to step with.
  void refined(Index body, int level);

  /// Follows what a term has changed.
  void apply(std::size_t term, const terms::Changes& changes, Tick now);

  void columns(Archive& archive);

 private:
  int wanted_by_rates(Index body) const;
  const Link& bodies_of(const LinkOf& link) const;
  int link_level(const Link& link) const;
  void join(std::size_t term, Index link, Tick now);
  void part(std::size_t term, Index link);
  void set_level(Index body, int level);
  void ask(Index body, int level);
  void ask_neighbors(Index body);
  void ask_finer_partners(Index body, const Moment& now, const state::Bodies<D>& bodies);
  void spread(std::vector<std::int8_t>& wanted) const;

  StepRules rules_;
  schedule::Buckets bodies_;
  std::vector<schedule::LinkClock> clocks_;       ///< by term
  std::vector<std::vector<LinkOf>> links_;        ///< by body
  std::vector<std::int8_t> by_rates_;             ///< level that a body's own springs and dashpots ask for
  std::vector<std::int8_t> asked_;                ///< level asked for since the last tick, where in `asking_`
  std::vector<Index> asking_;
  const TermList<D>* terms_ = nullptr;
  bool stale_ = true;  ///< whether a relevel could change anything
};

extern template class LevelKeeper<2>;
extern template class LevelKeeper<3>;

}  // namespace sazare::engine
