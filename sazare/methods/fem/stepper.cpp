#include "sazare/methods/fem/stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/free_field.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"

namespace sazare::methods::fem {

template <int D>
FemStepper<D>::FemStepper(std::unique_ptr<methods::fem::Body<D>> body, methods::fem::Supports<D> supports, const FemRules& rules)
    : body_(std::move(body)),
      supports_(std::move(supports)),
      rules_(rules),
      mass_(body_->mass()),
      rayleigh_(body_->damping_matrix(rules.damping)),
      viscous_(body_->pattern()),
      damping_(rayleigh_),
      free_field_(std::make_unique<FreeField<D>>(*body_, supports_.sides, rules)),
      state_(body_->pattern()) {
  const NodalColumn none(body_->freedoms(), 0);
  state_.displacement = state_.velocity = state_.acceleration = state_.internal = state_.balance = none;
  reaction_ = initial_displacement_ = state_.applied = state_.carried = weight_ = none;
  weight_ = product(body_->mass(), body_->at_all_nodes(supports_.gravity));
  pore_ = body_->pore_force();
  for (const auto& water : supports_.waters)
    for (const auto& face : water.moving) mass_.add(face.nodes, face.mass);
  for (const auto& boundary : supports_.viscous)
    for (const auto& face : boundary.faces) viscous_.add(face.nodes, face.impedance);
  widen_loads();
  add_pores();
  add(damping_.values(), 1, viscous_.values());
  add(damping_.values(), 1, free_field_->impedance().values());
  state_.memory = body_->memory_at_rest();
  state_.columns = free_field_->states();
  methods::fem::Memory after = state_.memory;
  body_->evaluate(state_.displacement, state_.memory, after, state_.internal, &state_.tangent);
  prepare_solver(false);
}

template <int D>
FemStepper<D>::FemStepper(FemStepper&&) noexcept = default;

template <int D>
FemStepper<D>::~FemStepper() = default;

template <int D>
void FemStepper<D>::add_pores() {
  if (body_->pores().size() == 0) return;
  pore_matrices_ = std::make_unique<PoreMatrices>(body_->pores(), body_->pattern());
  add(mass_.values(), 1, pore_matrices_->storage.values());
  add(damping_.values(), 1, pore_matrices_->rates.values());
}

template <int D>
void FemStepper<D>::widen_loads() {
  for (Load& load : supports_.loads) load.force = widened(std::move(load.force));
  for (auto& water : supports_.waters) water.pressure.force = widened(std::move(water.pressure.force));
}

/// Forces on the nodes of the mesh, with none on the nodes of pressures and rotations.
template <int D>
NodalColumn FemStepper<D>::widened(NodalColumn column) const {
  column.resize(body_->freedoms(), 0);
  return column;
}

/// A solver for the free degrees of freedom.
template <int D>
void FemStepper<D>::prepare_solver(bool at_rest) {
  find_unknowns(at_rest);
  solver_ = std::make_unique<methods::fem::LinearSolver<D>>(body_->pattern(), unknowns_, body_->is_symmetric());
  mass_solver_.reset();
  factorized_.reset();
}

/// What is free. While relaxing the water in the pores is at rest.
template <int D>
void FemStepper<D>::find_unknowns(bool at_rest) {
  unknowns_.is_free.assign(body_->freedoms(), 1);
  const std::set<Index> drained(supports_.drained.begin(), supports_.drained.end());
  const auto& pores = body_->pores();
  unknowns_.turned_from = body_->mesh().nodes.size();
  unknowns_.turned_to = unknowns_.turned_from + pores.pressure_nodes();
  for (std::size_t pressure = 0; pressure < pores.pressure_nodes(); ++pressure)
    for (int axis = 0; axis < D; ++axis)
      unknowns_.is_free[number<D>(pores.pressure_node(pressure), axis)] =
          axis == 0 && !at_rest && !pores.is_drained(pressure) && !drained.contains(pores.node_of(pressure));
  const auto& members = body_->members();
  for (std::size_t rotation = 0; rotation < members.rotation_nodes(); ++rotation)
    for (int axis = 0; axis < D; ++axis)
      unknowns_.is_free[number<D>(members.rotation_node(rotation), axis)] =
          (D == 3 || axis == 0) && std::ranges::count(supports_.clamped, members.node_of(rotation)) == 0;
  for (const Support& support : supports_.held) unknowns_.is_free[number<D>(support.node, support.axis)] = 0;
  if (at_rest) hold_sides();
  if (!supports_.tied.empty()) find_leaders();
}

/// Viscous boundaries and free-field sides hold the body while it relaxes.
template <int D>
void FemStepper<D>::hold_sides() {
  for (const auto& side : supports_.sides)
    for (const Index node : side.nodes) unknowns_.is_free[number<D>(node, side.across)] = 0;
  for (const auto& boundary : supports_.viscous)
    for (const auto& face : boundary.faces)
      for (const Index node : face.nodes)
        for (int axis = 0; axis < D; ++axis) unknowns_.is_free[number<D>(node, axis)] = 0;
}

/// Tied nodes have their displacement in common, and where both have one their pressure.
template <int D>
void FemStepper<D>::find_leaders() {
  unknowns_.leader.resize(body_->freedoms());
  std::iota(unknowns_.leader.begin(), unknowns_.leader.end(), std::size_t{0});
  const auto tie = [&](Index node, Index leader) {
    for (int axis = 0; axis < D; ++axis) {
      const std::size_t follower = number<D>(node, axis), first = number<D>(leader, axis);
      unknowns_.leader[follower] = first;
      unknowns_.is_free[first] = unknowns_.is_free[first] && unknowns_.is_free[follower];
      unknowns_.is_free[follower] = 0;
    }
  };
  std::map<Index, Index> pressure_of;
  const auto& pores = body_->pores();
  for (std::size_t pressure = 0; pressure < pores.pressure_nodes(); ++pressure)
    pressure_of[pores.node_of(pressure)] = pores.pressure_node(pressure);
  for (const auto& [node, leader] : supports_.tied) {
    tie(node, leader);
    if (pressure_of.contains(node) && pressure_of.contains(leader)) tie(pressure_of[node], pressure_of[leader]);
  }
}

template <int D>
std::optional<methods::fem::Freedom> FemStepper<D>::find_loose_freedom() {
  prepare_solver(true);
  methods::fem::LinearSolver<D> symmetric(body_->pattern(), unknowns_, true);
  symmetric.factorize(state_.tangent.values());
  prepare_solver(false);
  return symmetric.singular();
}

template <int D>
void FemStepper<D>::relax() {
  free_field_->relax();
  state_.columns = free_field_->states();
  stage_ = Stage::relaxing;
  prepare_solver(true);
  walk({0, 1, 1}, rules_.most_cuts);
  stage_ = Stage::running;
  body_->begin_cycles(state_.displacement, state_.memory);
  initial_displacement_ = state_.displacement;
  NodalColumn carried = weight_;
  add_water(0, 1, carried);
  for (const auto& boundary : supports_.viscous)
    for (const Index node : boundary.nodes)
      for (int axis = 0; axis < D; ++axis) {
        const std::size_t i = number<D>(node, axis);
        reaction_[i] = state_.internal[i] - carried[i];
      }
  for (const auto& side : supports_.sides)
    for (const Index node : side.nodes) {
      const std::size_t i = number<D>(node, side.across);
      reaction_[i] = state_.internal[i] - carried[i];
    }
  prepare_solver(false);
}

template <int D>
void FemStepper<D>::start() {
  elastic_at_start_ = body_->energies(state_.displacement, state_.displacement, state_.memory, state_.memory).elastic;
  state_.work = {};
  free_field_->start();
  if (!free_field_->is_empty()) state_.sides = free_field_->motion();
  state_.sides_before = state_.sides;
  state_.columns = free_field_->states();
  Trial now{state_.displacement, state_.velocity, state_.acceleration, state_.internal, external(0), state_.memory};
  if (!inertia()) now.external = carried_at_start();
  for (const Support& support : supports_.held) {
    if (support.motion == Support::no_motion) continue;
    const auto motion = supports_.motions[at(support.motion)].at(0);
    const std::size_t i = number<D>(support.node, support.axis);
    now.velocity[i] = motion.velocity;
    now.acceleration[i] = motion.acceleration;
  }
  state_.velocity = now.velocity;
  state_.balance = balance_of(now);
  if (!inertia()) return;
  NodalColumn right = product(mass_, now.acceleration);
  add(right, 1, state_.balance);
  for (Real& value : right) value = -value;
  if (!solver_->factorize(mass_.values())) throw PhysicsError("the mass matrix is singular");
  factorized_.reset();
  state_.acceleration = now.acceleration;
  add(state_.acceleration, 1, solver_->solve(right));
}

template <int D>
void FemStepper<D>::advance() {
  move_sides();
  walk({time(), static_cast<Real>(state_.steps + 1) * rules_.step, rules_.step}, rules_.most_cuts);
  ++state_.steps;
}

template <int D>
void FemStepper<D>::restore(const FemState<D>& saved) {
  state_ = saved;
  free_field_->restore(state_.columns);
  if (body_->is_linear()) return;  // then neither the tangent nor its factors have changed
  body_->forget_tangent();
  factorized_.reset();
}

/// Over the span, in halves where that does not converge.
template <int D>
void FemStepper<D>::walk(const Span& span, int cuts_left) {
  // Where all is linear, nothing is tried that a return would have to take back.
  const std::optional<FemState<D>> saved = body_->is_linear() ? std::nullopt : std::optional(state_);
  if (attempt(span)) return;
  if (!saved || cuts_left == 0) give_up(span);
  restore(*saved);
  ++state_.cuts;
  walk(span.first_half(), cuts_left - 1);
  walk(span.second_half(), cuts_left - 1);
}

template <int D>
void FemStepper<D>::give_up(const Span& span) const {
  const std::string where = stage_ == Stage::relaxing
                                ? fmt::format("there is no equilibrium under {:.4g} of gravity{}", span.to,
                                              supports_.waters.empty() && is_zero(pore_) ? "" : " and of the pressure of water")
                                : fmt::format("there is no equilibrium at t = {:.6g} s", span.to);
  throw PhysicsError(fmt::format(
      "{}: Newton's iteration does not converge\n"
      "  tried: {} iterations with line search in a step, and steps cut to 1/{} of that of the case; last: {}\n"
      "  a body that fails has no equilibrium under its loads: check its strength and loads, or include inertia (time.analysis = "
      "\"dynamic\")",
      where, rules_.most_iterations, 1 << rules_.most_cuts, last_failure_));
}

template <int D>
typename FemStepper<D>::Factors FemStepper<D>::factors(Real length) const {
  if (!in_time()) return {};
  if (!inertia()) return {1 / (length * length), 1 / length, 1};
  const Real beta = 0.25 * (1 - rules_.alpha) * (1 - rules_.alpha), gamma = 0.5 - rules_.alpha;
  return {1 / (beta * length * length), gamma / (beta * length), 1 + rules_.alpha};
}

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
      const Eigen::VectorXd part = 2 * (face.impedance * all);
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        for (int axis = 0; axis < D; ++axis)
          force[number<D>(face.nodes[i], axis)] += part[static_cast<Eigen::Index>(i) * D + axis];
    }
  }
  return force;
}

