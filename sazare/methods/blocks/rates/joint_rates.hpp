#pragma once

/// What binds the step of a block whose neighbours are held: the largest eigenvalues of M^-1 K and M^-1 C of its six
/// freedoms, from its own joints.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sazare/levels/terms/term.hpp"
#include "sazare/methods/blocks/joint_kinds.hpp"
#include "sazare/methods/blocks/strength_by_rate.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::methods::blocks {

/// A face to be bonded.
struct JointFace {
  Index master = 0;
  Index slave = 0;
  Index kind = 0;
  int master_face = 0;  ///< local faces 0..3
  int slave_face = 0;
  std::array<Vector3, 3> corners;                  ///< counter-clockwise seen from outside the master [m]
  std::optional<JointSprings> own = std::nullopt;  ///< instead of the springs and dashpots of its kind
  JointRate rate = {};                             ///< how its strength follows the rate of loading
  std::array<Vector3, 3> traction = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};  ///< initial, on the master [Pa]
};

/// What a face is before anything has happened to it.
inline ElasticJoint elastic_joint(std::span<const ElasticJoint> kinds, const JointFace& face) {
  const ElasticJoint& kind = kinds[static_cast<std::size_t>(face.kind)];
  return face.own ? kind.with(*face.own) : kind;
}

/// A symmetric matrix of the freedoms of one block, in its body frame: three translations and three rotations about its centre,
/// and where it is strained the six numbers of its strain.
struct FreedomMatrix {
  using Block = Eigen::Matrix<Real, 6, 6>;

  Block rigid = Block::Zero();
  Block between = Block::Zero();  ///< rows of the motion, columns of the strain
  Block strain = Block::Zero();
};

/// Stiffness and damping of one block.
struct BodyMatrices {
  bool is_strained = false;
  FreedomMatrix stiffness, damping;
};

/// Springs and dashpots per area on the corners of one face.
struct FaceSprings {
  std::array<Vector3, 3> corners;  ///< in the body frame [m]
  Real corner_area = 0;            ///< a third of the face [m2]
  Real normal_stiffness = 0;       ///< [Pa/m]
  Real shear_stiffness = 0;        ///< [Pa/m]
  Real normal_damping = 0;         ///< [Pa s/m]
  Real shear_damping = 0;          ///< [Pa s/m]
};

void add_face(BodyMatrices& matrices, const FaceSprings& face);

/// The springs of a joint as one of its two bodies has them at the beginning. The corners are those that the joint keeps on its
/// slave: slip moves those on the master, and only the processes that evaluate the joint know it.
FaceSprings face_springs(const JointRecord& joint, const ElasticJoint& kind, Index body, const state::Bodies<3>& bodies);

/// Rates of every body from the faces that are to be bonded.
std::vector<terms::Rates> joint_rates(std::span<const ElasticJoint> kinds, std::span<const JointFace> faces,
                                      const state::Bodies<3>& bodies);

/// Freedoms locked in world axes are left out; those of the strain are all there.
terms::Rates largest_rates(const BodyMatrices& matrices, const state::Bodies<3>& bodies, Index body);

}  // namespace sazare::methods::blocks
