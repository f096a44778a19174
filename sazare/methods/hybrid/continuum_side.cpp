#include "sazare/methods/hybrid/continuum_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sazare/core/error.hpp"
#include "sazare/methods/hybrid/agreement.hpp"

namespace sazare::methods::hybrid {

namespace {

/// Share of the force carried over from earlier windows that the first pass of the automatic scheme applies. All of it would
/// extrapolate the force: its changes from window to window would then grow, until windows have to be repeated.
constexpr Real first_share = 0.1;

/// Values of the surface's nodes, out of those of all.
template <int D>
std::vector<Real> of_surface(const geometry::LinearSurface& surface, const NodalColumn& all) {
  std::vector<Real> values;
  for (const Index node : surface.nodes)
    for (int axis = 0; axis < D; ++axis) values.push_back(all[number<D>(node, axis)]);
  return values;
}

std::vector<Real> difference(std::vector<Real> values, const std::vector<Real>& others) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= others[i];
  return values;
}

std::vector<Real> sum_of(std::vector<Real> values, const std::vector<Real>& others) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += others[i];
  return values;
}

std::vector<Real> part_of(std::vector<Real> values, Real share) {
  for (Real& value : values) value *= share;
  return values;
}

}  // namespace

template <int D>
coupling::SurfaceShape ContinuumSide<D>::shape() const {
  coupling::SurfaceShape shape;
  shape.dimension = D;
  shape.width = D == 2 ? rules_.width : 1;
  shape.window = stepper_->rules().step;
  shape.faces.assign(surface_.faces.begin(), surface_.faces.end());
  const std::vector<Real> initial = of_surface<D>(surface_, stepper_->initial_displacement());
  for (std::size_t n = 0; n < nodes(); ++n)
    for (int axis = 0; axis < D; ++axis) {
      const Vector3& place = stepper_->body().mesh().nodes[static_cast<std::size_t>(surface_.nodes[n])];
      shape.nodes.push_back(place[axis] + initial[n * D + static_cast<std::size_t>(axis)]);
    }
  return shape;
}

template <int D>
void ContinuumSide<D>::start(const coupling::SurfaceForce& force) {
  force_ = force;
  carry_.assign(nodes() * D, 0);
}

/// Where the surface is, at the end of the window that the stepper has gone through last.
template <int D>
coupling::SurfaceMotion ContinuumSide<D>::motion(std::int32_t pass) const {
  const auto& state = stepper_->state();
  return {state.steps - 1, pass, stepper_->time(),
          difference(of_surface<D>(surface_, state.displacement), of_surface<D>(surface_, stepper_->initial_displacement())),
          of_surface<D>(surface_, state.velocity)};
}

template <int D>
NodalColumn ContinuumSide<D>::on_nodes(const std::vector<Real>& force) const {
  NodalColumn all = outside_;
  all.resize(stepper_->body().freedoms(), 0);
  for (std::size_t n = 0; n < nodes(); ++n)
    for (int axis = 0; axis < D; ++axis) all[number<D>(surface_.nodes[n], axis)] += force[n * D + static_cast<std::size_t>(axis)];
  return all;
}

template <int D>
coupling::SurfaceForce ContinuumSide<D>::try_window(coupling::ContinuumChannel& channel, const std::vector<Real>& force,
                                                    std::int32_t pass) {
  stepper_->apply(on_nodes(force));
  stepper_->advance();
  ++totals_.passes;
  return channel.exchange(motion(pass));
}

template <int D>
void ContinuumSide<D>::advance(coupling::ContinuumChannel& channel) {
  if (rules_.scheme == CouplingScheme::iterative || rules_.scheme == CouplingScheme::automatic) return repeat(channel);
  const std::vector<Real> applied = rules_.scheme == CouplingScheme::lagged ? force_.last : force_.mean;
  const std::vector<Real> before = of_surface<D>(surface_, stepper_->state().displacement);
  force_ = try_window(channel, applied, 0);
  add_work(applied, before);
}

