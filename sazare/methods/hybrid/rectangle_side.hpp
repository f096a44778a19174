#pragma once

/// Elements of method rectangles on the bodies' side of a coupling with a continuum in the plane.

#include <optional>

#include "sazare/core/memory_archive.hpp"
#include "sazare/methods/hybrid/body_side.hpp"
#include "sazare/methods/rectangles/rectangle_forces.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::methods::hybrid {

class RectangleSide final : public BodySide {
public:
  /// `forces` are those of the stepper; both must outlive the side. `elements` of the particles are no supports; `can_return`: to
  /// a window's beginning, for which the elements are copied.
  RectangleSide(particles::UniformStepper<2>& stepper, methods::rectangles::RectangleForces& forces, Index elements, bool can_return = true)
      : stepper_(&stepper), forces_(&forces), elements_(elements), can_return_(can_return) {}

  /// Throws UserError where the surface is not in the plane as well.
  void attach(const coupling::SurfaceShape& shape) override;
  coupling::SurfaceForce start() override;
  coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) override;
  void take_back() override;
  std::int64_t windows() const override { return course_.windows(); }
  std::int64_t steps_per_window() const override { return course_.steps(); }
  void columns(Archive& archive) override { course_.columns(archive); }

private:
  std::vector<Vector3> places(const std::vector<Real>& displacement) const;
  std::vector<Real> folded(const std::vector<Vector3>& forces, Real factor) const;
  void go_back();

  particles::UniformStepper<2>* stepper_;
  methods::rectangles::RectangleForces* forces_;
  Index elements_;
  bool can_return_;
  WindowCourse course_;
  std::optional<MemoryArchive> saved_;  ///< the elements at the last window's beginning
};

}  // namespace sazare::methods::hybrid
