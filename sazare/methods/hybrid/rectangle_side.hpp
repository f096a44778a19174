#pragma once

/// Elements of method rectangles on the bodies' side of a coupling with a continuum in the plane.

#include "sazare/methods/hybrid/uniform_side.hpp"
#include "sazare/methods/rectangles/rectangle_forces.hpp"

namespace sazare::methods::hybrid {

class RectangleSide final : public UniformSide<2> {
public:
  /// `forces` are those of the stepper; both must outlive the side. `elements` of the particles are no supports; `can_return`:
  /// see UniformSide.
  RectangleSide(particles::UniformStepper<2>& stepper, methods::rectangles::RectangleForces& forces, Index elements,
                bool can_return = true)
      : UniformSide(stepper, can_return), forces_(&forces), elements_(elements) {}

  /// Throws UserError where the surface is not in the plane as well.
  void attach(const coupling::SurfaceShape& shape) override;

private:
  std::vector<Vector3> places(const std::vector<Real>& displacement) const override;
  std::vector<Real> folded(const std::vector<Vector3>& forces, Real factor) const override;
  const geometry::SurfaceNodes& nodes() const override { return forces_->surface()->nodes(); }
  void lead(std::vector<Vector3> from, std::vector<Vector3> with) override { forces_->lead(std::move(from), std::move(with)); }
  void put_surface() override {
    std::vector<Vector3> where = places(course().to());
    std::vector<Vector3> still(where.size(), Vector3::Zero());
    lead(std::move(where), std::move(still));
  }

  methods::rectangles::RectangleForces* forces_;
  Index elements_;
};

}  // namespace sazare::methods::hybrid
