#include "sazare/methods/blocks/run/check/initial_stress.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <set>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"

namespace sazare::runs {

namespace {

constexpr Real beyond_round_off = 1 + 1e-6;

/// Stress over strength at the corners of a face, the worst.
Real overstress(const cases::Joint& joint, const methods::blocks::JointFace& face) {
  const Vector3 normal = area_vector(face.corners).normalized();
  Real worst = 0;
  for (const Vector3& traction : face.traction) {
    const Real across = normal.dot(traction), along = (traction - across * normal).norm();
    const Real shear_strength = joint.cohesion - joint.friction_coefficient * across;
    worst = std::max(worst, across / joint.tensile_strength);
    if (along > 0) worst = std::max(worst, shear_strength > 0 ? along / shear_strength : std::numeric_limits<Real>::infinity());
  }
  return worst;
}

/// A principal stress at the place of the mesh where it is largest, and one where it is smallest [Pa].
std::pair<Real, Real> stress_range(const laws::LinearStress& stress, const geometry::TetraMesh& mesh) {
  Real lowest = std::numeric_limits<Real>::infinity(), highest = -lowest;
  for (const Vector3& node : mesh.nodes) {
    const Vector3 principal = Eigen::SelfAdjointEigenSolver<Matrix3>(stress.at(node), Eigen::EigenvaluesOnly).eigenvalues();
    lowest = std::min(lowest, principal.minCoeff());
    highest = std::max(highest, principal.maxCoeff());
  }
  return {lowest, highest};
}

}  // namespace

std::vector<OverstressedFaces> find_overstressed(const cases::BlocksCase& blocks, const CaseKinds& kinds,
                                                 const std::vector<methods::blocks::JointFace>& faces) {
  std::vector<OverstressedFaces> found(blocks.joints.size());
  if (blocks.initial_stress.is_zero()) return found;
  for (const methods::blocks::JointFace& face : faces) {
    const std::size_t entry = at(kinds.entry[at(face.kind)]);
    const Real worst = overstress(blocks.joints[entry].scaled(kinds.factor[at(face.kind)]), face);
    if (worst < beyond_round_off) continue;
    ++found[entry].faces;
    found[entry].worst = std::max(found[entry].worst, worst);
  }
  return found;
}

StartBalance find_balance(const cases::BlocksCase& blocks, const MeshFaces& faces, const state::Bodies<3>& bodies,
                          const std::vector<methods::blocks::OuterFace>& boundaries) {
  StartBalance balance;
  const laws::LinearStress stress = blocks.stress_at_start();
  if (stress.is_zero()) return balance;
  const auto add = [&](const Vector3& force) {
    balance.resultant += force;
    balance.largest += force.norm();
  };
  for (const methods::blocks::OuterFace& face : boundaries)
    add(face.springs.corner_area * (face.traction[0] + face.traction[1] + face.traction[2]));
  for (const auto& inertia : bodies.inertia) add(inertia.mass * blocks.gravity.acceleration);
  std::set<std::pair<Index, int>> carried;
  for (const cases::Boundary& boundary : blocks.boundaries)
    for (const geometry::OuterFace& outer : faces.outer(boundary.surface)) carried.insert({outer.element, outer.face});
  for (const geometry::OuterFace& outer : faces.map.outer) {
    if (carried.contains({outer.element, outer.face})) continue;
    const auto corners = face_corners(faces.mesh, outer.nodes);
    const Real traction = (stress.at((corners[0] + corners[1] + corners[2]) / 3) * area_vector(corners).normalized()).norm();
    if (traction > 0) ++balance.unloaded;
    balance.unloaded_stress = std::max(balance.unloaded_stress, traction);
  }
  return balance;
}

std::string warn_of_initial_stress(const cases::CaseFile& file, const std::vector<OverstressedFaces>& overstressed,
                                   const StartBalance& balance) {
  constexpr Real noticeable = 0.01;
  const cases::BlocksCase& blocks = file.as<cases::BlocksCase>();
  std::string all;
  for (std::size_t joint = 0; joint < overstressed.size(); ++joint)
    if (const auto& [faces, worst] = overstressed[joint]; faces > 0)
      all += warning(
          file, "initial_stress",
          fmt::format("the initial stress is beyond the strength of {} faces of the joint \"{}\", by a factor of up to {}: "
                      "they open or slip at once",
                      faces, blocks.joints[joint].name, cases::short_number(worst, 3)),
          "lower the stress, or give the joint the strength of ground that has carried it");
  const bool is_held = std::ranges::any_of(blocks.constraints, [](const cases::Constraint& constraint) {
    return std::ranges::any_of(constraint.translation, [](bool locked) { return locked; });
  });
  if (!is_held && balance.resultant.norm() > noticeable * balance.largest)
    all += warning(
        file, "initial_stress",
        fmt::format("the initial stress is not in equilibrium: what boundaries and gravity do to the body leaves a force of {} N",
                    cases::vector_text(balance.resultant)),
        "give the outer faces that cut through stressed ground a boundary, and let the stress grow with depth as the weight "
        "does: "
        "k0, or a vertical normal_stress_per_depth of minus density times gravity");
  return all;
}

std::string explain_initial_stress(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                                   const StartBalance& balance) {
  if (blocks.initial_stress.is_zero()) return "";
  const auto [lowest, highest] = stress_range(blocks.stress_at_start(), mesh);
  std::string text = cases::line(
      "stress", fmt::format("at the beginning {} to {} Pa, tension positive", cases::number(lowest), cases::number(highest)));
  if (balance.unloaded > 0)
    text += cases::line("", fmt::format("{} are free and lose it at once, up to {} Pa",
                                        cases::counted(balance.unloaded, "outer faces"), cases::number(balance.unloaded_stress)));
  return text;
}

}  // namespace sazare::runs
