#pragma once

/// Small coupled bodies for the tests: a box of finite elements and spheres on its top.

#include "sazare/methods/hybrid/continuum_side.hpp"
#include "sazare/methods/hybrid/sphere_side.hpp"
#include "tests/support/element_boxes.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::test {

struct Ball {
  Vector3 centre = Vector3::Zero();    ///< [m]
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
  Vector3 spin = Vector3::Zero();      ///< [rad/s]
};

struct CouplingScene {
  geometry::ElementShape shape = geometry::ElementShape::quadrilateral4;
  BoxRules box;
  Real youngs_modulus = 1e6, density = 2000;
  Real alpha = 0;
  bool held = true;     ///< at the bottom
  bool upright = true;  ///< the nodes move along the last axis only
  bool lumped = true;
  Real radius = 0.05;
  Real ball_mass = 1;
  std::vector<Ball> balls;
  Vector3 gravity = Vector3::Zero();  ///< of the balls
  Real stiffness = 1e5, restitution = 1, friction = 0, rolling = 0;
  std::int64_t steps = 20;  ///< of the balls in a window
  methods::hybrid::CouplingRules rules;
};

/// The box alone, not started.
template <int D>
std::unique_ptr<methods::fem::FemStepper<D>> make_fem(const CouplingScene& scene, Real window);

template <int D>
class TwoSides {
public:
  TwoSides(const CouplingScene& scene, Real window);

  void start();
  void advance(int windows);
  void columns(Archive& archive);
  /// As a checkpoint has it: the finite elements first, since the surface stands where they have settled.
  void resume(MemoryArchive& archive);

  methods::fem::FemStepper<D>& fem() { return *fem_; }
  methods::spheres::SphereStepper& balls() { return *balls_; }
  methods::hybrid::ContinuumSide<D>& continuum() { return *continuum_; }
  /// Momentum of the finite elements over the whole width [kg m/s].
  Vector3 momentum() const;
  Real width() const { return width_; }

private:
  Real width_;
  std::unique_ptr<methods::fem::FemStepper<D>> fem_;
  std::unique_ptr<methods::spheres::SphereStepper> balls_;
  std::unique_ptr<methods::hybrid::SphereSide> bodies_;
  std::unique_ptr<methods::hybrid::ContinuumSide<D>> continuum_;
};

}  // namespace sazare::test
