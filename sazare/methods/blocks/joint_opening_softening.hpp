#pragma once

/// What slip and opening do to joints whose law softens by opening alone, in every lane.

#include "sazare/methods/blocks/joint_changes.hpp"

namespace sazare::methods::blocks {

/// Whether some joint has softened. Asked once for all vertices: no processor guesses which few have.
template <laws::SoftensByOpening Law>
bool some_soften(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  const auto softens = [&](int v) { return is_softened(kind.tension, at.peak[v]); };
  return any(softens(0) | softens(1) | softens(2));
}

/// Stress [Pa] at every vertex once the memory has been raised to the opening.
template <laws::SoftensByOpening Law>
LaneVector tension_stress(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  LaneVector stress = kind.tension.stiffness * at.opening;
  if (some_soften(kind, at))
    for (int v = 0; v < vertex_count; ++v) stress[v] = softened_stress(kind.tension, at.opening[v], at.peak[v]);
  return stress;
}

template <laws::SoftensByOpening Law>
Lanes strength_at(const JointParameters<Law, Lanes>& kind, const FaceGeometry&, const LaneVector& stress, int v) {
  return shear_strength(kind.shear, stress[v]);
}

/// A face parts when its memory has grown, and not otherwise.
template <laws::SoftensByOpening Law>
LaneMask parts(const JointParameters<Law, Lanes>&, const FaceGeometry&) {
  return LaneMask{};
}

/// What fracture has taken of faces for good [J].
template <laws::SoftensByOpening Law>
Lanes fracture_work(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  Lanes work{};
  for (int v = 0; v < vertex_count; ++v) work += fracture_dissipation(kind.tension, at.peak[v]);
  return work * at.vertex_area;
}

/// What is stored in a face that fails is lost.
template <laws::SoftensByOpening Law>
void fail(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneVector& stress, JointChange& change) {
  for (int v = 0; v < vertex_count; ++v) change.failed |= has_failed(kind.tension, at.peak[v]);
  if (any(change.failed)) change.released = select(change.failed, elastic_energy(kind, at, stress), Lanes{});
}

/// Lets the vertices slip that must, in the lanes where one does.
template <laws::SoftensByOpening Law>
void slide(const JointParameters<Law, Lanes>& kind, const LaneVector& strength, FaceGeometry& at, JointChange& change) {
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Lanes limit = strength[static_cast<int>(v)];
    laws::Slip<Lanes> slip{{at.shear[v][0], at.shear[v][1]}, {}, {}};
    change.slipped |= slips(kind.shear, slip, limit);
    slip_back(kind.shear, slip, limit);
    at.shear[v] = {slip.elastic[0], slip.elastic[1]};
    change.slip[v] = {slip.memory[0], slip.memory[1]};
    change.slip_work += select(change.failed, Lanes{}, at.vertex_area * slip.dissipation);
  }
}

/// What softens, fails and slips; returns which joints have failed.
template <laws::SoftensByOpening Law>
LaneMask change_joints(const JointParameters<Law, Lanes>& kind, const LaneVector&, const LaneVector& strength,
                       const LaneMask& softened, const LaneVector& stress, FaceGeometry& at, JointChange& change) {
  change.softened = softened;
  change.slipped = change.failed = LaneMask{};
  change.slip_work = change.released = Lanes{};
  change.peak = at.peak;
  fail(kind, at, stress, change);
  slide(kind, strength, at, change);
  return change.failed;
}

}  // namespace sazare::methods::blocks
