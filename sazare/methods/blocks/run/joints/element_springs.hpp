#pragma once

/// Springs and dashpots that faces get from the elements beside them, for materials that give Young's modulus and Poisson's
/// ratio.
///
///     1/k = d_i/K_i + d_j/K_j       d     distance of an element's centre from the face [m]
///     1/k = d/K to ground           K     its spring modulus across or along the face [Pa], laws/block_elasticity.hpp
///     c = 2 h sqrt(k m)             h     damping ratio of the joint
///     1/m = A/m_i + A/m_j           m_i   mass [kg];  A  area of the face [m2]
///
/// Each element has its own part of a spring, from its centre to the face. So elements of any two sizes and materials go
/// together, and ground holds an outer face where it is, instead of a centre behind it.

#include <vector>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/rates/joint_rates.hpp"

namespace sazare::runs {

/// Gives faces their springs and dashpots where their joint says that the elements beside them do.
void add_own_springs(const cases::BlocksCase& blocks, const std::vector<Index>& material, const state::Bodies<3>& bodies,
                     std::vector<methods::blocks::JointFace>& faces);

/// An element on ground of its own material.
struct OnGround {
  const cases::Material& material;
  const cases::Joint& own_joint;  ///< that the material has with itself
  Real distance = 0;              ///< of the element's centre from the outer face [m]
  Real mass_per_area = 0;         ///< of the element [kg/m2]
};

/// Springs and dashpots per area between an outer face and the ground, which is immobile or lets waves pass.
methods::blocks::FaceSprings ground_springs(cases::BoundaryKind kind, const OnGround& element);

/// Joints of an entry of [[joints]] whose springs follow from the elements: the softest of its faces, which soften first.
struct SoftestFaces {
  Index faces = 0;            ///< of the entry
  Real normal_stiffness = 0;  ///< smallest [Pa/m]
  Real normal_distance = 0;   ///< of the centres beside that face, along its normal [m]
  Real shear_stiffness = 0;   ///< smallest [Pa/m]
  Real shear_distance = 0;    ///< of the centres beside the face of that smallest stiffness, along its normal [m]
};

/// By entry of [[joints]]; those that give their own stiffness are left out, with no faces.
std::vector<SoftestFaces> find_softest_faces(const cases::BlocksCase& blocks, const state::Bodies<3>& bodies,
                                             const std::vector<methods::blocks::JointFace>& faces);

}  // namespace sazare::runs
