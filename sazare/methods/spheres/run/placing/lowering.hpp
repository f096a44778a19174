#pragma once

/// Lowers bodies one after the other along gravity, as a crane does, until they touch what lies below.

#include <optional>
#include <span>

#include "sazare/geometry/ball_union.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/neighbors/sphere_grid.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::runs {

class Lowering {
public:
  /// Onto the planes of a case and the spheres that have been placed.
  Lowering(const cases::SpheresCase& spheres, const state::Spheres& placed);

  /// How far a body goes down from where it is until one of its balls touches, coming from above all [m]: below 0 where it has to
  /// go up, nothing where it finds no ground.
  std::optional<Real> way_down(std::span<const geometry::Ball> balls) const;

  /// A ball that lies from now on.
  void add(const geometry::Ball& ball);

  const Vector3& down() const { return down_; }

private:
  struct Plane {
    Vector3 point, normal;
  };

  Real way_to_planes(const geometry::Ball& ball) const;
  Real way_to_balls(const geometry::Ball& ball, Real most) const;
  Real way_to(const geometry::Ball& ball, const geometry::Ball& other, Real from) const;

  Vector3 down_;  ///< of length 1
  state::PeriodicBox box_;
  std::vector<Plane> planes_;
  std::vector<geometry::Ball> all_;
  neighbors::SphereGrid grid_;
  Real largest_ = 0;               ///< radius [m]
  Real highest_ = 0, lowest_ = 0;  ///< along `down_`, of any point of the balls [m]
};

}  // namespace sazare::runs
