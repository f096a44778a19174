#include "sazare/levels/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/core/coming_lines.hpp"
#include "sazare/levels/motion/kick.hpp"
#include "sazare/levels/motion/strain.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::levels {

namespace {

constexpr std::size_t serial_below = 1024;  // a kick takes some 60 ns, waking a thread some microseconds
constexpr std::int64_t ticks_between_pauses = 64;
// Asking for the time takes as long as a few links. Where ticks are short one of seven is measured for all of them: levels come
// round in powers of two, so each kind of tick is met.
constexpr std::int64_t one_measured_of = 7;
constexpr std::int64_t long_tick = 100'000;  // [ns]

std::int64_t clock_now() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

template <int D>
Simulation<D>::Simulation(state::Bodies<D> bodies, TermList<D> terms, const StepRules& rules, const Sharing& sharing)
    : bodies_(std::move(bodies)),
      terms_(std::move(terms)),
      levels_(rules, terms_, bodies_),
      due_links_(terms_.size()),
      balance_(sharing.policy),
      interval_(sharing.interval) {
  if (sharing.ranks != nullptr && sharing.ranks->size() > 1)
    replicas_ = std::make_unique<distribute::Replicas<D>>(*sharing.ranks, bodies_, terms_);
  own_work_ = {std::vector<Real>(terms_.size() + 1, 0), std::vector<std::int64_t>(terms_.size() + 1, 0)};
  work_.resize(at(bodies_.size()));
  now_.tick_seconds = rules.base_step / static_cast<Real>(schedule::base_stride);
  for (const auto& term : terms_) times_.push_back({std::string(term->name()), 0});
  if (!bodies_.strain.empty())
    for (const auto& term : terms_)
      if (term->acts_on_strains()) strain_terms_.push_back(term.get());
  times_.push_back({"bodies", 0});
  times_.push_back({"schedule", 0});
  for (auto& motion : bodies_.motion) {
    motion.predicted_velocity = motion.velocity;
    motion.predicted_spin = motion.spin;
  }
  std::vector<state::MeanMotion<D>> ahead;
  const terms::EnergyBalance start = energy_sums(snapshot(), nullptr, ahead).balance();
  for (const terms::EnergyKind kind : {terms::EnergyKind::kinetic, terms::EnergyKind::elastic}) at_start_[kind] = start[kind];
}

/// Returns the time now, where it is measured.
template <int D>
std::int64_t Simulation<D>::add_time(std::size_t part, std::int64_t since) {
  if (counts_for_ == 0) return since;
  const std::int64_t now = clock_now();
  times_[part].seconds += 1e-9 * static_cast<Real>(counts_for_ * (now - since));
  return now;
}

template <int D>
std::vector<PartTime> Simulation<D>::part_times() const {
  Real measured = 0;
  for (const PartTime& part : times_) measured += part.seconds;
  std::vector<PartTime> all = times_;
  if (measured > 0)
    for (PartTime& part : all) part.seconds *= 1e-9 * static_cast<Real>(stepped_) / measured;
  return all;
}

template <int D>
void Simulation<D>::start() {
  const std::int64_t begin = clock_now();
  tick();
  stepped_ += clock_now() - begin;
  if (!replicas_) return;
  replicas_->collect(work_, parallel::To::all);
  begin_sharing();
}

template <int D>
bool Simulation<D>::approach(const std::function<bool()>& pause) {
  const Tick end = now_.tick - now_.tick % schedule::base_stride + schedule::base_stride;
  std::int64_t begin = clock_now();
  while (true) {
    if (pause && counters_.ticks % ticks_between_pauses == 0) {
      stepped_ += clock_now() - begin;
      if (pause()) return false;
      begin = clock_now();
    }
    now_.tick += schedule::stride(levels_.finest());
    now_.tick -= now_.tick % schedule::stride(levels_.finest());
    if (now_.tick == end) break;
    tick();
  }
  stepped_ += clock_now() - begin;
  return true;
}

template <int D>
void Simulation<D>::arrive() {
  const std::int64_t begin = clock_now();
  tick();
  stepped_ += clock_now() - begin;
  if (replicas_ && now_.tick / schedule::base_stride % interval_ == 0) divide_anew();
}

/// The step, as a list: choose levels, find what is due, evaluate, kick and drift, and carry out what terms change.
template <int D>
void Simulation<D>::tick() {
  const bool is_measured = ticks_are_long_ || counters_.ticks % one_measured_of == 0;
  counts_for_ = !is_measured ? 0 : ticks_are_long_ ? 1 : one_measured_of;
  const std::int64_t begin = is_measured ? clock_now() : 0;
  std::int64_t since = begin;
  const bool base = now_.tick % schedule::base_stride == 0;
  if (replicas_) tick_work_.push_back(0);
  if (base && replicas_ && travels()) replicas_->fetch_all();
  if (base)
    levels_.relevel(bodies_);
  else
    levels_.refine_asked();
  finest_seen_ = std::max(finest_seen_, levels_.finest());
  collect_due();
  since = add_time(terms_.size() + 1, since);
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    if (due_links_[term].empty()) continue;
    const Real worked = replicas_ ? parallel::processor_seconds() : 0;
    terms_[term]->evaluate(now_, due_links_[term], bodies_);
    if (replicas_) count_work(term, due_links_[term].size(), worked);
    since = add_time(term, since);
  }
  if (!now_.has_begun()) add_mass();
  kick_all();
  if (!now_.has_begun()) take_off_mass();
  ++counters_.ticks;
  const std::int64_t ended = post_step(add_time(terms_.size(), since));
  if (is_measured) ticks_are_long_ = ended - begin > long_tick;
}

