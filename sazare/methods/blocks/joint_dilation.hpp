#pragma once

/// What pressure and slip do to natural joints, in every lane.
///
/// The memory `peak` of a vertex is its dilation. Slip is worked out lane by lane: few vertices slip at a time, and each looks
/// for the slip after which it bears its strength.

#include "sazare/methods/blocks/joint_changes.hpp"

namespace sazare::methods::blocks {

/// An opening by this share of the size of its face parts a natural joint, and contact begins.
inline constexpr Real parting_share = 0.1;

/// Stress [Pa] at every vertex, tension positive: pressure or nothing.
template <laws::DilatesBySlip Law>
LaneVector tension_stress(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  LaneVector stress;
  for (int v = 0; v < vertex_count; ++v) stress[v] = -closing_pressure(kind.tension, at.peak[v] - at.opening[v]);
  return stress;
}

/// The least that the strength may be: who bears less does not slip.
template <laws::DilatesBySlip Law>
Lanes strength_at(const JointParameters<Law, Lanes>& kind, const FaceGeometry&, const LaneVector& stress, int v) {
  return least_strength(kind.shear, -stress[v]);
}

/// Whether all vertices of a face are open by more than this [m].
inline LaneMask is_open(const FaceGeometry& at, const Lanes& by) {
  const auto open = [&](int v) { return at.opening[v] - at.peak[v] > by; };
  return open(0) & open(1) & open(2);
}

/// Whether the two sides of a face have come so far apart, or slipped so far, that they are left to contact.
template <laws::DilatesBySlip Law>
LaneMask parts(const JointParameters<Law, Lanes>&, const FaceGeometry& at) {
  const Lanes size = square_root(vertex_count * at.vertex_area);
  LaneMask parts = is_open(at, parting_share * size);
  for (int v = 0; v < vertex_count; ++v) parts |= at.path[v] > size;
  return parts;
}

/// Lets a vertex slip, dilate and wear in the lanes where it must.
template <laws::DilatesBySlip Law>
void slide(const JointParameters<Law, Lanes>& kind, int v, const LaneMask& may_slip, LaneVector& stress, FaceGeometry& at,
           JointChange& change) {
  auto& shear = at.shear[static_cast<std::size_t>(v)];
  auto& slip = change.slip[static_cast<std::size_t>(v)];
  slip = {Lanes{}, Lanes{}};
  for (int lane = 0; lane < lane_count; ++lane) {
    if (may_slip[lane] == 0) continue;
    const auto closure = lane_of<typename Law::template Tension<Real>>(kind.tension, lane);
    const auto rough = lane_of<typename Law::template Shear<Real>>(kind.shear, lane);
    const LaneVector& before = at.stress[static_cast<std::size_t>(v)];
    laws::RoughVertex vertex{.elastic = {shear[0][lane], shear[1][lane]},
                             .compression = at.peak[v][lane] - at.opening[v][lane],
                             .path = at.path[v][lane],
                             .shear_before = {before[1][lane], before[2][lane]},
                             .pressure_before = -before[0][lane]};
    if (!slide(closure, rough, vertex)) continue;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      shear[axis][lane] = vertex.elastic[axis];
      slip[axis][lane] = vertex.slip[axis];
    }
    at.peak[v][lane] += vertex.dilation;
    at.path[v][lane] = vertex.path;
    stress[v][lane] = -closing_pressure(closure, at.peak[v][lane] - at.opening[v][lane]);
    change.slip_work[lane] += at.vertex_area[lane] * vertex.dissipation;
    change.slipped[lane] = -1;
  }
}

/// Keeps the stress that the joints bear now.
template <laws::DilatesBySlip Law>
void note_stress(const JointParameters<Law, Lanes>& kind, const LaneVector& stress, FaceGeometry& at) {
  for (std::size_t v = 0; v < vertex_count; ++v)
    at.stress[v] = {{stress[static_cast<int>(v)], kind.shear.stiffness * at.shear[v][0], kind.shear.stiffness * at.shear[v][1]}};
}

/// Takes from the force of the dashpots of a vertex [N] what the joint does not bear: an open one has none, and along the face
/// friction bounds springs and dashpots together.
template <laws::DilatesBySlip Law>
void limit_dashpots(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, std::size_t v, LaneVector& force) {
  const auto i = static_cast<int>(v);
  const LaneMask is_open = at.opening[i] > at.peak[i];
  for (int axis = 0; axis < 3; ++axis) force[axis] = select(is_open, Lanes{}, force[axis]);
  const LaneVector borne = at.vertex_area * at.stress[v];
  const Lanes x = borne[1] - force[1], y = borne[2] - force[2], least = least_strength(kind.shear, -borne[0]);
  const LaneMask may_be_over = x * x + y * y > least * least;
  if (!any(may_be_over)) return;
  for (int lane = 0; lane < lane_count; ++lane) {
    if (may_be_over[lane] == 0) continue;
    const auto rough = lane_of<typename Law::template Shear<Real>>(kind.shear, lane);
    const Real strength = at.vertex_area[lane] * rough_strength(rough, -at.stress[v][0][lane],
                                                                laws::mobilised_roughness(at.path[i][lane] / rough.peak_slip));
    const Real share = laws::damping_share({borne[1][lane], borne[2][lane]}, {-force[1][lane], -force[2][lane]}, strength);
    force[1][lane] *= share;
    force[2][lane] *= share;
  }
}

/// What slips and parts, and the stress that remains; returns which joints have parted.
template <laws::DilatesBySlip Law>
LaneMask change_joints(const JointParameters<Law, Lanes>& kind, const LaneVector&, const LaneVector& strength, const LaneMask&,
                       LaneVector& stress, FaceGeometry& at, JointChange& change) {
  change.slipped = change.sheared = LaneMask{};
  change.slip_work = change.released = change.opening_fracture = change.shear_fracture = Lanes{};
  for (int v = 0; v < vertex_count; ++v) {
    const auto& shear = at.shear[static_cast<std::size_t>(v)];
    const LaneMask may_slip = slips(kind.shear, laws::Slip<Lanes>{{shear[0], shear[1]}, {}, {}}, strength[v]);
    slide(kind, v, may_slip, stress, at, change);
  }
  change.peak = at.peak;
  change.path = at.path;
  change.failed = parts(kind, at);
  if (any(change.failed)) change.released = select(change.failed, elastic_energy(kind, at, stress), Lanes{});
  change.softened = change.slipped | change.failed;
  return change.failed;
}

}  // namespace sazare::methods::blocks
