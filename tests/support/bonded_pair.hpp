#pragma once

/// Two blocks with one joint between them, moved by the test itself: forces, memory and energies of the joint alone.

#include "sazare/methods/blocks/joints.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::test {

class BondedPair {
public:
  /// The joint's rate law sees an opening as `strain_per_opening` [1/m] times as much strain.
  explicit BondedPair(const cases::Joint& joint = concrete_joint("left", "right"), Real strain_per_opening = 1);

  /// Moves the second block from its place at the beginning: n across the face (positive opens), s and t along it.
  void place(Real n, Real s = 0, Real t = 0);

  /// Force and moment on each of the two blocks where they stand now; the joint's memory follows.
  std::vector<state::Impulse<3>> forces() { return probe_.forces({0}); }

  /// Stress on the face [Pa]: across it (tension positive) and along it (against s and t).
  Vector3 stress();

  ForceProbe<3>& probe() { return probe_; }
  state::Bodies<3>& bodies() { return bodies_; }
  methods::blocks::Joints& joints() { return joints_; }
  /// Area of the common face, as its joint has it [m2].
  Real area() const { return methods::blocks::vertex_count * Real{joints_.record(0).vertex_area}; }
  const Vector3& start() const { return bodies_.start[1]; }

private:
  state::Bodies<3> bodies_;
  methods::blocks::Joints joints_;
  ForceProbe<3> probe_;
};

}  // namespace sazare::test
