/// The parts of a simulation that look at it and change nothing: for every row of a history they walk all bodies and links.
/// Processes that share a run each walk their own.

#include <algorithm>
#include <numeric>
#include <utility>

#include "sazare/levels/motion/kick.hpp"
#include "sazare/levels/motion/strain.hpp"
#include "sazare/levels/motion/synchronize.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/parallel/sum_over_ranges.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::levels {

namespace {

constexpr std::size_t serial_below = 1024;  // a body takes some 100 ns, waking a thread some microseconds

}  // namespace

/// Calls take(body, impulses) for bodies of a range, a chunk at a time: what those from `body` on have received, and what their
/// momenta gain by a time; about the pole.
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
    take(from, std::span<const state::Impulse<D>>(given.data(), to - from));
  };
  parallel::parallel_for(at(end - begin), serial_below, [&](std::size_t from, std::size_t to) {
    for (std::size_t chunk = at(begin) + from; chunk < at(begin) + to; chunk += terms::chunk_size)
      gather_chunk(chunk, std::min(chunk + terms::chunk_size, at(begin) + to));
  });
}

/// Fills the snapshot of ranges of bodies.
template <int D>
void Simulation<D>::take_snapshot(std::span<const distribute::BodyRange> ranges, Snapshot<D>& at_now) const {
  at_now.pose.resize(at(bodies_.size()));
  at_now.velocity.resize(at_now.pose.size());
  at_now.angular_momentum.resize(at_now.pose.size());
  const auto enter = [&](std::size_t first, std::span<const state::Impulse<D>> given) {
    const auto some = [&](auto& column) { return std::span(column).subspan(first, given.size()); };
    state::poses_at(some(bodies_.motion), now_, some(at_now.pose));
    motion::find_momenta<D>(bodies_, first, given, {some(at_now.pose), some(at_now.velocity), some(at_now.angular_momentum)});
  };
  for (const distribute::BodyRange& range : ranges) gather(range.begin, range.end, 0, enter);
  if (strain_terms_.empty()) return;
  at_now.strain.resize(at(bodies_.size()));
  for (const distribute::BodyRange& range : ranges)
    parallel::parallel_for(at(range.end - range.begin), serial_below, [&](std::size_t from, std::size_t to) {
      for (std::size_t body = at(range.begin) + from; body < at(range.begin) + to; ++body)
        at_now.strain[body] = strain_now(static_cast<Index>(body));
    });
}

/// The strain of a body at `now()`.
template <int D>
state::StrainNow Simulation<D>::strain_now(Index body) const {
  if constexpr (D == 3)
    if (!strain_terms_.empty()) return motion::strain_now(bodies_, body, now_, gather_strain(body, 0).impulse);
  return {};
}

template <int D>
BodyNow<D> Simulation<D>::body_now(Index body) const {
  BodyNow<D> now;
  gather(body, body + 1, 0, [&](std::size_t first, std::span<const state::Impulse<D>> given) {
    state::poses_at(std::span(bodies_.motion).subspan(first, 1), now_, std::span(&now.pose, 1));
    motion::find_momenta<D>(bodies_, first, given,
                            {std::span(&now.pose, 1), std::span(&now.velocity, 1), std::span(&now.angular_momentum, 1)});
  });
  now.strain = strain_now(body);
  return now;
}

/// A body's kick does not sum its forces. They are the slope of what is taken back with them: over a second so long ago that
/// every force has been given beyond it.
template <int D>
std::vector<Load<D>> Simulation<D>::loads(std::span<const distribute::BodyRange> ranges) const {
  std::vector<Load<D>> loads(at(bodies_.size()));
  constexpr Real early = -2, late = -1;
  const auto take = [&](Real sign) {
    return [&, sign](std::size_t first, std::span<const state::Impulse<D>> all) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t body = first + i;
        state::Impulse<D> given = all[i].about(state::pose_at(bodies_.motion[body], now_).position - bodies_.pole);
        motion::clear_locked(given, bodies_.locks[body]);
        loads[body].force += sign * given.linear_lead;
        loads[body].moment += sign * given.angular_lead;
      }
    };
  };
  for (const distribute::BodyRange& range : ranges) {
    gather(range.begin, range.end, late, take(1));
    gather(range.begin, range.end, early, take(-1));
    if constexpr (D == 3)
      if (!strain_terms_.empty())
        for (Index body = range.begin; body < range.end; ++body)
          loads[at(body)].on_strain =
              motion::free_force(bodies_, body, gather_strain(body, late).impulse.lead - gather_strain(body, early).impulse.lead);
  }
  return loads;
}

template <int D>
std::vector<Vector<D>> Simulation<D>::forces() const {
  const distribute::BodyRange all{0, bodies_.size()};
  std::vector<Vector<D>> forces;
  for (const Load<D>& load : loads({&all, 1})) forces.push_back(load.force);
  return forces;
}