/// True when the step, or equilibrium, is found; then it counts.
template <int D>
bool FemStepper<D>::attempt(const Span& span) {
  if (inertia()) jump(span);
  NodalColumn prescribed;
  Trial trial = predict(span, prescribed);
  if (!iterate(trial, factors(span.length), prescribed)) return false;
  commit(trial, span);
  return true;
}

/// Newton's iteration. The first change is found with the supports' motion as the tangent tells it, so that it does not appear as
/// strain of the elements beside them alone.
template <int D>
bool FemStepper<D>::iterate(Trial& trial, const Factors& by, const NodalColumn& prescribed) {
  state_.tangent.multiply(prescribed, 1, trial.internal);
  Real scale = 0, left = 0;
  for (int iteration = 0; iteration < rules_.most_iterations; ++iteration) {
    NodalColumn right = unbalance(trial, scale);
    for (Real& value : right) value = -value;
    if (!factorize(by)) {
      last_failure_ = "the tangent was singular";
      return false;
    }
    NodalColumn change = solver_->solve(right);
    if (iteration == 0) {
      add(trial.displacement, 1, prescribed);
      left = norm(right);
    }
    ++state_.iterations;
    left = search(trial, change, by, left, iteration > 0);
    unbalance(trial, scale);
    if (!std::isfinite(left)) break;
    if (left <= rules_.tolerance * scale) return true;
  }
  last_failure_ =
      fmt::format("{:.3g} of the forces was unbalanced, {:.3g} is required", scale > 0 ? left / scale : left, rules_.tolerance);
  return false;
}

