/// The parts of a simulation that look at it and change nothing: for every row of a history they walk all bodies and links.

#include <algorithm>
#include <numeric>

#include "sazare/engine/simulation.hpp"
#include "sazare/motion/kick.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::engine {

namespace {

constexpr std::size_t serial_below = 1024;  // a body takes some 100 ns, waking a thread some microseconds

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

}  // namespace

/// Calls take(body, what it has received) for every body.
template <int D>
template <class Take>
void Simulation<D>::gather_all(Take&& take) const {
  const auto gather_chunk = [&](std::size_t begin, std::size_t end) {
    std::array<Index, terms::chunk_size> which;
    std::iota(which.begin(), which.end(), static_cast<Index>(begin));
    std::array<state::Impulse<D>, terms::chunk_size> given{};
    thread_local terms::CauseImpulses<D> ignored;
    ignored.clear();
    for (const auto& term : terms_)
      term->gather(now_, std::span(which.data(), end - begin), bodies_, std::span(given.data(), end - begin), ignored);
    for (std::size_t body = begin; body < end; ++body) {
      motion::clear_locked(given[body - begin], bodies_.locks[body]);
      take(body, given[body - begin]);
    }
  };
  parallel::parallel_for(at(bodies_.size()), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; chunk += terms::chunk_size)
      gather_chunk(chunk, std::min(chunk + terms::chunk_size, end));
  });
}

template <int D>
Snapshot<D> Simulation<D>::snapshot() const {
  Snapshot<D> at_now;
  at_now.pose.resize(at(bodies_.size()));
  at_now.velocity.resize(at_now.pose.size());
  at_now.angular_momentum.resize(at_now.pose.size());
  gather_all([&](std::size_t body, const state::Impulse<D>& given) {
    const auto& motion = bodies_.motion[body];
    at_now.pose[body] = state::pose_at(motion, now_);
    at_now.velocity[body] = motion.velocity - given.linear_ahead / bodies_.inertia[body].mass;
    at_now.angular_momentum[body] = motion.angular_momentum - given.angular_ahead;
  });
  return at_now;
}

template <int D>
std::vector<Vector<D>> Simulation<D>::forces() const {
  std::vector<Vector<D>> forces(at(bodies_.size()));
  gather_all([&](std::size_t body, const state::Impulse<D>& given) { forces[body] = given.force; });
  return forces;
}

template <int D>
terms::Ledger Simulation<D>::ledger(const Snapshot<D>& at_now) const {
  terms::Ledger ledger;
  std::vector<state::MeanMotion<D>> ahead;
  ahead.reserve(at_now.pose.size());
  Real kinetic = 0;
  for (std::size_t body = 0; body < at_now.pose.size(); ++body) {
    const auto& motion = bodies_.motion[body];
    const auto inverse = motion::inverse_inertia(at_now.pose[body].rotation, bodies_.inertia[body], bodies_.locks[body]);
    const Vector<D>& velocity = at_now.velocity[body];
    const Angular<D>& momentum = at_now.angular_momentum[body];
    const Angular<D> mean_momentum = 0.5 * (motion.angular_momentum + momentum), spin = inverse * momentum;
    ahead.push_back({0.5 * (motion.velocity + velocity), inverse * mean_momentum});
    kinetic += 0.5 * (bodies_.inertia[body].mass * velocity.squaredNorm() + momentum.dot(spin));
  }
  ledger[terms::Account::kinetic] = kinetic - kinetic_at_start_;
  for (const terms::CauseWork& work : work_)
    for (std::size_t cause = 0; cause < terms::cause_count; ++cause)
      terms::book(static_cast<terms::Cause>(cause), work[cause], ledger);
  for (const auto& term : terms_) term->add_energies({at_now.pose, ahead}, ledger);
  return ledger;
}

template Snapshot<2> Simulation<2>::snapshot() const;
template Snapshot<3> Simulation<3>::snapshot() const;
template std::vector<Vector<2>> Simulation<2>::forces() const;
template std::vector<Vector<3>> Simulation<3>::forces() const;
template terms::Ledger Simulation<2>::ledger(const Snapshot<2>&) const;
template terms::Ledger Simulation<3>::ledger(const Snapshot<3>&) const;

}  // namespace sazare::engine