template <int D>
void Simulation<D>::collect_due() {
  due_elsewhere_.clear();
  levels_.list_bodies_from_level(schedule::coarsest_due(now_.tick), due_bodies_);
  counters_.kicks += static_cast<std::int64_t>(due_bodies_.size());
  if (replicas_) {
    const std::vector<Index> everywhere = std::exchange(due_bodies_, {});
    replicas_->share_out(everywhere, due_bodies_, due_elsewhere_);
  }
  std::int64_t all_links = 0;
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    const std::int64_t count = collect_links(term);
    if (!terms_[term]->joins_bodies()) continue;
    counters_.pair_evaluations += count;
    all_links += static_cast<std::int64_t>(levels_.clock(term).size());
  }
  if (now_.tick % schedule::base_stride == 0) counters_.uniform_evaluations += all_links << levels_.finest();
  call_back();
}

/// Takes bodies that are due earlier than they had planned back to now. Those of others come from there.
template <int D>
void Simulation<D>::call_back() {
  std::vector<Index> due = levels_.take_quickened(schedule::coarsest_due(now_.tick)), elsewhere;
  if (due.empty()) return;
  if (replicas_) {
    const std::vector<Index> everywhere = std::exchange(due, {});
    replicas_->share_out(everywhere, due, elsewhere);
  }
  for (const Index body : due) {
    if (bodies_.motion[at(body)].due == now_.tick) continue;
    if constexpr (D == 3)
      if (!strain_terms_.empty()) motion::drift_strain_back(bodies_, body, now_);
    motion::drift_back(bodies_.motion[at(body)], bodies_.inertia[at(body)], now_);
  }
  if (replicas_) replicas_->exchange(due, elsewhere);
}

/// Links of a term that are due and evaluated here; returns how many are due everywhere.
template <int D>
std::int64_t Simulation<D>::collect_links(std::size_t term) {
  const std::span<Due> due = levels_.clock(term).collect(now_);
  const auto links = terms_[term]->links();
  std::size_t here = due.size();
  if (replicas_)
    here -= std::ranges::remove_if(due, [&](const Due& each) { return !replicas_->holds(links[at(each.link)]); }).size();
  due_links_[term] = due.first(here);
  return static_cast<std::int64_t>(due.size());
}

template <int D>
void Simulation<D>::kick_all() {
  const Real worked = replicas_ ? parallel::processor_seconds() : 0;
  parallel::parallel_for_uneven(due_bodies_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; chunk += terms::chunk_size)
      kick_chunk(std::span(due_bodies_).subspan(chunk, std::min(terms::chunk_size, end - chunk)));
  });
  if (replicas_) {
    count_work(terms_.size(), due_bodies_.size(), worked);
    replicas_->exchange(due_bodies_, due_elsewhere_);
  }
  if (travels()) take_refined();
}

