#include "sazare/methods/blocks/run/joints/element_springs.hpp"

#include <cmath>

namespace sazare::runs {

namespace {

using methods::blocks::JointFace;
using methods::blocks::JointSprings;

Vector3 area_vector(const JointFace& face) {
  return 0.5 * (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
}

/// Distance of the centre of an element from the plane of a face [m].
Real distance_from(const JointFace& face, const Vector3& centre) {
  return std::abs(area_vector(face).normalized().dot(centre - face.corners[0]));
}

Real distance_of_centres(const JointFace& face, const state::Bodies<3>& bodies) {
  return distance_from(face, bodies.motion[at(face.master)].position) +
         distance_from(face, bodies.motion[at(face.slave)].position);
}

/// Stiffness per area of the two elements beside a face in series.
laws::SpringModuli stiffness_between(const cases::BlocksCase& blocks, const std::vector<Index>& material,
                                     const state::Bodies<3>& bodies, const JointFace& face) {
  laws::SpringModuli compliance;  // [m/Pa]
  for (const Index element : {face.master, face.slave}) {
    const auto modulus = blocks.materials[at(material[at(element)])].springs();
    const Real distance = distance_from(face, bodies.motion[at(element)].position);
    compliance.normal += distance / modulus.normal;
    compliance.shear += distance / modulus.shear;
  }
  return {1 / compliance.normal, 1 / compliance.shear};
}

Real dashpot(Real ratio, Real stiffness, Real mass_per_area) { return 2 * ratio * std::sqrt(stiffness * mass_per_area); }

/// Puts in the dashpots of a joint on given springs.
template <class Springs>
void set_dashpots(const cases::Joint& joint, Real mass_per_area, Springs& springs) {
  springs.normal_damping =
      joint.damping_ratio ? dashpot(*joint.damping_ratio, springs.normal_stiffness, mass_per_area) : joint.normal_damping;
  springs.shear_damping =
      joint.damping_ratio ? dashpot(*joint.damping_ratio, springs.shear_stiffness, mass_per_area) : joint.shear_damping;
}

}  // namespace

void add_own_springs(const cases::BlocksCase& blocks, const std::vector<Index>& material, const state::Bodies<3>& bodies,
                     std::vector<JointFace>& faces) {
  for (JointFace& face : faces) {
    const cases::Joint& joint = blocks.joints[at(face.kind)];
    if (!joint.depends_on_elements()) continue;
    const auto stiffness = joint.has_stiffness() ? laws::SpringModuli{*joint.normal_stiffness, *joint.shear_stiffness}
                                                 : stiffness_between(blocks, material, bodies, face);
    const Real first = bodies.inertia[at(face.master)].mass, second = bodies.inertia[at(face.slave)].mass;
    JointSprings& own = face.own.emplace(JointSprings{stiffness.normal, stiffness.shear});
    set_dashpots(joint, first * second / (first + second) / area_vector(face).norm(), own);
  }
}

methods::blocks::FaceSprings ground_springs(cases::BoundaryKind kind, const OnGround& element) {
  const auto& [material, joint, distance, mass_per_area] = element;
  methods::blocks::FaceSprings springs;
  if (kind == cases::BoundaryKind::absorbing) {
    if (material.has_moduli()) {
      springs.normal_damping = std::sqrt(material.moduli().confined() * material.density);
      springs.shear_damping = std::sqrt(material.moduli().shear() * material.density);
    } else {  // rho c with c^2 = k H / rho: the joints are the only compliance, H of them is twice the distance
      springs.normal_damping = std::sqrt(*joint.normal_stiffness * (2 * distance) * material.density);
      springs.shear_damping = std::sqrt(*joint.shear_stiffness * (2 * distance) * material.density);
    }
    return springs;
  }
  if (joint.has_stiffness()) {
    springs.normal_stiffness = *joint.normal_stiffness;
    springs.shear_stiffness = *joint.shear_stiffness;
  } else {
    const auto modulus = material.springs();
    springs.normal_stiffness = modulus.normal / distance;
    springs.shear_stiffness = modulus.shear / distance;
  }
  set_dashpots(joint, mass_per_area, springs);
  if (kind == cases::BoundaryKind::frictionless) springs.shear_stiffness = springs.shear_damping = 0;
  return springs;
}

std::vector<SoftestFaces> find_softest_faces(const cases::BlocksCase& blocks, const state::Bodies<3>& bodies,
                                             const std::vector<JointFace>& faces) {
  std::vector<SoftestFaces> softest(blocks.joints.size());
  for (const JointFace& face : faces) {
    if (!face.own || blocks.joints[at(face.kind)].has_stiffness()) continue;
    SoftestFaces& of = softest[at(face.kind)];
    if (of.faces == 0 || face.own->normal_stiffness < of.normal_stiffness) {
      of.normal_stiffness = face.own->normal_stiffness;
      of.normal_distance = distance_of_centres(face, bodies);
    }
    if (of.faces == 0 || face.own->shear_stiffness < of.shear_stiffness) {
      of.shear_stiffness = face.own->shear_stiffness;
      of.shear_distance = distance_of_centres(face, bodies);
    }
    ++of.faces;
  }
  return softest;
}

}  // namespace sazare::runs
