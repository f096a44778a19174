#pragma once

/// Spheres on the bodies' side of a coupling.

#include "sazare/methods/hybrid/body_side.hpp"
#include "sazare/methods/hybrid/slab_surface.hpp"
#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::hybrid {

class SphereSide final : public BodySide {
public:
  /// `material` of the surface, by its number among those of the spheres; `can_return`: to a window's beginning, for which the
  /// spheres are copied. The stepper must outlive the side.
  SphereSide(spheres::SphereStepper& stepper, Index material, bool can_return = true)
      : stepper_(&stepper), material_(material), can_return_(can_return) {}

  void attach(const coupling::SurfaceShape& shape) override;
  coupling::SurfaceForce start() override;
  coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) override;
  void take_back() override;
  std::int64_t windows() const override { return course_.windows(); }
  std::int64_t steps_per_window() const override { return course_.steps(); }
  void columns(Archive& archive) override { course_.columns(archive); }

private:
  spheres::SphereStepper* stepper_;
  Index material_;
  bool can_return_;
  WindowCourse course_;
  SlabSurface surface_;
  std::optional<spheres::SphereStepper> saved_;  ///< the spheres at the last window's beginning
};

}  // namespace sazare::methods::hybrid