/// Levels that kicked bodies have given themselves, each written as body and level in one.
template <int D>
void Simulation<D>::take_refined() {
  std::vector<Index> refined = refined_.take();
  peers().unite(refined);
  for (const Index both : refined) levels_.refined(both / schedule::level_count, both % schedule::level_count);
}

template <int D>
void Simulation<D>::kick_chunk(std::span<const Index> which) {
  thread_local std::array<state::Impulse<D>, terms::chunk_size> impulses;
  thread_local std::array<state::MeanMotion<D>, terms::chunk_size> means;
  thread_local std::array<motion::Stride, terms::chunk_size> strides;
  thread_local terms::CauseImpulses<D> parts;
  thread_local std::vector<std::size_t> too_fast;
  parts.clear();
  if (is_large(bodies_.motion))
    for (const Index body : which) {
      ask_for(bodies_.motion[at(body)]);
      ask_for(bodies_.inertia[at(body)]);
      ask_for(work_[at(body)]);
    }
  const std::span sums(impulses.data(), which.size());
  for (std::size_t i = 0; i < which.size(); ++i) {
    strides[i] = stride(which[i], levels_.active_level(which[i]));
    sums[i] = {};
    sums[i].until_next = strides[i].seconds;
  }
  for (const auto& term : terms_) term->gather(now_, which, bodies_, sums, parts);
  too_fast.clear();
  motion::step(bodies_, which, sums, std::span(strides.data(), which.size()), std::span(means.data(), which.size()), too_fast);
  for (const std::size_t i : too_fast) means[i] = step_faster(which[i], sums[i]);
  for (std::size_t i = 0; i < which.size(); ++i) parts.add_work(i, means[i], work_[at(which[i])]);
  if constexpr (D == 3)
    if (!strain_terms_.empty())
      for (const Index body : which) kick_strain(body);
}

/// Steps the strain of a body that has just been stepped itself.
template <int D>
void Simulation<D>::kick_strain(Index body) {
  if constexpr (D == 3) {
    if (bodies_.strain[at(body)].inverse_inertia == 0) return;
    const auto& motion = bodies_.motion[at(body)];
    const terms::StrainGathered all = gather_strain(body, static_cast<Real>(motion.due - now_.tick) * now_.tick_seconds);
    const Vector6 mean = motion::step(bodies_, body, all.impulse, now_.tick_seconds);
    for (std::size_t cause = 0; cause < terms::cause_count; ++cause)
      if (all.has_part[cause]) work_[at(body)][cause] += all.part[cause].dot(mean);
  }
}

/// What the strain of a body receives, and what its momentum gains by a time.
template <int D>
terms::StrainGathered Simulation<D>::gather_strain(Index body, Real until_next) const {
  terms::StrainGathered sum;
  sum.until_next = until_next;
  for (const auto* term : strain_terms_) term->gather_strain(now_, body, sum);
  return sum;
}

template <int D>
motion::Stride Simulation<D>::stride(Index body, int active) const {
  return {now_.tick, now_.tick + schedule::stride(active), levels_.step(active), levels_.fastest_squared(body)};
}

/// The active level of a body after a kick of this impulse, which may make it too fast for its level; it is refined then.
template <int D>
int Simulation<D>::active_after(Index body, state::Impulse<D> given) {
  motion::clear_locked(given, bodies_.locks[at(body)]);
  const Vector<D> velocity = bodies_.motion[at(body)].velocity + (1 / bodies_.inertia[at(body)].mass) * given.linear;
  const int level = levels_.level_for_speed(levels_.level(body), velocity.squaredNorm());
  if (level > levels_.level(body)) refined_.add(body * schedule::level_count + level);
  return std::max(level, levels_.active_level(body));
}

/// Steps a body by the step of an active level, whatever its speed.
template <int D>
state::MeanMotion<D> Simulation<D>::step_at(int active, Index body, const state::Impulse<D>& given) {
  motion::Stride stride = this->stride(body, active);
  stride.fastest_squared = std::numeric_limits<Real>::infinity();
  state::MeanMotion<D> mean;
  std::vector<std::size_t> none;
  motion::step(bodies_, std::span(&body, 1), std::span(&given, 1), std::span(&stride, 1), std::span(&mean, 1), none);
  return mean;
}

