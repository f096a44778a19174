/// How supports move in a step, and what forces and accelerations that come at once do to the nodes beside them.

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::methods::fem {
namespace {

bool is_sampled(const laws::GroundMotion& history, laws::MotionQuantity quantity) {
  using Shape = laws::GroundMotion::Shape;
  return (history.shape == Shape::record || history.shape == Shape::function) && history.quantity == quantity;
}

/// Samples of velocities are joined by straight lines, so the acceleration is constant between them and jumps where they bend.
bool jumps(const laws::GroundMotion& history) { return is_sampled(history, laws::MotionQuantity::velocity); }

/// The acceleration of a support at the end of a step, which gives the nodes beside it their impulse. Where displacements are
/// joined by straight lines the velocity jumps: half of the jump belongs to the step before the bend, the other half to the step
/// after.
Real acceleration_of(const laws::GroundMotion& history, Real from, Real to) {
  const auto end = history.at(to);
  if (!jumps(history) && !is_sampled(history, laws::MotionQuantity::displacement)) return end.acceleration;
  return (end.velocity - history.at(from).velocity) / (to - from);
}

}  // namespace

template <int D>
void FemStepper<D>::apply(NodalColumn force) {
  force = widened(std::move(force));
  NodalColumn change = force;
  add(change, -1, state_.applied);
  state_.applied = std::move(force);
  if (!inertia() || is_zero(change)) return;
  add(state_.balance, -1, change);
  push(change);
}

/// Accelerations after forces on the free nodes have changed by so much at once.
template <int D>
void FemStepper<D>::push(const NodalColumn& change) {
  if (!mass_solver_) {
    mass_solver_ = std::make_unique<methods::fem::LinearSolver<D>>(body_->pattern(), unknowns_, true);
    if (!mass_solver_->factorize(mass_.values())) throw PhysicsError("the mass matrix is singular");
  }
  add(state_.acceleration, 1, mass_solver_->solve(change));
}

/// Where the acceleration of a support jumps between two steps, so does that of the nodes beside it, by their common mass. The
/// acceleration is that of the step to come, constant over it.
template <int D>
void FemStepper<D>::jump(const Span& span) {
  NodalColumn change(body_->freedoms(), 0);
  for (const Support& support : supports_.held) {
    if (support.motion == Support::no_motion || !jumps(supports_.motions[at(support.motion)])) continue;
    const std::size_t i = number<D>(support.node, support.axis);
    change[i] = acceleration_of(supports_.motions[at(support.motion)], span.from, span.to) - state_.acceleration[i];
  }
  if (is_zero(change)) return;
  add(state_.acceleration, 1, change);
  NodalColumn force = product(mass_, change);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = solver_->is_unknown(i) ? -force[i] : 0;
  push(force);
}

/// The motion of the base; 0 along axes along which there is none.
template <int D>
Vector<D> FemStepper<D>::base_motion(Real now, Real laws::MotionState::*quantity) const {
  Vector<D> value = Vector<D>::Zero();
  for (int axis = 0; axis < D; ++axis)
    if (const Index motion = supports_.base.along(axis); motion != laws::BaseMotion::none)
      value[axis] = supports_.motions[at(motion)].at(now).*quantity;
  return value;
}

/// The beginning of an iteration: free nodes stay where they are, supports move as they must; `prescribed` is how far.
template <int D>
typename FemStepper<D>::Trial FemStepper<D>::predict(const Span& span, NodalColumn& prescribed) {
  const Real dt = span.length;
  Trial trial{state_.displacement, state_.velocity, state_.acceleration, state_.internal, external(span.to), state_.memory};
  if (inertia()) {
    const Real beta = 0.25 * (1 - rules_.alpha) * (1 - rules_.alpha), gamma = 0.5 - rules_.alpha;
    for (std::size_t i = 0; i < trial.velocity.size(); ++i) {
      const Real v = state_.velocity[i], a = state_.acceleration[i];
      trial.acceleration[i] = -v / (beta * dt) - (0.5 / beta - 1) * a;
      trial.velocity[i] = v + dt * ((1 - gamma) * a + gamma * trial.acceleration[i]);
    }
  }
  if (in_time() && !inertia()) {
    std::ranges::fill(trial.velocity, 0);
    for (std::size_t i = 0; i < trial.velocity.size(); ++i) trial.acceleration[i] = -state_.velocity[i] / dt;
  }
  prescribed.assign(body_->freedoms(), 0);
  for (const Support& support : supports_.held) {
    const std::size_t i = number<D>(support.node, support.axis);
    trial.velocity[i] = trial.acceleration[i] = 0;
    if (support.motion == Support::no_motion || stage_ == Stage::relaxing) continue;
    const laws::GroundMotion& history = supports_.motions[at(support.motion)];
    const auto motion = history.at(span.to);
    prescribed[i] = initial_displacement_[i] + motion.displacement - state_.displacement[i];
    if (!inertia()) {
      trial.velocity[i] = prescribed[i] / dt;
      continue;
    }
    trial.velocity[i] = motion.velocity;
    trial.acceleration[i] = acceleration_of(history, span.from, span.to);
  }
  return trial;
}

#define SAZARE_INSTANTIATE(D)                                                           \
  template void FemStepper<D>::apply(NodalColumn);                                      \
  template void FemStepper<D>::push(const NodalColumn&);                                \
  template void FemStepper<D>::jump(const Span&);                                       \
  template Vector<D> FemStepper<D>::base_motion(Real, Real laws::MotionState::*) const; \
  template typename FemStepper<D>::Trial FemStepper<D>::predict(const Span&, NodalColumn&);
SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::methods::fem
