#include "sazare/particles/uniform_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/core/lane_math.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::particles {

namespace {

constexpr std::size_t serial_below = 128;  // packs
constexpr std::size_t tile_size = 256;     // particles whose columns stay in the first cache from kick to drift
constexpr std::size_t serial_tiles = 4;

/// Calls f(begin, end) in parallel for ranges of whole packs.
template <class F>
void for_packs(std::size_t padded, F&& f) {
  parallel::parallel_for(padded / lane_count, serial_below,
                         [&](std::size_t begin, std::size_t end) { f(begin * lane_count, end * lane_count); });
}

/// A number that stands for a whole column.
struct Even {
  Real value = 0;
  Real operator[](std::size_t) const { return value; }
};

/// exp of the rotation vector, times the matrix.
void turn_matrix(std::array<state::Column, 9>& rotation, std::size_t i, const Vector3& turned) {
  Matrix3 matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) matrix(row, column) = rotation[static_cast<std::size_t>(3 * row + column)][i];
  const Real angle = turned.norm();
  if (!(angle > 0)) return;
  matrix = Eigen::AngleAxis<Real>(angle, turned / angle).toRotationMatrix() * matrix;
  matrix = 0.5 * matrix * (3 * Matrix3::Identity() - matrix.transpose() * matrix);  // keeps it orthonormal to round-off
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation[static_cast<std::size_t>(3 * row + column)][i] = matrix(row, column);
}

}  // namespace

template <int D>
UniformStepper<D>::UniformStepper(state::Particles<D> particles, std::unique_ptr<particles::ParticleForces<D>> forces,
                                  particles::ParticleSupports<D> supports, const UniformRules& rules)
    : particles_(std::move(particles)), forces_(std::move(forces)), supports_(std::move(supports)), rules_(rules) {
  for (auto* group : {&elastic_, &previous_, &load_, &keep_, &gain_})
    for (state::Column& column : *group) column.assign(particles_.padded(), 0);
  initial_displacement_ = particles_.displacement;
  for (state::Column& column : damping_work_) column.assign(is_damped() && has_energy_balance() ? particles_.padded() : 0, 0);
  base_work_.assign(damping_work_[0].size(), 0);
  prepare_factors();
}

template <int D>
void UniformStepper<D>::hold(Index particle, int freedom) {
  keep_[static_cast<std::size_t>(freedom)][at(particle)] = 0;
  gain_[static_cast<std::size_t>(freedom)][at(particle)] = 0;
  particles_.velocity[static_cast<std::size_t>(freedom)][at(particle)] = 0;
}

template <int D>
void UniformStepper<D>::prepare_factors() {
  const Real dt = rules_.step;
  const bool euler = is_euler(rules_.integrator);
  memory_.resize(particles_.padded());
  drag_.resize(particles_.padded());
  for (std::size_t i = 0; i < memory_.size(); ++i) {
    memory_[i] = rules_.damping.stiffness_time * particles_.damping_ratio[i] / dt;
    drag_[i] = rules_.damping.mass_rate * particles_.damping_ratio[i];
  }
  const auto set = [&](std::size_t freedom, std::size_t i, Real rate) {
    keep_[freedom][i] = euler ? 1 - dt * rate : (1 - 0.5 * dt * rate) / (1 + 0.5 * dt * rate);
    gain_[freedom][i] = euler ? dt : dt / (1 + 0.5 * dt * rate);
  };
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
    for (std::size_t i = 0; i < particles_.padded(); ++i) set(freedom, i, drag_[i]);
  for (const particles::Dashpot& dashpot : supports_.dashpots)
    set(static_cast<std::size_t>(dashpot.freedom), at(dashpot.particle), drag_[at(dashpot.particle)] + dashpot.rate);
  for (const auto& held : supports_.held) hold(held.particle, held.freedom);
  for (const auto& driven : supports_.driven) hold(driven.particle, driven.freedom);
  set_loads();
}

template <int D>
void UniformStepper<D>::apply(std::span<const Vector3> forces) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    applied_[axis].assign(particles_.padded(), 0);
    for (std::size_t i = 0; i < forces.size(); ++i)
      applied_[axis][i] = forces[i][static_cast<int>(axis)] * particles_.inverse_mass[i];
  }
  set_loads();
  add_loads();
}

/// Loads at rest.
template <int D>
void UniformStepper<D>::set_loads() {
  for (std::size_t axis = 0; axis < D; ++axis)
    for (std::size_t i = 0; i < particles_.size(); ++i)
      load_[axis][i] = supports_.gravity[static_cast<int>(axis)] + applied_to(axis, i);
  for (const particles::Dashpot& dashpot : supports_.dashpots)
    load_[static_cast<std::size_t>(dashpot.freedom)][at(dashpot.particle)] = at_rest(dashpot);
  find_even_tiles();
}

