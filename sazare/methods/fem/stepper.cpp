#include "sazare/methods/fem/stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/free_field.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"

namespace sazare::methods::fem {

namespace {

constexpr const char* forces_are_no_numbers = "the forces are infinite, or no numbers";
constexpr int usual_iterations = 2;  // after which it is asked whether round-off stands in the way

}  // namespace

template <int D>
FemStepper<D>::FemStepper(std::unique_ptr<methods::fem::Body<D>> body, methods::fem::Supports<D> supports, const FemRules& rules)
    : body_(std::move(body)),
      supports_(std::move(supports)),
      rules_(rules),
      mass_(body_->mass()),
      rayleigh_(body_->damping_matrix(rules.damping)),
      viscous_(body_->pattern()),
      damping_(rayleigh_),
      free_field_(std::make_unique<FreeField<D>>(*body_, supports_, rules)),
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
  pore_matrices_ = std::make_unique<PoreMatrices>(*body_);
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

template <int D>
void FemStepper<D>::relax(NodalColumn applied) {
  if (!columns_rest_) free_field_->relax();
  columns_rest_ = true;
  state_.columns = free_field_->states();
  state_.applied = widened(std::move(applied));
  stage_ = Stage::relaxing;
  prepare_solver(true);
  walk({0, 1, 1}, rules_.most_cuts);
  stage_ = Stage::running;
  body_->begin_cycles(state_.displacement, state_.memory);
  initial_displacement_ = state_.displacement;
  NodalColumn carried = weight_;
  add_water(0, 1, carried);
  add(carried, 1, state_.applied);
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
  if (!free_field_->is_empty()) state_.sides = free_field_->motion(time());
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

/// Whether a motion holds a place above the lowest ones along gravity.
template <int D>
bool FemStepper<D>::moves_what_settles() const {
  const auto& nodes = body_->mesh().nodes;
  return std::ranges::any_of(supports_.held, [&](const Support& support) {
    const auto is_lower = [&](const Vector3& node) { return node[support.axis] < nodes[at(support.node)][support.axis]; };
    return support.motion != Support::no_motion && supports_.gravity[support.axis] < 0 && std::ranges::any_of(nodes, is_lower);
  });
}

template <int D>
void FemStepper<D>::give_up(const Span& span) const {
  const std::string where = stage_ == Stage::relaxing
                                ? fmt::format("there is no equilibrium under {:.4g} of gravity{}", span.to,
                                              supports_.waters.empty() && is_zero(pore_) ? "" : " and of the pressure of water")
                                : fmt::format("there is no equilibrium at t = {:.6g} s", span.to);
  if (last_failure_ == forces_are_no_numbers)
    throw PhysicsError(fmt::format(
        "{}: {}\n  a number of the case is too large or too small for what follows from it: check densities, stiffnesses, sizes, "
        "gravity and loads, and their units",
        where, last_failure_));
  const std::string held = stage_ == Stage::relaxing && moves_what_settles()
                               ? "\n  supports that a motion moves, such as a footing, stand still while the body settles, and "
                                 "hold the ground beside them up: "
                                 "let the ground settle below a load, or give it strength for its own weight"
                               : "";
  throw PhysicsError(fmt::format(
      "{}: Newton's iteration does not converge\n"
      "  tried: {} iterations with line search in a step, and steps cut to 1/{} of that of the case; last: {}\n"
      "  a body that fails has no equilibrium under its loads: check its strength and loads, or include inertia (time.analysis = "
      "\"dynamic\"){}",
      where, rules_.most_iterations, 1 << rules_.most_cuts, last_failure_, held));
}

template <int D>
typename FemStepper<D>::Factors FemStepper<D>::factors(Real length) const {
  if (!in_time()) return {};
  if (!inertia()) return {1 / (length * length), 1 / length, 1};
  const Real beta = 0.25 * (1 - rules_.alpha) * (1 - rules_.alpha), gamma = 0.5 - rules_.alpha;
  return {1 / (beta * length * length), gamma / (beta * length), 1 + rules_.alpha};
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
    if (!std::isfinite(left)) {
      last_failure_ = forces_are_no_numbers;
      return false;
    }
    if (left <= rules_.tolerance * scale) return true;
    if (iteration >= usual_iterations && left <= round_off(prescribed)) return true;
  }
  last_failure_ =
      fmt::format("{:.3g} of the forces was unbalanced, {:.3g} is required", scale > 0 ? left / scale : left, rules_.tolerance);
  return false;
}

/// Unbalanced force that round-off may leave: internal forces are differences of displacements, which a base may have carried
/// far, or carries in this step. Those of the trial do not count: where there is no equilibrium they grow without bound.
template <int D>
Real FemStepper<D>::round_off(const NodalColumn& prescribed) const {
  NodalColumn far = state_.displacement;
  std::array<Real, D> farthest{};
  for (std::size_t i = 0; i < far.size(); ++i) farthest[i % D] = std::max(farthest[i % D], std::abs(prescribed[i]));
  for (std::size_t i = 0; i < far.size(); ++i) far[i] = std::abs(far[i]) + farthest[i % D];
  return 4 * std::numeric_limits<Real>::epsilon() * norm(state_.tangent.magnitude_of_product(far));
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
  archive("yielded", state_.memory.members);
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
  if (!free_field_->is_empty()) state_.sides = free_field_->motion(time());
  restore(FemState<D>(state_));
}

template class FemStepper<2>;
template class FemStepper<3>;

}  // namespace sazare::methods::fem