/// The continuum moves with the force that it is to bring about and with the carry.
template <int D>
void ContinuumSide<D>::repeat(coupling::ContinuumChannel& channel) {
  const ContinuumState<D> saved = stepper_->state();
  const std::vector<Real> before = of_surface<D>(surface_, saved.displacement);
  Real share = rules_.scheme == CouplingScheme::automatic ? first_share : 1;
  Agreement agreement;
  std::vector<Real> tried = force_.mean, applied, gap, best;
  Real least = std::numeric_limits<Real>::infinity();
  const auto attempt = [&](std::int32_t pass) {
    if (pass > 0) {
      stepper_->restore(saved);
      share = 1;  // the force is sought anew
    }
    applied = sum_of(tried, part_of(carry_, share));
    force_ = try_window(channel, applied, pass);
    return has_converged(tried, gap);
  };
  bool converged = false;
  for (std::int32_t pass = 0; pass < rules_.most_passes; ++pass) {
    converged = attempt(pass);
    if (converged) break;
    if (disagreement_ < least) {
      least = disagreement_;
      best = tried;
    }
    tried = agreement.next(tried, force_.mean);
  }
  if (!converged) {
    if (rules_.scheme == CouplingScheme::iterative || best.empty()) give_up();
    tried = best;
    attempt(rules_.most_passes);
    ++totals_.unconverged;
  }
  add_work(applied, before);
  carry_ = sum_of(gap, part_of(carry_, 1 - share));
}

/// Whether the force with which the continuum moved is near enough to the one that came of it; `gap` is what lies between them.
template <int D>
bool ContinuumSide<D>::has_converged(const std::vector<Real>& tried, std::vector<Real>& gap) {
  constexpr Real small_share = 1e-2;
  gap = difference(force_.mean, tried);
  const Real scale = std::max(norm(force_.mean), norm(tried));
  disagreement_ = scale > 0 ? norm(gap) / scale : 0;
  return disagreement_ <= (rules_.scheme == CouplingScheme::automatic ? small_share : rules_.tolerance);
}

template <int D>
void ContinuumSide<D>::give_up() const {
  throw PhysicsError(
      fmt::format("force and motion of the surface do not agree at t = {:.6g} s\n"
                  "  tried: {} passes through the window; {:.3g} of the force remains, {:.3g} is required\n"
                  "  a shorter window (the step of the finite elements) converges sooner; so does a heavier or stiffer surface",
                  stepper_->time(), rules_.most_passes, disagreement_, rules_.tolerance));
}

template <int D>
void ContinuumSide<D>::add_work(const std::vector<Real>& applied, const std::vector<Real>& before) {
  const std::vector<Real> moved = difference(of_surface<D>(surface_, stepper_->state().displacement), before);
  const Real window = stepper_->rules().step, width = D == 2 ? rules_.width : 1;
  totals_.given += window * sum(force_.mean);
  totals_.taken += window * sum(applied);
  totals_.energy_work_on_nodes += width * dot(applied, moved);
  totals_.energy_work_on_bodies -= width * dot(force_.mean, moved);
  ++totals_.windows;
}

/// Sum over all nodes, for the whole width.
template <int D>
Vector3 ContinuumSide<D>::sum(const std::vector<Real>& values) const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < values.size(); ++i) total[static_cast<int>(i % D)] += values[i];
  return D == 2 ? Vector3(rules_.width * total) : total;
}

template <int D>
Vector3 ContinuumSide<D>::mean_displacement() const {
  const std::vector<Real> moved = motion(0).displacement;
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < moved.size(); ++i) total[static_cast<int>(i % D)] += moved[i];
  return total / static_cast<Real>(nodes());
}

template <int D>
void ContinuumSide<D>::columns(Archive& archive) {
  archive("mean", force_.mean);
  archive("last", force_.last);
  archive("carry", carry_);
  archive("disagreement", disagreement_);
  std::vector<CouplingTotals> totals = {totals_};
  archive("energy_balance", totals);
  totals_ = totals.at(0);
}

template class ContinuumSide<2>;
template class ContinuumSide<3>;

}  // namespace sazare::methods::hybrid
