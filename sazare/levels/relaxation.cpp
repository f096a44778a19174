/// The parts of a simulation with which bodies come to rest before time begins.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "sazare/levels/motion/strain.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/parallel/sum_over_ranges.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::levels {

namespace {

constexpr std::size_t serial_below = 1024;  // a body takes some 50 ns, waking a thread some microseconds

/// Records of all processes, one after the other.
template <class Record>
std::vector<Record> from_all(const terms::Peers& peers, const Record& own) {
  const std::vector<std::byte> bytes = peers.gather(std::as_bytes(std::span(&own, 1)));
  std::vector<Record> all(bytes.size() / sizeof(Record));
  std::memcpy(static_cast<void*>(all.data()), bytes.data(), bytes.size());
  return all;
}

/// The one that is larger; of equal ones that of the first body, whoever finds it.
Unbalance larger(const Unbalance& a, const Unbalance& b) {
  return a.share > b.share || (a.share == b.share && a.body < b.body) ? a : b;
}

}  // namespace

template <int D>
void Simulation<D>::relax() {
  now_.start = Instant::not_begun;
  levels_.relax(true);
  added_.assign(bodies_.motion.size(), 0);
}

/// Multiplies inertias by 2 to the power that change(body) gives: no digit of them is lost.
template <int D>
template <class Change>
void Simulation<D>::change_mass(Change&& change) {
  parallel::parallel_for(bodies_.motion.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t body = begin; body < end; ++body) {
      const int power = change(body);
      if (power == 0) continue;
      state::Inertia<D>& inertia = bodies_.inertia[body];
      inertia.mass = std::ldexp(inertia.mass, power);
      inertia.inverse_moments *= std::ldexp(Real{1}, -power);
      if (!bodies_.strain.empty()) bodies_.strain[body].inverse_inertia *= std::ldexp(Real{1}, -power);
    }
  });
}

/// A step that is 2^k times as long as rates allow is stable with a mass that is 4^k times as large.
template <int D>
void Simulation<D>::add_mass() {
  change_mass([&](std::size_t body) {
    const int before = added_[body], now = levels_.level_by_rates(static_cast<Index>(body));
    if (now != before) bodies_.motion[body].angular_momentum *= std::ldexp(Real{1}, 2 * (now - before));
    added_[body] = static_cast<std::int8_t>(now);
    return 2 * now;
  });
}

/// Rates are those of the masses that bodies have.
template <int D>
void Simulation<D>::take_off_mass() {
  change_mass([&](std::size_t body) { return -2 * added_[body]; });
}

template <int D>
void Simulation<D>::stand(std::span<const Vector<D>> velocity) {
  for (std::size_t body = 0; body < bodies_.motion.size(); ++body) {
    state::Motion<D>& motion = bodies_.motion[body];
    motion.velocity = velocity.empty() ? Vector<D>(Vector<D>::Zero()) : velocity[body];
    motion.predicted_velocity = motion.velocity;
    motion.angular_momentum.setZero();
    motion.spin.setZero();
    motion.predicted_spin.setZero();
  }
  for (state::Strain& strain : bodies_.strain) {
    strain.rate.setZero();
    strain.predicted_rate.setZero();
  }
  levels_.restart(now_.tick);
}

template <int D>
void Simulation<D>::begin_time(std::span<const Index> changed) {
  now_.start = now_.tick;
  levels_.relax(false);
  levels_.look_again(changed);
  std::ranges::fill(work_, terms::CauseWork{});
  counters_ = {};
  rank_work_.clear();
  arrive();
  finest_seen_ = levels_.finest();
  at_start_ = {};
  at_start_ = survey().energy;
}

template <int D>
Real Simulation<D>::kinetic_energy() {
  const distribute::BodyRange all{0, bodies_.size()};
  const auto own = own_ranges(all);
  terms::EnergySums sums;
  parallel::sum_over_ranges(
      at(bodies_.size()), serial_below, sums, [&](std::size_t begin, std::size_t end, terms::EnergySums& part) {
        ExactSum& sum = part[terms::EnergyKind::kinetic];
        for (const distribute::BodyRange& range : own) {
          const std::size_t from = std::clamp(at(range.begin), begin, end), to = std::clamp(at(range.end), begin, end);
          for (std::size_t body = from; body < to; ++body) {
            const state::Motion<D>& motion = bodies_.motion[body];
            const Real mass = std::ldexp(bodies_.inertia[body].mass, 2 * added_[body]);
            sum += 0.5 * (mass * motion.velocity.squaredNorm() + motion.spin.dot(motion.angular_momentum));
            if (!bodies_.strain.empty())
              sum += std::ldexp(motion::strain_energy(bodies_.strain[body], bodies_.strain[body].rate), 2 * added_[body]);
          }
        }
      });
  ExactSum total;
  for (const ExactSum& part : from_all(peers(), sums[terms::EnergyKind::kinetic])) total += part;
  return total.value();
}

template <int D>
Unbalance Simulation<D>::largest_unbalance(std::span<const Real> meaningful) {
  const distribute::BodyRange all{0, bodies_.size()};
  const std::vector<Load<D>> loads = this->loads(own_ranges(all));
  Unbalance largest;
  for (const distribute::BodyRange& range : own_ranges(all))
    for (Index body = range.begin; body < range.end; ++body) {
      const Load<D>& load = loads[at(body)];
      const Real force = load.force.norm() + (load.moment.norm() + load.on_strain.norm()) / bodies_.reach[at(body)];
      largest = larger(largest, {body, force / meaningful[at(body)]});
    }
  for (const Unbalance& of : from_all(peers(), largest)) largest = larger(largest, of);
  return largest;
}

template <int D>
void Simulation<D>::relaxation_columns(Archive& archive) {
  archive("start", now_.start);
  for (std::size_t kind = 0; kind < terms::energy_kind_count; ++kind)
    archive("energy_" + std::to_string(kind), at_start_.joules[kind]);
}

template void Simulation<2>::relax();
template void Simulation<3>::relax();
template void Simulation<2>::add_mass();
template void Simulation<3>::add_mass();
template void Simulation<2>::take_off_mass();
template void Simulation<3>::take_off_mass();
template void Simulation<2>::stand(std::span<const Vector<2>>);
template void Simulation<3>::stand(std::span<const Vector<3>>);
template void Simulation<2>::begin_time(std::span<const Index>);
template void Simulation<3>::begin_time(std::span<const Index>);
template Real Simulation<2>::kinetic_energy();
template Real Simulation<3>::kinetic_energy();
template Unbalance Simulation<2>::largest_unbalance(std::span<const Real>);
template Unbalance Simulation<3>::largest_unbalance(std::span<const Real>);
template void Simulation<2>::relaxation_columns(Archive&);
template void Simulation<3>::relaxation_columns(Archive&);

}  // namespace sazare::levels