/// Enters what bodies have; of a process that shares them, its own. Finds the means of all bodies' motion now and after their
/// last kicks.
template <int D>
void Simulation<D>::sum_body_energies(const Snapshot<D>& at_now, const distribute::Replicas<D>* shared,
                                std::vector<state::MeanMotion<D>>& ahead, terms::EnergySums& sums) const {
  ahead.resize(at_now.pose.size());
  const distribute::BodyRange all{0, static_cast<Index>(ahead.size())};
  const auto own = shared == nullptr ? std::span(&all, 1) : shared->own_ranges();
  parallel::sum_over_ranges(ahead.size(), serial_below, sums, [&](std::size_t begin, std::size_t end, terms::EnergySums& part) {
    const auto some = [&](const auto& column) { return std::span(column).subspan(begin, end - begin); };
    std::vector<Real> kinetic(end - begin);
    motion::find_energies<D>(bodies_, begin, {some(at_now.pose), some(at_now.velocity), some(at_now.angular_momentum)}, kinetic,
                          std::span(ahead).subspan(begin, end - begin));
    for (const distribute::BodyRange& range : own) {
      const std::size_t from = std::clamp(at(range.begin), begin, end), to = std::clamp(at(range.end), begin, end);
      for (std::size_t body = from; body < to; ++body) part[terms::EnergyKind::kinetic] += kinetic[body - begin];
      if (!at_now.strain.empty())
        for (std::size_t body = from; body < to; ++body)
          part[terms::EnergyKind::kinetic] += motion::strain_energy(bodies_.strain[body], at_now.strain[body].rate);
      terms::add_work(std::span(work_).subspan(from, to - from), part);
    }
  });
}

/// Enters what bodies and links have; of a process that shares them, its own.
template <int D>
terms::EnergySums Simulation<D>::energy_sums(const Snapshot<D>& at_now, const distribute::Replicas<D>* shared,
                                  std::vector<state::MeanMotion<D>>& ahead) const {
  terms::EnergySums sums;
  sum_body_energies(at_now, shared, ahead, sums);
  for (const auto& term : terms_) term->add_energies({at_now.pose, ahead, now_.seconds(), shared, at_now.strain}, sums);
  return sums;
}

/// Energies count from the beginning.
template <int D>
terms::EnergyBalance Simulation<D>::close(const terms::EnergySums& sums) const {
  terms::EnergyBalance balance = sums.balance();
  for (std::size_t kind = 0; kind < terms::energy_kind_count; ++kind) balance.joules[kind] -= at_start_.joules[kind];
  return balance;
}

/// Large tables that are freed go back to the system, which clears each page that it gives: hence the former one.
template <int D>
Survey<D> Simulation<D>::survey(Survey<D> former) const {
  Survey<D> now = std::move(former);
  Snapshot<D>& all = now.bodies;
  if (!replicas_) {
    const distribute::BodyRange every{0, bodies_.size()};
    take_snapshot({&every, 1}, all);
    now.energy = close(energy_sums(all, nullptr, now.ahead));
    return now;
  }
  take_snapshot(replicas_->own_ranges(), all);
  replicas_->complete(all.pose);
  replicas_->complete(all.velocity);
  replicas_->complete(all.angular_momentum);
  if (!all.strain.empty()) replicas_->complete(all.strain);
  replicas_->show_borders();
  terms::EnergySums sum;
  for (const terms::EnergySums& part : replicas_->give_first(energy_sums(all, replicas_.get(), now.ahead))) sum += part;
  now.energy = close(sum);
  return now;
}

template state::StrainNow Simulation<2>::strain_now(Index) const;
template state::StrainNow Simulation<3>::strain_now(Index) const;
template void Simulation<2>::take_snapshot(std::span<const distribute::BodyRange>, Snapshot<2>&) const;
template void Simulation<3>::take_snapshot(std::span<const distribute::BodyRange>, Snapshot<3>&) const;
template BodyNow<2> Simulation<2>::body_now(Index) const;
template BodyNow<3> Simulation<3>::body_now(Index) const;
template terms::EnergyBalance Simulation<2>::close(const terms::EnergySums&) const;
template terms::EnergyBalance Simulation<3>::close(const terms::EnergySums&) const;
template Survey<2> Simulation<2>::survey(Survey<2>) const;
template Survey<3> Simulation<3>::survey(Survey<3>) const;
template std::vector<Load<2>> Simulation<2>::loads(std::span<const distribute::BodyRange>) const;
template std::vector<Load<3>> Simulation<3>::loads(std::span<const distribute::BodyRange>) const;
template std::vector<Vector<2>> Simulation<2>::forces() const;
template std::vector<Vector<3>> Simulation<3>::forces() const;
template void Simulation<2>::sum_body_energies(const Snapshot<2>&, const distribute::Replicas<2>*,
                                               std::vector<state::MeanMotion<2>>&, terms::EnergySums&) const;
template void Simulation<3>::sum_body_energies(const Snapshot<3>&, const distribute::Replicas<3>*,
                                               std::vector<state::MeanMotion<3>>&, terms::EnergySums&) const;
template terms::EnergySums Simulation<2>::energy_sums(const Snapshot<2>&, const distribute::Replicas<2>*,
                                           std::vector<state::MeanMotion<2>>&) const;
template terms::EnergySums Simulation<3>::energy_sums(const Snapshot<3>&, const distribute::Replicas<3>*,
                                           std::vector<state::MeanMotion<3>>&) const;

}  // namespace sazare::levels
