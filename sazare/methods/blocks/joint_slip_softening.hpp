#pragma once

/// What slip and opening do to joints whose law softens by both, in every lane.

#include "sazare/methods/blocks/joint_changes.hpp"

namespace sazare::methods::blocks {

template <laws::SoftensBySlip Law>
Lanes damage_at(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, int v) {
  return damage(kind.tension, kind.shear, at.peak[v], at.path[v]);
}

/// Stress [Pa] at every vertex once the memory has been raised to the opening.
template <laws::SoftensBySlip Law>
LaneVector tension_stress(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  LaneVector stress;
  for (int v = 0; v < vertex_count; ++v)
    stress[v] = damaged_stress(kind.tension, at.opening[v], at.peak[v], damage_at(kind, at, v));
  return stress;
}

template <laws::SoftensBySlip Law>
Lanes strength_at(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneVector& stress, int v) {
  return shear_strength(kind.shear, stress[v], damage_at(kind, at, v));
}

/// Lets a vertex slip and soften if it must. What the spring across the face loses by the damage of the slip is fracture by opening.
template <laws::SoftensBySlip Law>
void slide(const JointParameters<Law, Lanes>& kind, int v, LaneVector& stress, FaceGeometry& at, JointChange& change) {
  auto& shear = at.shear[static_cast<std::size_t>(v)];
  laws::SofteningSlip<Lanes> slip{{{shear[0], shear[1]}, {}, {}}, {}};
  const Lanes before = damage_at(kind, at, v), stored = stored_energy(kind.tension, at.opening[v], stress[v]);
  change.slipped |= slips(kind.shear, slip, shear_strength(kind.shear, stress[v], before));
  slip_and_soften(kind.shear, slip, stress[v], before, at.path[v]);
  shear = {slip.elastic[0], slip.elastic[1]};
  change.slip[static_cast<std::size_t>(v)] = {slip.memory[0], slip.memory[1]};
  stress[v] = damaged_stress(kind.tension, at.opening[v], at.peak[v], damage_at(kind, at, v));
  change.slip_work += at.vertex_area * (slip.dissipation - slip.fracture);
  change.shear_fracture += at.vertex_area * slip.fracture;
  change.opening_fracture += at.vertex_area * (stored - stored_energy(kind.tension, at.opening[v], stress[v]));
}

/// Whether a vertex has neither tensile strength nor cohesion.
template <laws::SoftensBySlip Law>
LaneMask has_no_strength(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, int v) {
  return damage_at(kind, at, v) >= 1.0;
}

/// Whether the face parts: a vertex without strength opens, or has slipped by the size of the face.
template <laws::SoftensBySlip Law>
LaneMask parts(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  const Lanes size = square_root(vertex_count * at.vertex_area);
  LaneMask parts{};
  for (int v = 0; v < vertex_count; ++v)
    parts |= has_no_strength(kind, at, v) & ((at.opening[v] > 0.0) | (at.path[v] > size));
  return parts;
}

/// What is stored in a face that parts is lost.
template <laws::SoftensBySlip Law>
void fail(const JointParameters<Law, Lanes>& kind, const LaneVector& stress, const FaceGeometry& at, JointChange& change) {
  change.failed = parts(kind, at);
  for (int v = 0; v < vertex_count; ++v) change.sheared |= has_no_strength(kind, at, v);
  change.sheared &= ~change.failed;
  if (any(change.failed)) change.released = select(change.failed, elastic_energy(kind, at, stress), Lanes{});
}

/// What softens, fails and slips, and the stress that remains; returns which joints have failed.
template <laws::SoftensBySlip Law>
LaneMask change_joints(const JointParameters<Law, Lanes>& kind, const LaneVector& peak_before, const LaneVector&,
                       const LaneMask& opened, LaneVector& stress, FaceGeometry& at, JointChange& change) {
  change.slipped = change.failed = change.sheared = LaneMask{};
  change.slip_work = change.released = change.opening_fracture = change.shear_fracture = Lanes{};
  for (int v = 0; v < vertex_count; ++v) {
    const Lanes before = damage(kind.tension, kind.shear, peak_before[v], at.path[v]);
    change.opening_fracture += at.vertex_area * opening_dissipation(kind.tension, peak_before[v], at.peak[v], before);
    slide(kind, v, stress, at, change);
  }
  change.peak = at.peak;
  change.path = at.path;
  fail(kind, stress, at, change);
  change.softened = opened | change.slipped | change.failed;
  return change.failed;
}

}  // namespace sazare::methods::blocks