/// Steps a body that this kick makes too fast for its level.
template <int D>
state::MeanMotion<D> Simulation<D>::step_faster(Index body, state::Impulse<D> given) {
  const int active = active_after(body, given);
  if (active > levels_.active_level(body))
    given = gather_one(body, levels_.step(active));  // its momentum was predicted for a longer step
  return step_at(active, body, given);
}

template <int D>
void Simulation<D>::add_to_kicks(std::span<const Index> which, std::span<const state::Impulse<D>> more) {
  if (replicas_) throw std::logic_error("kicks are added to in a run of one process");
  parallel::parallel_for_uneven(which.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) kick_again(which[i], more[i]);
  });
  if (travels()) take_refined();
}

/// Takes a body back to its last kick, which was now, and steps it once more.
template <int D>
void Simulation<D>::kick_again(Index body, const state::Impulse<D>& more) {
  if constexpr (D == 3)
    if (!strain_terms_.empty()) motion::drift_strain_back(bodies_, body, now_);
  motion::drift_back(bodies_.motion[at(body)], bodies_.inertia[at(body)], now_);
  const int active = active_after(body, more);
  state::Impulse<D> given = gather_one(body, levels_.step(active));
  given.linear = more.linear;
  given.angular = more.angular;
  const state::MeanMotion<D> mean = step_at(active, body, given);
  work_[at(body)][static_cast<std::size_t>(terms::Cause::load)] += more.linear.dot(mean.velocity) + more.angular.dot(mean.spin);
  if constexpr (D == 3) {
    if (strain_terms_.empty()) return;
    terms::StrainGathered strained = gather_strain(body, levels_.step(active));
    strained.impulse.given.setZero();
    motion::step(bodies_, body, strained.impulse, now_.tick_seconds);
  }
}

/// What a body receives, and what its momentum gains by a time; the parts of its work are known already.
template <int D>
state::Impulse<D> Simulation<D>::gather_one(Index body, Real until_next) const {
  state::Impulse<D> sum;
  sum.until_next = until_next;
  thread_local terms::CauseImpulses<D> known;
  known.clear();
  for (const auto& term : terms_) term->gather(now_, std::span(&body, 1), bodies_, std::span(&sum, 1), known);
  return sum;
}

/// Lets all terms change what is linked. The time since `since` counts as theirs; returns when it ended. Asking for the time
/// takes as long as most terms, which change nothing.
template <int D>
std::int64_t Simulation<D>::post_step(std::int64_t since) {
  terms::Changes changes;
  const bool base = now_.tick % schedule::base_stride == 0;
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    changes.clear();
    terms_[term]->post_step(now_, bodies_, peers(), changes);
    if (base) terms_[term]->post_base_step(now_, bodies_, peers(), changes);
    if (!base && changes.empty()) continue;
    levels_.apply(term, changes, now_.tick);
    if (replicas_)
      for (const Index link : changes.new_links) replicas_->add_link(*terms_[term], link);
    since = add_time(term, since);
  }
  return add_time(terms_.size() + 1, since);
}

template <int D>
Real Simulation<D>::take_smallest_step() {
  return levels_.step(std::exchange(finest_seen_, levels_.finest()));
}

template <int D>
bool Simulation<D>::travels() const {
  return levels_.rules().travel_length < std::numeric_limits<Real>::infinity();
}

template <int D>
void Simulation<D>::columns(Archive& archive) {
  archive("tick", now_.tick);
  archive("motion", bodies_.motion);
  archive("inertia", bodies_.inertia);
  if (!bodies_.strain.empty()) archive("strain", bodies_.strain);
  archive("kinetic_at_start", at_start_[terms::EnergyKind::kinetic]);
  archive("work", work_);
  archive("finest_seen", finest_seen_);
  archive("ticks", counters_.ticks);
  archive("kicks", counters_.kicks);
  archive("pair_evaluations", counters_.pair_evaluations);
  archive("uniform_evaluations", counters_.uniform_evaluations);
  for (const auto& term : terms_) archive.folder(std::string(term->name()), [&] { term->columns(archive); });
  archive.folder("levels", [&] { levels_.columns(archive); });
  if (replicas_ && archive.reading()) begin_sharing();
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace sazare::levels
