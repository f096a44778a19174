/// The parts of a simulation that look at it and change nothing: for every row of a history they walk all bodies and links.
/// Processes that share a run each walk their own.

#include <algorithm>
#include <numeric>

#include "sazare/engine/simulation.hpp"
#include "sazare/motion/kick.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/terms/book_ranges.hpp"

namespace sazare::engine {

namespace {

constexpr std::size_t serial_below = 1024;  // a body takes some 100 ns, waking a thread some microseconds

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

}  // namespace

/// Calls take(body, what it has received, and what its momentum gains by a time; about the pole) for bodies of a range.
template <int D>
template <class Take>
void Simulation<D>::gather(Index begin, Index end, Real until_next, Take&& take) const {
  const auto gather_chunk = [&](std::size_t from, std::size_t to) {
    std::array<Index, terms::chunk_size> which;
    std::iota(which.begin(), which.end(), static_cast<Index>(from));
    thread_local std::array<state::Impulse<D>, terms::chunk_size> given;
    for (std::size_t i = 0; i < to - from; ++i) {
      given[i] = {};
      given[i].until_next = until_next;
    }
    thread_local terms::CauseImpulses<D> ignored;
    ignored.clear();
    for (const auto& term : terms_)
      term->gather(now_, std::span(which.data(), to - from), bodies_, std::span(given.data(), to - from), ignored);
    for (std::size_t body = from; body < to; ++body) take(body, given[body - from]);
  };
  parallel::parallel_for(at(end - begin), serial_below, [&](std::size_t from, std::size_t to) {
    for (std::size_t chunk = at(begin) + from; chunk < at(begin) + to; chunk += terms::chunk_size)
      gather_chunk(chunk, std::min(chunk + terms::chunk_size, at(begin) + to));
  });
}

/// That of a range of bodies, the others left empty.
template <int D>
Snapshot<D> Simulation<D>::snapshot(Index begin, Index end) const {
  Snapshot<D> at_now;
  at_now.pose.resize(at(bodies_.size()));
  at_now.velocity.resize(at_now.pose.size());
  at_now.angular_momentum.resize(at_now.pose.size());
  parallel::parallel_for(at(end - begin), serial_below, [&](std::size_t from, std::size_t to) {
    const std::size_t first = at(begin) + from, count = to - from;
    state::poses_at(std::span(bodies_.motion).subspan(first, count), now_, std::span(at_now.pose).subspan(first, count));
  });
  gather(begin, end, 0, [&](std::size_t body, const state::Impulse<D>& about_pole) {
    const auto& motion = bodies_.motion[body];
    state::Impulse<D> given = about_pole.about(at_now.pose[body].position - bodies_.pole);
    motion::clear_locked(given, bodies_.locks[body]);
    at_now.velocity[body] = motion.velocity + given.linear_lead / bodies_.inertia[body].mass;
    at_now.angular_momentum[body] = motion.angular_momentum + given.angular_lead;
  });
  return at_now;
}

/// A body's kick does not sum its forces. They are the slope of what is taken back with them: over a second so long ago that
/// every force has been given beyond it.
template <int D>
std::vector<Vector<D>> Simulation<D>::forces() const {
  std::vector<Vector<D>> forces(at(bodies_.size()), Vector<D>::Zero());
  constexpr Real early = -2, late = -1;
  const auto take = [&](Real sign) {
    return [&, sign](std::size_t body, state::Impulse<D> given) {
      motion::clear_locked(given, bodies_.locks[body]);
      forces[body] += sign * given.linear_lead;
    };
  };
  gather(0, bodies_.size(), late, take(1));
  gather(0, bodies_.size(), early, take(-1));
  return forces;
}

/// Enters what bodies and links have; of a process that shares them, its own.
template <int D>
terms::Books Simulation<D>::books(const Snapshot<D>& at_now, const distribute::Replicas<D>* shared) const {
  terms::Books books;
  std::vector<state::MeanMotion<D>> ahead(at_now.pose.size());
  terms::book_ranges(ahead.size(), serial_below, books, [&](std::size_t begin, std::size_t end, terms::Books& part) {
    for (std::size_t body = begin; body < end; ++body) {
      const auto& motion = bodies_.motion[body];
      const auto& inertia = bodies_.inertia[body];
      const Rotation<D>& rotation = at_now.pose[body].rotation;
      const Vector<D>& velocity = at_now.velocity[body];
      const Angular<D>& momentum = at_now.angular_momentum[body];
      const Angular<D> mean_momentum = 0.5 * (motion.angular_momentum + momentum);
      const state::MeanMotion<D> mean{0.5 * (motion.velocity + velocity),
                                      motion::spin_of(rotation, inertia, bodies_.locks[body], mean_momentum)};
      ahead[body] = mean.at(bodies_.pole - at_now.pose[body].position);
      if (shared != nullptr && !shared->owns(static_cast<Index>(body))) continue;
      part[terms::Account::kinetic] += motion::kinetic_energy<D>(rotation, inertia, bodies_.locks[body], velocity, momentum);
      for (std::size_t cause = 0; cause < terms::cause_count; ++cause)  // most bodies know one or two
        if (work_[body][cause] != 0) terms::book(static_cast<terms::Cause>(cause), work_[body][cause], part);
    }
  });
  for (const auto& term : terms_) term->add_energies({at_now.pose, ahead, shared}, books);
  return books;
}

/// The kinetic energy counts from the beginning.
template <int D>
terms::Ledger Simulation<D>::close(const terms::Books& books) const {
  terms::Ledger ledger = books.ledger();
  ledger[terms::Account::kinetic] -= kinetic_at_start_;
  return ledger;
}

template <int D>
Survey<D> Simulation<D>::survey() const {
  if (!replicas_) {
    Snapshot<D> all = snapshot();
    const terms::Ledger ledger = this->ledger(all);
    return {std::move(all), ledger};
  }
  const int rank = replicas_->ranks().rank();
  Snapshot<D> all = snapshot(replicas_->ranges().begin(rank), replicas_->ranges().end(rank));
  replicas_->complete(all.pose);
  replicas_->complete(all.velocity);
  replicas_->complete(all.angular_momentum);
  terms::Books sum;
  for (const terms::Books& part : replicas_->give_first(books(all, replicas_.get()))) sum += part;
  return {std::move(all), close(sum)};
}

template Snapshot<2> Simulation<2>::snapshot(Index, Index) const;
template Snapshot<3> Simulation<3>::snapshot(Index, Index) const;
template terms::Ledger Simulation<2>::close(const terms::Books&) const;
template terms::Ledger Simulation<3>::close(const terms::Books&) const;
template Survey<2> Simulation<2>::survey() const;
template Survey<3> Simulation<3>::survey() const;
template std::vector<Vector<2>> Simulation<2>::forces() const;
template std::vector<Vector<3>> Simulation<3>::forces() const;
template terms::Books Simulation<2>::books(const Snapshot<2>&, const distribute::Replicas<2>*) const;
template terms::Books Simulation<3>::books(const Snapshot<3>&, const distribute::Replicas<3>*) const;

}  // namespace sazare::engine
