#pragma once

/// Asks a term for the forces it has in a given place: one evaluation of some links, gathered body by body.

#include <vector>

#include "sazare/levels/terms/term.hpp"

namespace sazare::test {

template <int D>
class ForceProbe {
public:
  ForceProbe(terms::Term<D>& term, state::Bodies<D>& bodies) : term_(term), bodies_(bodies) {}

  /// Force on every body from the links given, and its moment about the body's centre; each call stands at a new tick.
  std::vector<state::Impulse<D>> forces(const std::vector<Index>& links) {
    const Instant now{++tick_, 1.0};
    std::vector<Due> due;
    for (const Index link : links) due.push_back({link, 1.0, 0.5});  // acts for a second: the impulse is the force
    std::vector<Index> all;
    for (Index body = 0; body < bodies_.size(); ++body) {
      auto& motion = bodies_.motion[static_cast<std::size_t>(body)];
      motion.due = now.tick;
      motion.predicted_velocity = motion.velocity;
      motion.predicted_spin = motion.spin;
      motion.last_kick = now.tick - 1;
      all.push_back(body);
    }
    term_.evaluate(now, due, bodies_);
    std::vector<state::Impulse<D>> sum(all.size());
    parts_.clear();
    term_.gather(now, all, bodies_, sum, parts_);
    for (std::size_t body = 0; body < sum.size(); ++body)
      sum[body] = sum[body].about(bodies_.motion[body].position - bodies_.pole);
    return sum;
  }
  std::vector<state::Impulse<D>> forces() { return forces(term_.first_links()); }

  /// Force on the strain of a body at the last call [N m].
  Vector6 force_on_strain(Index body) const {
    terms::StrainGathered sum;
    term_.gather_strain({tick_, 1.0}, body, sum);
    return sum.impulse.given;
  }

  /// Work [J] on a body, by cause, of the impulses of the last call when its centre moved so over the kick.
  terms::CauseWork work(std::size_t body, const state::MeanMotion<D>& mean) const {
    terms::CauseWork work{};
    parts_.add_work(body, mean.at(bodies_.pole - bodies_.motion[body].position), work);
    return work;
  }

  /// The term's balance with all bodies where they are now.
  terms::EnergyBalance energy_balance() const {
    std::vector<state::Pose<D>> poses;
    for (const auto& motion : bodies_.motion) poses.push_back({motion.position, motion.rotation});
    const std::vector<state::MeanMotion<D>> still(poses.size(), state::MeanMotion<D>{Vector<D>::Zero(), Angular<D>::Zero()});
    terms::EnergySums energies;
    std::vector<state::StrainNow> strains;
    for (const state::Strain& strain : bodies_.strain) strains.push_back({strain.strain, Vector6::Zero(), Vector6::Zero()});
    term_.add_energies({poses, still, 0, nullptr, strains}, energies);
    return energies.balance();
  }

  terms::Changes post_step() {
    terms::Changes changes;
    terms::Peers alone;
    term_.post_step(Instant{tick_, 1.0}, bodies_, alone, changes);
    return changes;
  }

  Tick tick() const { return tick_; }

private:
  terms::Term<D>& term_;
  state::Bodies<D>& bodies_;
  terms::CauseImpulses<D> parts_;
  Tick tick_ = 0;
};

/// Force on one freedom of a body (its translations, then its rotations) as minus the slope of the elastic energy, by a
/// central difference. Rotations are about world axes by small angles.
template <int D>
Real energy_slope(const ForceProbe<D>& probe, state::Bodies<D>& bodies, Index body, int freedom, Real step) {
  auto& motion = bodies.motion[static_cast<std::size_t>(body)];
  const auto original = motion;
  const auto energy = [&](Real by) {
    motion = original;
    if (freedom < D) {
      motion.position[freedom] += by;
    } else {
      Angular<D> axis = Angular<D>::Zero();
      axis[freedom - D] = 1;
      motion.rotation = state::turn(axis, by) * original.rotation;
    }
    const Real joules = probe.energy_balance()[terms::EnergyKind::elastic];
    motion = original;
    return joules;
  };
  return -(energy(step) - energy(-step)) / (2 * step);
}

/// Force on the strain of a body as minus the slope of the elastic energy.
inline Vector6 strain_slope(const ForceProbe<3>& probe, state::Bodies<3>& bodies, Index body, Real step) {
  Vector6& strain = bodies.strain[static_cast<std::size_t>(body)].strain;
  const Vector6 original = strain;
  const auto energy = [&](int number, Real by) {
    strain = original;
    strain[number] += by;
    const Real joules = probe.energy_balance()[terms::EnergyKind::elastic];
    strain = original;
    return joules;
  };
  Vector6 slope;
  for (int number = 0; number < 6; ++number) slope[number] = -(energy(number, step) - energy(number, -step)) / (2 * step);
  return slope;
}

template <int D>
Real component(const state::Impulse<D>& force, int freedom) {
  return freedom < D ? force.linear[freedom] : force.angular[freedom - D];
}

}  // namespace sazare::test
