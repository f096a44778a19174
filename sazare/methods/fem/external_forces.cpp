/// Forces from outside of the body: of gravity, loads, water and boundaries.

#include "sazare/methods/fem/free_field.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::methods::fem {

/// Adds the pressure of still water at a time, on faces and in pores, times a factor.
template <int D>
void FemStepper<D>::add_water(Real now, Real factor, NodalColumn& force) const {
  add(force, factor, pore_);
  for (const auto& water : supports_.waters)
    if (const Real share = water.pressure.share(now); share > 0) add(force, factor * share, water.pressure.force);
}

/// Forces on the nodes at a time; while relaxing, at a share of gravity and of the water that is there at the beginning.
template <int D>
NodalColumn FemStepper<D>::external(Real now) const {
  NodalColumn force = weight_;
  if (stage_ == Stage::relaxing) {
    for (Real& value : force) value *= now;
    add_water(0, now, force);
    add(force, now, state_.applied);
    return force;
  }
  add_water(now, 1, force);
  for (const auto& load : supports_.loads) add(force, load.share(now), load.force);
  add(force, 1, state_.applied);
  add(force, 1, reaction_);
  if (!inertia()) return force;
  add(force, 1, incoming(now));
  if (!free_field_->is_empty()) add(force, 1, at_sides(now, &SideMotion::force));
  if (const Vector<D> base = base_motion(now, &laws::MotionState::velocity); !base.isZero())
    rayleigh_.multiply(body_->at_all_nodes(base), 1, force);
  return force;
}

/// A static run brings its loads to bear in its first step: before it, nothing is carried but what has been relaxed.
template <int D>
NodalColumn FemStepper<D>::carried_at_start() const {
  if (is_unloaded()) return NodalColumn(body_->freedoms(), 0);
  NodalColumn force = weight_;
  add_water(0, 1, force);
  add(force, 1, state_.applied);
  add(force, 1, reaction_);
  return force;
}

/// What brings in the waves of viscous boundaries.
template <int D>
NodalColumn FemStepper<D>::incoming(Real now) const {
  NodalColumn force(body_->freedoms(), 0);
  for (const auto& boundary : supports_.viscous) {
    Vector<D> velocity = Vector<D>::Zero();
    for (int axis = 0; axis < D; ++axis)
      if (const Index motion = boundary.motion[static_cast<std::size_t>(axis)]; motion != Support::no_motion)
        velocity[axis] = supports_.motions[at(motion)].at(now).velocity;
    if (velocity.isZero()) continue;
    for (const auto& face : boundary.faces) {
      const Eigen::VectorXd all = velocity.replicate(static_cast<Eigen::Index>(face.nodes.size()), 1);
      add_at<D>(face.nodes, 2 * (face.impedance * all), force);
    }
  }
  if (const auto* inclined = free_field_->inclined()) inclined->add_incoming(force, now);
  return force;
}

template <int D>
NodalColumn FemStepper<D>::reactions() const {
  NodalColumn force = state_.balance;
  if (inertia()) mass_.multiply(state_.acceleration, 1, force);
  for (std::size_t i = 0; i < force.size(); ++i)
    if (unknowns_.is_free[i]) force[i] = 0;
  return force;
}

template <int D>
Vector<D> FemStepper<D>::viscous_force(std::size_t boundary) const {
  Vector<D> sum = Vector<D>::Zero();
  const auto& one = supports_.viscous[boundary];
  for (int axis = 0; axis < D; ++axis) {
    const Index motion = one.motion[static_cast<std::size_t>(axis)];
    const Real entering = motion == Support::no_motion ? 0 : supports_.motions[at(motion)].at(time()).velocity;
    for (const auto& face : one.faces)
      for (std::size_t i = 0; i < face.nodes.size(); ++i) {
        const Real relative = 2 * entering - state_.velocity[number<D>(face.nodes[i], axis)];
        const auto column = static_cast<Eigen::Index>(i) * D + axis;
        for (Eigen::Index row = 0; row < face.impedance.rows(); ++row)
          sum[static_cast<int>(row % D)] += face.impedance(row, column) * relative;
      }
    for (const Index node : one.nodes) sum[axis] += reaction_[number<D>(node, axis)];
  }
  if (const auto* inclined = free_field_->inclined()) sum += inclined->force_of_boundary(boundary, time());
  return sum;
}

template <int D>
Vector<D> FemStepper<D>::side_force(std::size_t which) const {
  const auto& side = supports_.sides[which];
  Vector<D> sum = free_field_->force(which, state_.velocity, time());
  for (const Index node : side.nodes) sum[side.across] += reaction_[number<D>(node, side.across)];
  return sum;
}

/// Columns go ahead to the end of the step.
template <int D>
void FemStepper<D>::move_sides() {
  if (free_field_->is_empty()) return;
  free_field_->advance();
  state_.sides_before = std::move(state_.sides);
  state_.sides = free_field_->motion(static_cast<Real>(state_.steps + 1) * rules_.step);
  state_.columns = free_field_->states();
}

/// Within a step what columns tell changes evenly.
template <int D>
NodalColumn FemStepper<D>::at_sides(Real now, NodalColumn SideMotion::*quantity) const {
  const Real begin = time(), end = static_cast<Real>(state_.steps + 1) * rules_.step;
  const Real share = (now - begin) / (end - begin);
  NodalColumn value = state_.sides.*quantity;
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = share * value[i] + (1 - share) * (state_.sides_before.*quantity)[i];
  return value;
}

template <int D>
Vector<D> FemStepper<D>::water_force(std::size_t which) const {
  const auto& water = supports_.waters[which];
  Vector<D> sum = water.pressure.share(time()) * water.force;
  if (!inertia()) return sum;
  for (const auto& face : water.moving)
    for (Eigen::Index column = 0; column < face.mass.cols(); ++column) {
      const Real acceleration =
          state_.acceleration[number<D>(face.nodes[static_cast<std::size_t>(column / D)], static_cast<int>(column % D))];
      for (Eigen::Index row = 0; row < face.mass.rows(); ++row)
        sum[static_cast<int>(row % D)] -= face.mass(row, column) * acceleration;
    }
  return sum;
}

// The class is instantiated in stepper.cpp, without these.
#define SAZARE_INSTANTIATE(D) \
  template void FemStepper<D>::add_water(Real, Real, NodalColumn&) const; \
  template NodalColumn FemStepper<D>::external(Real) const; \
  template NodalColumn FemStepper<D>::carried_at_start() const; \
  template NodalColumn FemStepper<D>::incoming(Real) const; \
  template NodalColumn FemStepper<D>::reactions() const; \
  template Vector<D> FemStepper<D>::viscous_force(std::size_t) const; \
  template Vector<D> FemStepper<D>::side_force(std::size_t) const; \
  template void FemStepper<D>::move_sides(); \
  template NodalColumn FemStepper<D>::at_sides(Real, NodalColumn SideMotion::*) const; \
  template Vector<D> FemStepper<D>::water_force(std::size_t) const;

SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::methods::fem