/// Where all particles of a tile have the same factors and load, a kick need not read them one by one: a third of what it reads.
template <int D>
void UniformStepper<D>::find_even_tiles() {
  is_even_.assign((particles_.padded() + tile_size - 1) / tile_size, {});
  for (std::size_t tile = 0; tile < is_even_.size(); ++tile) {
    const std::size_t begin = tile * tile_size, end = std::min(begin + tile_size, particles_.padded());
    const auto is_even = [&](const state::Column& column) {
      return std::all_of(&column[begin], column.data() + end, [&](Real value) { return value == column[begin]; });
    };
    for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
      is_even_[tile][freedom] = is_even(load_[freedom]) && is_even(keep_[freedom]) && is_even(gain_[freedom]) &&
                                is_even(memory_) && is_even(drag_);
  }
  for (const particles::Dashpot& dashpot : supports_.dashpots)  // their loads change
    is_even_[at(dashpot.particle) / tile_size][static_cast<std::size_t>(dashpot.freedom)] = 0;
}

template <int D>
void UniformStepper<D>::start() {
  forces_->begin();
  drive();
  forces_->evaluate(particles_, elastic_);
  previous_ = elastic_;
  add_loads();
  if (!has_energy_balance()) return;
  begin_halfway();
  // Only the second half of the first kick counts.
  for (state::Column& column : damping_work_) std::ranges::fill(column, 0);
  std::ranges::fill(base_work_, 0);
  support_work_ = {};
  const WorkByCause half = first_half_of_kick();
  support_work_ = {0, -half.boundary, -half.prescribed, -half.damping, -half.applied};
}

/// From the velocity at the beginning to that half a step before: the kick that the first step gives, backwards by a half.
template <int D>
void UniformStepper<D>::begin_halfway() {
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (gain_[freedom][i] > 0)
        particles_.velocity[freedom][i] -= 0.5 * rules_.step * (elastic_[freedom][i] + load_[freedom][i]);
  for (const particles::Dashpot& dashpot : supports_.dashpots)  // does nothing while both set out together
    if (dashpot.is_beside_column)
      particles_.velocity[static_cast<std::size_t>(dashpot.freedom)][at(dashpot.particle)] +=
          0.5 * rules_.step * dashpot.rate * dashpot.beyond;
}

/// Loads at the present time. Those at rest stand in the columns already.
template <int D>
void UniformStepper<D>::add_loads() {
  std::vector<laws::MotionState> now;
  for (const laws::GroundMotion& motion : supports_.motions) now.push_back(motion.at(time()));
  forces_->move_beyond(supports_.dashpots);
  for (const particles::Dashpot& dashpot : supports_.dashpots) {
    Real& load = load_[static_cast<std::size_t>(dashpot.freedom)][at(dashpot.particle)];
    if (dashpot.is_beside_column)
      load = at_rest(dashpot) + dashpot.rate * dashpot.beyond;
    else if (dashpot.motion != particles::Dashpot::no_motion)
      load = at_rest(dashpot) + 2 * dashpot.rate * dashpot.factor * now[at(dashpot.motion)].velocity;
  }
  look_at_base();
}

template <int D>
void UniformStepper<D>::look_at_base() {
  for (int axis = 0; axis < D; ++axis)
    if (const Index motion = supports_.base.along(axis); motion != laws::BaseMotion::none)
      base_velocity_[static_cast<std::size_t>(axis)] = supports_.motions[at(motion)].at(time()).velocity;
}

template <int D>
Real UniformStepper<D>::at_rest(const particles::Dashpot& dashpot) const {
  return (dashpot.freedom < D ? supports_.gravity[dashpot.freedom] : 0) + dashpot.reaction +
         applied_to(static_cast<std::size_t>(dashpot.freedom), at(dashpot.particle));
}

/// Puts what is driven where its history has it at the present time.
template <int D>
void UniformStepper<D>::drive() {
  std::vector<laws::MotionState> now;
  for (const laws::GroundMotion& motion : supports_.motions) now.push_back(motion.at(time()));
  for (const particles::DrivenFreedom& driven : supports_.driven) {
    const auto axis = static_cast<std::size_t>(driven.freedom);
    Real& place = particles_.displacement[axis][at(driven.particle)];
    const Real next = driven.factor * now[at(driven.motion)].displacement;
    // Forces that ask for velocities see that of the last step, as of all others; a kick forgets it.
    Real& velocity = particles_.velocity[axis][at(driven.particle)];
    if (!is_euler(rules_.integrator)) velocity = step_ > 0 ? (next - place) / rules_.step : 0;
    place = next;
  }
}