/// Moves by a change, or by the half of it as often as that leaves less unbalanced force than before. Returns what is left.
template <int D>
Real FemStepper<D>::search(Trial& trial, const NodalColumn& change, const Factors& by, Real before, bool may_shorten) {
  constexpr int most_halves = 5;
  Real share = 1, scale = 0, left = 0;
  move(trial, change, 1, by);
  evaluate(trial);
  left = norm(unbalance(trial, scale));
  for (int halves = 0; may_shorten && halves < most_halves && !(left < before) && left > rules_.tolerance * scale; ++halves) {
    move(trial, change, -0.5 * share, by);
    share *= 0.5;
    evaluate(trial);
    left = norm(unbalance(trial, scale));
  }
  return left;
}

template <int D>
void FemStepper<D>::move(Trial& trial, const NodalColumn& change, Real share, const Factors& by) const {
  add(trial.displacement, share, change);
  if (!in_time()) return;
  add(trial.velocity, share * by.damping, change);
  add(trial.acceleration, share * by.mass, change);
}

template <int D>
void FemStepper<D>::evaluate(Trial& trial) {
  if (body_->evaluate(trial.displacement, state_.memory, trial.memory, trial.internal, &state_.tangent)) factorized_.reset();
}

template <int D>
NodalColumn FemStepper<D>::balance_of(const Trial& trial) const {
  NodalColumn balance = trial.internal;
  add(balance, -1, trial.external);
  if (in_time()) rate_matrix().multiply(trial.velocity, 1, balance);
  return balance;
}

