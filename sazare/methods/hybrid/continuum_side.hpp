#pragma once

/// The side of finite elements in a coupling: it leads, window by window, each one of its steps.
///
/// What bodies put on the nodes of the surface is known only after the window for which the continuum needs it. Four schemes:
///
///     lagged     the force at the end of the window before, held through the window (Nakase et al., the method's fig. 1)
///     impulse    the mean force of the window before: nothing of the bodies' impulse is lost, it comes a window later
///     iterative  windows are gone through again until the force with which the continuum moved is the mean of what it brings
///                about; what is left between the two goes into the next window
///     automatic  the same, but a window counts as soon as what is left is a small share of the force, most often at once; the
///                first pass applies a part of what earlier windows left, further ones all of it; after the last pass the one
///                counts that left least
///
/// A force that lags behind feeds on itself where the contact is stiffer than the surface is in a window, or the bodies are heavier
/// than what of the continuum moves in one: what a window leaves then comes back larger in the next. Such windows are those that the
/// automatic scheme goes through again.

#include <string>
#include <utility>

#include "sazare/coupling/channel.hpp"
#include "sazare/geometry/linear_surface.hpp"
#include "sazare/methods/hybrid/continuum.hpp"

namespace sazare::methods::hybrid {

enum class CouplingScheme { automatic, lagged, impulse, iterative };

struct CouplingRules {
  CouplingScheme scheme = CouplingScheme::automatic;
  Real width = 1;         ///< of the slab of bodies, in the plane [m]
  Real tolerance = 1e-4;  ///< of the iterative scheme: largest difference of forces, over the larger of the two
  int most_passes = 20;   ///< of the iterative and the automatic scheme
};

/// What went over the surface since the beginning, of the whole width.
struct CouplingTotals {
  Vector3 given = Vector3::Zero();  ///< impulse of the bodies on the nodes [N s]
  Vector3 taken = Vector3::Zero();  ///< impulse with which the continuum has moved [N s]
  Real energy_work_on_nodes = 0;           ///< of the forces with which the continuum has moved [J]
  Real energy_work_on_bodies = 0;          ///< of the moving surface [J]
  std::int64_t windows = 0, passes = 0;
  std::int64_t unconverged = 0;  ///< windows of the automatic scheme that kept more than its share of the force

  Vector3 under_way() const { return given - taken; }
  /// Energy added by the coupling: the sum of the works on both sides [J].
  Real made() const { return energy_work_on_nodes + energy_work_on_bodies; }
};

template <int D>
class ContinuumSide {
public:
  /// The stepper must outlive the side.
  ContinuumSide(ContinuumStepper<D>& stepper, geometry::LinearSurface surface, const CouplingRules& rules)
      : stepper_(&stepper), surface_(std::move(surface)), rules_(rules) {}

  /// The shape with the nodes in the equilibrium of the body.
  coupling::SurfaceShape shape() const;

  /// Forces on the surface as ones on all nodes, beside those from outside.
  NodalColumn on_nodes(const std::vector<Real>& force) const;

  /// Takes the forces at the beginning, after the stepper has started.
  void start(const coupling::SurfaceForce& force);

  /// Forces on all nodes that come from neither side [N]; they act beside those of the bodies, in every pass of a window, until
  /// others are given.
  void push(NodalColumn forces) { outside_ = std::move(forces); }

  /// Goes through a window. Throws PhysicsError where force and motion do not come to agree.
  void advance(coupling::ContinuumChannel& channel);

  const CouplingTotals& totals() const { return totals_; }
  const CouplingRules& rules() const { return rules_; }
  /// Force of the bodies on the whole surface: mean of the last window, and at its end [N].
  Vector3 mean_force() const { return sum(force_.mean); }
  Vector3 last_force() const { return sum(force_.last); }
  /// Mean of the nodes, since the beginning [m].
  Vector3 mean_displacement() const;

  /// Difference between the force tried and found in the last window, over the larger one; of schemes that repeat windows.
  Real disagreement() const { return disagreement_; }

  void columns(Archive& archive);

private:
  std::size_t nodes() const { return surface_.nodes.size(); }
  coupling::SurfaceMotion motion(std::int32_t pass) const;
  coupling::SurfaceForce try_window(coupling::ContinuumChannel& channel, const std::vector<Real>& force, std::int32_t pass);
  void repeat(coupling::ContinuumChannel& channel);
  bool has_converged(const std::vector<Real>& tried, std::vector<Real>& gap);
  [[noreturn]] void give_up() const;
  void add_work(const std::vector<Real>& applied, const std::vector<Real>& displacement_before);
  Vector3 sum(const std::vector<Real>& values) const;

  ContinuumStepper<D>* stepper_;
  geometry::LinearSurface surface_;
  CouplingRules rules_;
  coupling::SurfaceForce force_;  ///< of the last window
  NodalColumn outside_;           ///< see push; none where nothing was given
  std::vector<Real> carry_;       ///< what the last window left between the force tried and found [N]
  Real disagreement_ = 0;
  CouplingTotals totals_;
};

extern template class ContinuumSide<2>;
extern template class ContinuumSide<3>;

}  // namespace sazare::methods::hybrid
