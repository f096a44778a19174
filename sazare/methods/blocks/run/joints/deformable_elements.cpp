#include "sazare/methods/blocks/run/joints/deformable_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::runs {

namespace {

constexpr Real corners_over_whole = 5;  // second moments of four masses at the corners over those of a tetrahedron

/// Which faces of every element yield by springs that follow from the elements: joints without a stiffness of their own, and
/// faces that the ground holds as such joints do. A free face, one that is pressed and one that only touches another yield
/// nothing.
std::vector<std::array<bool, 4>> yielding_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                const std::vector<Index>& material,
                                                const std::vector<methods::blocks::JointFace>& joints) {
  std::vector<std::array<bool, 4>> yields(material.size(), {false, false, false, false});
  for (const methods::blocks::JointFace& joint : joints) {
    if (blocks.joints[at(joint.kind)].has_stiffness()) continue;
    yields[at(joint.master)][at(joint.master_face)] = true;
    yields[at(joint.slave)][at(joint.slave_face)] = true;
  }
  for (const cases::Boundary& boundary : blocks.boundaries) {
    if (boundary.kind == cases::BoundaryKind::absorbing) continue;
    for (const geometry::OuterFace& outer : faces.outer(boundary.surface))
      yields[at(outer.element)][at(outer.face)] = !own_joint(blocks, material[at(outer.element)]).has_stiffness();
  }
  return yields;
}

/// What the halves of the joints of an element yield, in its body frame.
Matrix6 compliance_of_joints(const geometry::Tetrahedron& corners, const Matrix3& rotation, const std::array<bool, 4>& yields,
                             const laws::SpringModuli& springs) {
  const Vector3 middle = geometry::centroid(corners);
  const Real volume = geometry::volume(corners);
  std::vector<laws::YieldingFace> faces;
  for (std::size_t face = 0; face < 4; ++face) {
    if (!yields[face]) continue;
    const auto& [a, b, c] = geometry::tetrahedron_faces[face];
    const Vector3 area = area_vector({corners[at(a)], corners[at(b)], corners[at(c)]});
    const Real distance = std::abs(area.normalized().dot(corners[at(a)] - middle));
    faces.push_back({rotation.transpose() * area.normalized(), area.norm() * distance / volume});
  }
  return laws::joint_compliance(faces, springs);
}

/// Relaxation time of the damping that gives a wave in the element itself this ratio [s].
Real relaxation_time(Real ratio, const laws::ElasticModuli& moduli, Real volume, const state::Strain& strain) {
  return 2 * ratio / std::sqrt(volume * moduli.confined() * strain.inverse_inertia);
}

}  // namespace

void add_strains(const cases::BlocksCase& blocks, const std::vector<Index>& material, state::Bodies<3>& bodies) {
  if (std::ranges::none_of(blocks.materials, &cases::Material::deformable)) return;
  bodies.strain.resize(at(bodies.size()));
  for (std::size_t body = 0; body < bodies.strain.size(); ++body) {
    if (!blocks.materials[at(material[body])].deformable) continue;
    Vector3& inverse = bodies.inertia[body].inverse_moments;
    inverse /= corners_over_whole;
    bodies.strain[body].inverse_inertia = 6 / inverse.cwiseInverse().sum();  // a tensor of inertia has twice the trace of J
  }
}

std::vector<methods::blocks::DeformableElement> make_elements(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                              const std::vector<Index>& material, const state::Bodies<3>& bodies,
                                                              const std::vector<methods::blocks::JointFace>& joints) {
  std::vector<methods::blocks::DeformableElement> made;
  const auto yields = yielding_faces(blocks, faces, material, joints);
  const laws::LinearStress stress = blocks.stress_at_start();
  for (std::size_t body = 0; body < material.size(); ++body) {
    const cases::Material& of = blocks.materials[at(material[body])];
    if (!of.deformable) continue;
    const auto corners = geometry::corners_of(faces.mesh, static_cast<Index>(body));
    const Matrix3& rotation = bodies.motion[body].rotation;
    methods::blocks::DeformableElement element;
    element.body = static_cast<Index>(body);
    element.volume = geometry::volume(corners);
    element.stiffness = laws::element_stiffness(of.moduli(), compliance_of_joints(corners, rotation, yields[body], of.springs()));
    element.bulk_modulus = of.moduli().bulk();
    element.stress_at_start = numbers_of(rotation.transpose() * stress.at(geometry::centroid(corners)) * rotation);
    element.relaxation_time = relaxation_time(of.bulk_damping_ratio, of.moduli(), element.volume, bodies.strain[body]);
    made.push_back(element);
  }
  return made;
}

}  // namespace sazare::runs
