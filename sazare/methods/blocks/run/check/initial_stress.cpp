#include "sazare/methods/blocks/run/check/initial_stress.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/levels/terms/face_pressure.hpp"

namespace sazare::runs {

namespace {

constexpr Real round_off = 1e-6;

/// Stress over strength, which may be 0.
Real ratio_of(Real stress, Real strength) {
  if (stress <= 0) return 0;
  return strength > 0 ? stress / strength : std::numeric_limits<Real>::infinity();
}

/// The shear strength with which a joint begins under a normal stress, tension positive [Pa].
Real shear_strength_of(const cases::Joint& joint, Real normal_stress) {
  if (!joint.is_natural()) return joint.cohesion - joint.friction_coefficient * normal_stress;
  return std::visit(
      [&]<class Law>(const methods::blocks::JointParameters<Law, Real>& kind) {
        if constexpr (laws::DilatesBySlip<Law>)
          return rough_strength(kind.shear, std::max(-normal_stress, Real{0}), laws::mobilised_roughness(0));
        return Real{0};
      },
      make_joint_kind(joint));
}

/// Stress over strength at the corners of a face, the worst.
Real overstress(const cases::Joint& joint, const methods::blocks::JointFace& face) {
  const Vector3 normal = area_vector(face.corners).normalized();
  Real worst = 0;
  for (const Vector3& traction : face.traction) {
    const Real across = normal.dot(traction), along = (traction - across * normal).norm();
    const Real tension = across > round_off * along ? across : 0;
    worst = std::max({worst, ratio_of(tension, joint.tensile_strength), ratio_of(along, shear_strength_of(joint, across))});
  }
  return worst;
}

/// A force in words, without what of it is round-off.
std::string force_text(const Vector3& force, Real largest) {
  return cases::vector_text((force.array().abs() > 1e-9 * largest).select(force, Vector3::Zero()));
}

/// What presses on a surface when the run begins [Pa]: a table that does not start at 0.
Real pressure_at_start(const cases::Blast& blast) {
  const auto* table = std::get_if<cases::PressureTable>(&blast.pressure);
  return table ? laws::table_pressure({table->time, table->pressure}, -blast.delay) : 0;
}

/// Pressures on outer faces when the run begins [Pa].
std::map<std::pair<Index, int>, Real> pressures_at_start(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  std::map<std::pair<Index, int>, Real> found;
  for (const cases::Blast& blast : blocks.blasts)
    if (const Real pressure = pressure_at_start(blast); pressure != 0)
      for (const geometry::OuterFace& outer : faces.outer(blast.surface)) found[{outer.element, outer.face}] += pressure;
  return found;
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
    if (worst < 1 + round_off) continue;
    ++found[entry].faces;
    found[entry].worst = std::max(found[entry].worst, worst);
  }
  return found;
}

bool StartBalance::is_in_equilibrium() const {
  constexpr Real noticeable = 0.01;
  const bool balances = unbalanced.norm() <= noticeable * (weight > 0 ? weight : largest);
  return balances && lost.norm() <= noticeable * largest;
}

StartBalance find_balance(const cases::BlocksCase& blocks, const MeshFaces& faces, const state::Bodies<3>& bodies,
                          const std::vector<methods::blocks::FreeFace>& free_faces) {
  StartBalance balance;
  const laws::LinearStress stress = blocks.stress_at_start();
  if (stress.is_zero()) return balance;
  for (const auto& inertia : bodies.inertia) balance.unbalanced += inertia.mass * blocks.gravity.acceleration;
  balance.weight = balance.unbalanced.norm();
  std::map<std::pair<Index, int>, cases::BoundaryKind> boundaries;
  for (const cases::Boundary& boundary : blocks.boundaries)
    for (const geometry::OuterFace& outer : faces.outer(boundary.surface))
      boundaries[{outer.element, outer.face}] = boundary.kind;
  std::set<std::pair<Index, int>> outer_faces;
  for (const geometry::OuterFace& outer : faces.map.outer) outer_faces.insert({outer.element, outer.face});
  const auto pressures = pressures_at_start(blocks, faces);
  for (const methods::blocks::FreeFace& face : free_faces) {
    const auto corners = geometry::corners_of(faces.mesh, face.body);
    const auto& [a, b, c] = geometry::tetrahedron_faces[at(face.face)];
    const std::array<Vector3, 3> own = {corners[at(a)], corners[at(b)], corners[at(c)]};
    const Vector3 area = area_vector(own), normal = area.normalized();
    const Vector3 traction = stress.at((own[0] + own[1] + own[2]) / 3) * normal;
    if (outer_faces.contains({face.body, face.face})) {
      balance.unbalanced += area.norm() * traction;
      balance.largest += area.norm() * traction.norm();
    }
    const auto boundary = boundaries.find({face.body, face.face});
    const auto pressure = pressures.find({face.body, face.face});
    const Vector3 left = pressure == pressures.end() ? traction : Vector3(traction + pressure->second * normal);
    const Vector3 lost = boundary == boundaries.end() ? left : Vector3(left - carried(boundary->second, normal, left));
    if (lost.norm() <= round_off * traction.norm()) continue;
    ++balance.unloaded;
    balance.lost += area.norm() * lost;
    balance.unloaded_stress = std::max(balance.unloaded_stress, lost.norm());
  }
  if (blocks.initial_stress.k0)
    for (const Vector3& node : faces.mesh.nodes) balance.above_datum = std::max(balance.above_datum, -stress.depth(node));
  return balance;
}

std::string warn_of_initial_stress(const cases::CaseFile& file, const std::vector<OverstressedFaces>& overstressed,
                                   const StartBalance& balance) {
  const cases::BlocksCase& blocks = file.as<cases::BlocksCase>();
  std::string all;
  for (std::size_t joint = 0; joint < overstressed.size(); ++joint)
    if (const auto& [faces, worst] = overstressed[joint]; faces > 0) {
      const bool is_natural = blocks.joints[joint].is_natural();
      all += warning(
          file, "initial_stress",
          fmt::format("the initial stress is beyond the {} of {} faces of the joint \"{}\"{}: they open or slip {}",
                      is_natural ? "residual friction, with which a natural joint begins," : "strength", faces,
                      blocks.joints[joint].name,
                      std::isfinite(worst) ? fmt::format(", by a factor of up to {}", cases::short_number(worst, 3)) : "",
                      blocks.settles() ? "while the body settles" : "at once"),
          is_natural ? "lower the shear stress: slip mobilises the roughness of the joint, dilates it and changes the stress"
                     : "lower the stress, or give the joint the strength of ground that has carried it");
    }
  if (balance.above_datum > 0)
    all += warning(
        file, "initial_stress.k0",
        fmt::format("the body reaches {} m above the datum, and begins in tension there", cases::number(balance.above_datum)),
        "set datum to the height of the surface of the ground");
  const bool is_held = std::ranges::any_of(blocks.constraints, [](const cases::Constraint& constraint) {
    return std::ranges::any_of(constraint.translation, [](bool locked) { return locked; });
  });
  if (!is_held && !blocks.settles() && !balance.is_in_equilibrium())
    all += warning(
        file, "initial_stress",
        fmt::format(
            "the initial stress is not in equilibrium: stress and weight leave a force of {} N, and {} N act on faces without a "
            "boundary that carries them",
            force_text(balance.unbalanced, balance.largest), force_text(balance.lost, balance.largest)),
        "let the stress grow with depth as the weight does, by k0 or a vertical normal_stress_per_depth of minus density times "
        "gravity, and give outer faces that cut through stressed ground a boundary; or add settle = true to [initial_stress], "
        "which "
        "lets the body find its equilibrium first");
  return all;
}

std::string explain_initial_stress(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                                   const StartBalance& balance) {
  if (blocks.initial_stress.is_zero()) return "";
  const auto [lowest, highest] = stress_range(blocks.stress_at_start(), mesh);
  std::string text = cases::line(
      "stress", fmt::format("at the beginning {} to {} Pa, tension positive", cases::number(lowest), cases::number(highest)));
  if (balance.unloaded > 0)
    text += cases::line(
        "", fmt::format("{} that nothing carries lose it {}, up to {} Pa", cases::counted(balance.unloaded, "faces"),
                        blocks.settles() ? "while the body settles" : "at once", cases::number(balance.unloaded_stress)));
  return text;
}

}  // namespace sazare::runs