template <int D>
void UniformStepper<D>::turn(std::size_t begin, std::size_t end) {
  if constexpr (D == 2) {
    for (std::size_t i = begin; i < end; i += lane_count) {
      const SineCosine turned = sine_cosine(load_lanes(&particles_.angle[i]));
      store_lanes(&particles_.rotation[0][i], turned.cosine);
      store_lanes(&particles_.rotation[1][i], turned.sine);
    }
  }
}

/// Moves by the velocity over dt; `factor` is the step.
template <int D>
void UniformStepper<D>::drift(std::size_t begin, std::size_t end, Real factor) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    Real* const displacement = particles_.displacement[axis].data();
    const Real* const velocity = particles_.velocity[axis].data();
    for (std::size_t i = begin; i < end; ++i) displacement[i] += factor * velocity[i];
  }
  if constexpr (D == 2) {
    for (std::size_t i = begin; i < end; ++i) particles_.angle[i] += factor * particles_.velocity[2][i];
  } else {
    for (std::size_t i = begin; i < end; ++i)
      turn_matrix(particles_.rotation, i,
                  factor * Vector3(particles_.velocity[3][i], particles_.velocity[4][i], particles_.velocity[5][i]));
  }
  turn(begin, end);
}

/// Leapfrog's kick, and Verlet's, whose difference x(k) - x(k-1) is kept as a velocity.
template <int D>
template <bool damped>
void UniformStepper<D>::kick(std::size_t tile, std::size_t begin, std::size_t end) {
  const Real dt = rules_.step;
  const bool verlet = rules_.integrator == Integrator::verlet;
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom) {
    Real* const velocity = particles_.velocity[freedom].data();
    const Real* const elastic = elastic_[freedom].data();
    const Real* const previous = previous_[freedom].data();
    Real* const work = damping_work_[freedom < D ? 0 : 1].data();
    Real* const work_of_base = base_work_.data();
    const Real base = base_velocity_[freedom];
    const auto kick_by = [&](const auto load, const auto keep, const auto gain, const auto memory, const auto drag) {
      for (std::size_t i = begin; i < end; ++i) {
        Real acceleration = elastic[i] + load[i];
        if constexpr (damped) acceleration = elastic[i] + memory[i] * (elastic[i] - previous[i]) + load[i] + drag[i] * base;
        const Real before = velocity[i];
        const Real after =
            verlet ? (keep[i] * (dt * before) + dt * gain[i] * acceleration) / dt : keep[i] * before + gain[i] * acceleration;
        velocity[i] = after;
        if constexpr (damped) {
          const Real change = gain[i] > 0 ? after - before - dt * (elastic[i] + load[i]) : 0;
          work[i] += (0.5 * (before + after) - base) * change;
          if (base != 0) work_of_base[i] += base * change;
        }
      }
    };
    if (is_even_[tile][freedom] != 0)
      kick_by(Even{load_[freedom][begin]}, Even{keep_[freedom][begin]}, Even{gain_[freedom][begin]}, Even{memory_[begin]},
              Even{drag_[begin]});
    else
      kick_by(load_[freedom].data(), keep_[freedom].data(), gain_[freedom].data(), memory_.data(), drag_.data());
  }
}

template <int D>
void UniformStepper<D>::kick_and_drift() {
  remember_supports();
  const bool damped = !damping_work_[0].empty();
  parallel::parallel_for(is_even_.size(), serial_tiles, [&](std::size_t first, std::size_t last) {
    for (std::size_t tile = first; tile < last; ++tile) {
      const std::size_t begin = tile * tile_size, end = std::min(begin + tile_size, particles_.padded());
      damped ? kick<true>(tile, begin, end) : kick<false>(tile, begin, end);
      drift(begin, end, rules_.step);
    }
  });
  ++step_;
  drive();
  add_work_of_supports();
  evaluate_next();
}

/// Damping sees the change of what is damped alone: to what is not, `previous_` is brought up as well.
template <int D>
void UniformStepper<D>::evaluate_next() {
  std::swap(elastic_, previous_);
  forces_->add_undamped(-1, previous_);
  forces_->evaluate(particles_, elastic_);
  forces_->add_undamped(1, previous_);
}

/// Euler's step.
template <int D>
void UniformStepper<D>::drift_and_kick() {
  const bool lagged = rules_.integrator == Integrator::euler_lagged;
  for_packs(particles_.padded(), [&](std::size_t begin, std::size_t end) { drift(begin, end, rules_.step); });
  if (lagged) kick_by_euler();
  ++step_;
  drive();
  evaluate_next();
  if (!lagged) kick_by_euler();
}