/// The unbalanced forces of a trial, 0 where a support takes them; `scale` is the size of the forces in play.
template <int D>
NodalColumn FemStepper<D>::unbalance(const Trial& trial, Real& scale) const {
  NodalColumn residual = balance_of(trial);
  scale = std::max(norm(trial.internal), norm(trial.external));
  if (inertia())
    for (std::size_t i = 0; i < residual.size(); ++i)
      residual[i] = (1 + rules_.alpha) * residual[i] - rules_.alpha * state_.balance[i];
  if (in_time()) {
    const NodalColumn inertial = product(inertia_matrix(), trial.acceleration);
    scale = std::max(scale, norm(inertial));
    add(residual, 1, inertial);
  }
  for (std::size_t i = 0; i < unknowns_.leader.size(); ++i)
    if (const std::size_t leader = unknowns_.leader[i]; leader != i) residual[leader] += residual[i];
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (!unknowns_.is_free[i]) residual[i] = 0;
  return residual;
}

template <int D>
bool FemStepper<D>::factorize(const Factors& by) {
  if (factorized_ == by) return true;
  std::vector<Real> blocks(state_.tangent.values());
  if (in_time()) {
    const auto &m = inertia_matrix().values(), &c = rate_matrix().values();
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] = by.stiffness * (blocks[i] + by.damping * c[i]) + by.mass * m[i];
  }
  factorized_.reset();
  ++factorizations_;
  if (!solver_->factorize(blocks)) return false;
  factorized_ = by;
  return true;
}

template <int D>
void FemStepper<D>::commit(Trial& trial, const Span& span) {
  const NodalColumn balance = balance_of(trial);
  add_work(trial, balance, span);
  state_.displacement.swap(trial.displacement);
  state_.velocity.swap(trial.velocity);
  state_.acceleration.swap(trial.acceleration);
  state_.internal.swap(trial.internal);
  state_.memory = std::move(trial.memory);
  state_.balance = balance;
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
  return sum;
}

template <int D>
Vector<D> FemStepper<D>::side_force(std::size_t which) const {
  const auto& side = supports_.sides[which];
  Vector<D> sum = free_field_->force(which, state_.velocity);
  for (const Index node : side.nodes) sum[side.across] += reaction_[number<D>(node, side.across)];
  return sum;
}

/// Columns go ahead to the end of the step.
template <int D>
void FemStepper<D>::move_sides() {
  if (free_field_->is_empty()) return;
  free_field_->advance();
  state_.sides_before = std::move(state_.sides);
  state_.sides = free_field_->motion();
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

template <int D>
void FemStepper<D>::columns(Archive& archive) {
  archive("steps", state_.steps);
  archive("iterations", state_.iterations);
  archive("cuts", state_.cuts);
  archive("displacement", state_.displacement);
  archive("velocity", state_.velocity);
  archive("acceleration", state_.acceleration);
  archive("internal", state_.internal);
  archive("balance", state_.balance);
  archive("applied", state_.applied);
  archive("carried", state_.carried);
  archive("plastic", state_.memory.solids);
  archive("slip", state_.memory.joints);
  archive("tangent", state_.tangent.values());
  archive("initial_displacement", initial_displacement_);
  archive("reaction", reaction_);
  archive("elastic_at_start", elastic_at_start_);
  free_field_->columns(archive);
  std::vector<FemWork> work = {state_.work};
  archive("work", work);
  state_.work = work.at(0);
  if (!archive.reading()) return;
  state_.columns = free_field_->states();
  if (!free_field_->is_empty()) state_.sides = free_field_->motion();
  restore(FemState<D>(state_));
}

template class FemStepper<2>;
template class FemStepper<3>;

}  // namespace sazare::methods::fem
