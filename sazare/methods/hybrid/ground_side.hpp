#pragma once

/// Ground of moving particles on the bodies' side of a coupling: in the plane with a continuum in the plane, in space with one in
/// space.

#include "sazare/methods/hybrid/slab_surface.hpp"
#include "sazare/methods/hybrid/uniform_side.hpp"
#include "sazare/methods/mps/ground_at_surface.hpp"

namespace sazare::methods::hybrid {

template <int D>
class GroundSide final : public UniformSide<D> {
public:
  /// `forces` are those of the stepper; both must outlive the side. `can_return`: see UniformSide.
  GroundSide(particles::UniformStepper<D>& stepper, methods::mps::GroundAtSurface<D>& forces, bool can_return = true)
      : UniformSide<D>(stepper, can_return), forces_(&forces) {}

  /// Throws UserError where the surface has another dimension.
  void attach(const coupling::SurfaceShape& shape) override;

private:
  std::vector<Vector3> places(const std::vector<Real>& displacement) const override { return surface_.places(displacement); }
  std::vector<Real> folded(const std::vector<Vector3>& forces, Real factor) const override {
    return surface_.folded(forces, factor);
  }
  const geometry::SurfaceNodes& nodes() const override { return forces_->surface()->nodes(); }
  void lead(std::vector<Vector3> from, std::vector<Vector3> with) override { forces_->lead(std::move(from), std::move(with)); }
  void put_surface() override;

  methods::mps::GroundAtSurface<D>* forces_;
  SlabSurface surface_;
};

extern template class GroundSide<2>;
extern template class GroundSide<3>;

}  // namespace sazare::methods::hybrid
