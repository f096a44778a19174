#pragma once

/// Small networks of bodies and springs for tests of the step.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "sazare/levels/motion/kick.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/levels/terms/springs.hpp"

namespace sazare::test {

template <int D>
struct Network {
  state::Bodies<D> bodies;
  std::vector<terms::Spring<D>> springs;

  levels::Simulation<D> simulation(const levels::StepRules& rules) const {
    levels::TermList<D> list;
    list.push_back(std::make_unique<terms::Springs<D>>(springs, bodies));
    return levels::Simulation<D>(bodies, std::move(list), rules);
  }
};

inline Index add_body_at(state::Bodies<2>& bodies, Real mass, Real x, Real y) {
  return state::add_body(bodies, mass, Vector<2>(x, y), 0.15 * mass, 1.0);
}
inline Index add_body_at(state::Bodies<3>& bodies, Real mass, Real x, Real y) {
  const Quaternion tilted(Eigen::AngleAxis<Real>(0.3 + x, Vector3(1, y, -1).normalized()));
  return state::add_body(bodies, mass, Vector3(x, y, 0.3 * x * y), mass * Vector3(0.1, 0.15, 0.2), tilted, 1.0);
}

template <int D>
Vector<D> vector_of(Real x, Real y, Real z) {
  Vector<D> made;
  made[0] = x;
  made[1] = y;
  if constexpr (D == 3) made[2] = z;
  return made;
}

/// A free body of six masses that turn, joined off their centres by springs some of which are 64 times stiffer than
/// others, in motion and under tension: with the stability limiter it has levels from 0 to 3. Stiff springs end at light
/// bodies. No dashpots.
template <int D>
Network<D> ladder() {
  Network<D> made;
  for (int i = 0; i < 3; ++i) {
    add_body_at(made.bodies, i == 2 ? 0.25 : 1.0, i, 0);
    add_body_at(made.bodies, i == 2 ? 0.25 : 1.0, i, 1);
  }
  for (Index body = 0; body < made.bodies.size(); ++body) {
    auto& motion = made.bodies.motion[static_cast<std::size_t>(body)];
    motion.velocity = vector_of<D>(0.1 * body - 0.2, 0.1 - 0.05 * body, 0.05 * body);
    motion.angular_momentum.setConstant(0.005 * (body - 2));
    motion.spin =
        motion::spin_of(motion.rotation, made.bodies.inertia[static_cast<std::size_t>(body)], {}, motion.angular_momentum);
    motion.predicted_velocity = motion.velocity;
    motion.predicted_spin = motion.spin;
  }
  const auto join = [&](Index first, Index second, Real stiffness) {
    terms::Spring<D> spring;
    spring.first = first;
    spring.second = second;
    spring.first_arm = vector_of<D>(0.1, -0.05, 0.08);
    spring.second_arm = vector_of<D>(-0.12, 0.06, 0.02);
    const auto end = [&](Index body, const Vector<D>& arm) {
      const auto& motion = made.bodies.motion[static_cast<std::size_t>(body)];
      return Vector<D>(motion.position + motion.rotation * arm);
    };
    spring.length = (end(second, spring.second_arm) - end(first, spring.first_arm)).norm() - 0.03;
    spring.stiffness = stiffness;
    made.springs.push_back(spring);
  };
  for (const auto& [first, second] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 3), std::pair(0, 3)}) join(first, second, 4);
  for (const auto& [first, second] : {std::pair(2, 3), std::pair(2, 4), std::pair(3, 5)}) join(first, second, 16);
  join(4, 5, 64);
  join(2, 5, 64);
  return made;
}

/// Mechanical energy gained and stored [J], against the same at the beginning.
inline Real mechanical(const terms::EnergyBalance& balance) {
  return balance[terms::EnergyKind::kinetic] + balance[terms::EnergyKind::elastic];
}

/// Runs to a time that is a whole number of base steps.
template <int D>
void run(levels::Simulation<D>& simulation, int base_steps) {
  for (int step = 0; step < base_steps; ++step) simulation.advance();
}

/// Distance in places, turns, velocities and angular momenta.
template <int D>
Real distance(const levels::Snapshot<D>& a, const levels::Snapshot<D>& b) {
  Real sum = 0;
  for (std::size_t body = 0; body < a.pose.size(); ++body)
    sum += (a.pose[body].position - b.pose[body].position).squaredNorm() +
           (a.pose[body].rotation - b.pose[body].rotation).squaredNorm() + (a.velocity[body] - b.velocity[body]).squaredNorm() +
           (a.angular_momentum[body] - b.angular_momentum[body]).squaredNorm();
  return std::sqrt(sum);
}

/// Lowest and highest level in use.
template <int D>
std::pair<int, int> level_range(const levels::Simulation<D>& simulation) {
  int lowest = schedule::deepest_level, highest = 0;
  for (Index body = 0; body < simulation.bodies().size(); ++body) {
    lowest = std::min(lowest, simulation.levels().level(body));
    highest = std::max(highest, simulation.levels().level(body));
  }
  return {lowest, highest};
}

/// Linear and angular momentum about the origin at a base step, of the impulses that have been given: those that act
/// until the middle of the coming step are in it, on all bodies.
template <int D>
struct Momentum {
  Vector<D> linear = Vector<D>::Zero();
  Angular<D> angular = Angular<D>::Zero();
};

template <int D>
Momentum<D> momentum(const levels::Simulation<D>& simulation) {
  Momentum<D> sum;
  for (std::size_t body = 0; body < simulation.bodies().motion.size(); ++body) {
    const auto& motion = simulation.bodies().motion[body];
    const Vector<D> linear = simulation.bodies().inertia[body].mass * motion.velocity;
    sum.linear += linear;
    sum.angular += motion.angular_momentum + moment(state::pose_at(motion, simulation.now()).position, linear);
  }
  return sum;
}

/// A term without force that watches the bodies at every tick, after they were kicked.
template <int D, class Watch>
class Watcher final : public terms::Term<D> {
public:
  explicit Watcher(Watch watch) : watch_(std::move(watch)) {}

  std::string_view name() const override { return "watcher"; }
  std::span<const Link> links() const override { return {}; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override { return {}; }
  void evaluate(const Instant&, std::span<const Due>, const state::Bodies<D>&) override {}
  void gather(const Instant&, std::span<const Index>, const state::Bodies<D>&, std::span<state::Impulse<D>>,
              terms::CauseImpulses<D>&) const override {}
  void post_step(const Instant& now, const state::Bodies<D>& bodies, terms::Peers&, terms::Changes&) override {
    watch_(now, bodies);
  }
  terms::Rates rates(Index) const override { return {}; }
  void add_energies(const terms::Synchronized<D>&, terms::EnergySums&) const override {}
  void carry(Index, Parcel&) override {}
  void columns(Archive&) override {}

private:
  Watch watch_;
};

template <int D, class Watch>
std::unique_ptr<terms::Term<D>> watcher(Watch watch) {
  return std::make_unique<Watcher<D, Watch>>(std::move(watch));
}

/// A simulation of the network with a term that calls `watch` and gives no force.
template <int D, class Watch>
levels::Simulation<D> watched(const Network<D>& network, const levels::StepRules& rules, Watch watch) {
  levels::TermList<D> list;
  list.push_back(std::make_unique<terms::Springs<D>>(network.springs, network.bodies));
  list.push_back(watcher<D>(std::move(watch)));
  return levels::Simulation<D>(network.bodies, std::move(list), rules);
}

}  // namespace sazare::test
