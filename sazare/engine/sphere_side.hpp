#pragma once

/// Spheres on the bodies' side of a coupling. A surface in the plane becomes one in space: each segment a rectangle across the
/// slab of spheres, whose forces are divided by the slab's width; what pushes across the plane, the plane strain holds.

#include "sazare/engine/body_side.hpp"
#include "sazare/engine/sphere_stepper.hpp"

namespace sazare::engine {

class SphereSide final : public BodySide {
public:
  /// `material` of the surface, by its number among those of the spheres. The stepper must outlive the side.
  SphereSide(SphereStepper& stepper, Index material) : stepper_(&stepper), material_(material) {}

  void attach(const coupling::SurfaceShape& shape) override;
  coupling::SurfaceForce start() override;
  coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) override;
  void take_back() override;
  std::int64_t windows() const override { return windows_; }
  void columns(Archive& archive) override;

  std::int64_t steps_per_window() const { return steps_; }

private:
  bool is_plane() const { return shape_.dimension == 2; }
  std::vector<Vector3> places(const std::vector<Real>& displacement) const;
  std::vector<Real> folded(const std::vector<Vector3>& forces, Real factor) const;
  void begin(const coupling::SurfaceMotion& motion);

  SphereStepper* stepper_;
  Index material_;
  coupling::SurfaceShape shape_;
  Real low_ = 0, high_ = 0;             ///< of the rectangles along z, in the plane [m]
  std::int64_t steps_ = 0;              ///< of the spheres in a window
  std::int64_t windows_ = 0;            ///< gone through
  std::vector<Real> from_, to_;         ///< displacements at the ends of the last window [m]
  std::optional<SphereStepper> saved_;  ///< the spheres at its beginning
};

}  // namespace sazare::engine