/// By g(k) and the last known change of g: that to g(k+1), or lagged, before that is known, that from g(k-1).
template <int D>
void UniformStepper<D>::kick_by_euler() {
  const bool lagged = rules_.integrator == Integrator::euler_lagged;
  for_packs(particles_.padded(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
      for (std::size_t i = begin; i < end; ++i) {
        const Real present = lagged ? elastic_[freedom][i] : previous_[freedom][i];
        const Real change = elastic_[freedom][i] - previous_[freedom][i];
        const Real acceleration = present + memory_[i] * change + load_[freedom][i] + carried(freedom, i);
        particles_.velocity[freedom][i] = keep_[freedom][i] * particles_.velocity[freedom][i] + gain_[freedom][i] * acceleration;
      }
  });
}

template <int D>
void UniformStepper<D>::advance() {
  forces_->go_ahead();
  if (is_euler(rules_.integrator))
    drift_and_kick();
  else
    kick_and_drift();
  add_loads();
}

template <int D>
state::FreedomColumns<D> UniformStepper<D>::acceleration() const {
  state::FreedomColumns<D> result = elastic_;
  const Real dt = rules_.step;
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
    for (std::size_t i = 0; i < particles_.padded(); ++i) {
      // The change of velocity that the coming kick gives, over the step.
      const Real kick = gain_[freedom][i] * (total_acceleration(freedom, i) + load_[freedom][i] + carried(freedom, i));
      const Real kept =
          keep_[freedom][i] > 0 || gain_[freedom][i] > 0 ? (keep_[freedom][i] - 1) * particles_.velocity[freedom][i] : 0;
      result[freedom][i] = (kick + kept) / dt;
    }
  for (const particles::DrivenFreedom& driven : supports_.driven)
    result[static_cast<std::size_t>(driven.freedom)][at(driven.particle)] =
        driven.factor * supports_.motions[at(driven.motion)].at(time()).acceleration;
  return result;
}

template <int D>
state::FreedomColumns<D> UniformStepper<D>::velocity() const {
  state::FreedomColumns<D> result = particles_.velocity;
  if (!is_euler(rules_.integrator)) {
    const state::FreedomColumns<D> change = acceleration();
    for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
      for (std::size_t i = 0; i < particles_.padded(); ++i) result[freedom][i] += 0.5 * rules_.step * change[freedom][i];
  }
  for (const particles::DrivenFreedom& driven : supports_.driven)
    result[static_cast<std::size_t>(driven.freedom)][at(driven.particle)] =
        driven.factor * supports_.motions[at(driven.motion)].at(time()).velocity;
  return result;
}

template <int D>
Real UniformStepper<D>::kinetic_energy() const {
  const state::FreedomColumns<D> now = velocity();
  Real total = 0;
  for (std::size_t freedom = 0; freedom < now.size(); ++freedom)
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (const Real inverse = particles_.inverse_inertia_of(freedom)[i];
          inverse > 0)  // what has no mass of its own is moved by others
        total += 0.5 * now[freedom][i] * now[freedom][i] / inverse;
  return total;
}

template <int D>
Real UniformStepper<D>::largest_acceleration() const {
  Real largest = 0;
  for (std::size_t axis = 0; axis < D; ++axis)
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const Real size = gain_[axis][i] > 0 ? std::abs(total_acceleration(axis, i)) : 0;
      if (!(size <= std::numeric_limits<Real>::max())) return std::numeric_limits<Real>::infinity();
      largest = size > largest ? size : largest;
    }
  return largest;
}

template <int D>
void UniformStepper<D>::columns(Archive& archive) {
  archive("steps", step_);
  archive.folder("particles", [&] { particles_.columns(archive); });
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom) {
    archive("elastic" + std::to_string(freedom), elastic_[freedom]);
    archive("previous" + std::to_string(freedom), previous_[freedom]);
    archive("load" + std::to_string(freedom), load_[freedom]);
  }
  for (std::size_t axis = 0; axis < D; ++axis)
    archive("initial_displacement" + std::to_string(axis), initial_displacement_[axis]);
  std::vector<Real> reactions;
  for (const particles::Dashpot& dashpot : supports_.dashpots) reactions.push_back(dashpot.reaction);
  archive("reactions", reactions);
  for (std::size_t part = 0; part < damping_work_.size(); ++part)
    archive("damping_work" + std::to_string(part), damping_work_[part]);
  archive("base_work", base_work_);
  archive("boundary_work", support_work_.boundary);
  archive("prescribed_work", support_work_.prescribed);
  archive("other_damping_work", support_work_.damping);
  archive("applied_work", support_work_.applied);
  for (std::size_t i = 0; i < supports_.dashpots.size() && i < reactions.size(); ++i)
    supports_.dashpots[i].reaction = reactions[i];
  archive.folder("forces", [&] { forces_->columns(archive); });
  find_even_tiles();
  if (archive.reading()) look_at_base();
}

template class UniformStepper<2>;
template class UniformStepper<3>;

}  // namespace sazare::particles
