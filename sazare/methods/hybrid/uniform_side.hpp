#pragma once

/// Particles of a uniform stepper on the bodies' side of a coupling.

#include <optional>

#include "sazare/core/memory_archive.hpp"
#include "sazare/geometry/nodal_surface.hpp"
#include "sazare/methods/hybrid/body_side.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::methods::hybrid {

template <int D>
class UniformSide : public BodySide {
public:
  /// The stepper must outlive the side. `can_return`: to a window's beginning, for which the particles are copied.
  UniformSide(particles::UniformStepper<D>& stepper, bool can_return) : stepper_(&stepper), can_return_(can_return) {}

  coupling::SurfaceForce start() final;
  /// Forces on the surface as last evaluated: before the beginning, those at rest.
  coupling::SurfaceForce force() const;
  /// Before the beginning: the surface stands elsewhere, as this shape has it.
  void move_to(const coupling::SurfaceShape& shape);
  coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) final;
  void take_back() final;
  std::int64_t windows() const final { return course_.windows(); }
  std::int64_t steps_per_window() const final { return course_.steps(); }
  void columns(Archive& archive) final { course_.columns(archive); }

protected:
  const particles::UniformStepper<D>& stepper() const { return *stepper_; }
  WindowCourse& course() { return course_; }
  const WindowCourse& course() const { return course_; }

private:
  /// Places of the surface's nodes where it is displaced so [m], and forces on these as those of the continuum, times a factor.
  virtual std::vector<Vector3> places(const std::vector<Real>& displacement) const = 0;
  virtual std::vector<Real> folded(const std::vector<Vector3>& forces, Real factor) const = 0;
  virtual const geometry::SurfaceNodes& nodes() const = 0;
  /// From now on the nodes go from these places with these velocities [m; m/s].
  virtual void lead(std::vector<Vector3> from, std::vector<Vector3> with) = 0;
  /// The surface stands as `course` has it now, at rest.
  virtual void put_surface() = 0;
  void go_back();

  particles::UniformStepper<D>* stepper_;
  bool can_return_;
  WindowCourse course_;
  std::optional<MemoryArchive> saved_;  ///< the particles at the last window's beginning
};

extern template class UniformSide<2>;
extern template class UniformSide<3>;

}  // namespace sazare::methods::hybrid
