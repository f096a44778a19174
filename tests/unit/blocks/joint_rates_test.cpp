#include "sazare/methods/blocks/rates/joint_rates.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/support/bonded_pair.hpp"

namespace sazare::methods::blocks {
namespace {

using sazare::test::BondedPair;

/// Change of the force on a block per displacement (or velocity) of its own six freedoms, in world axes, by differences
/// of the forces of the joint itself.
template <class Disturb>
Matrix6 response(Index body, Real step, Disturb&& disturb) {
  Matrix6 matrix;
  for (int freedom = 0; freedom < 6; ++freedom) {
    const auto force = [&](Real by) {
      BondedPair pair;
      disturb(pair.bodies().motion[static_cast<std::size_t>(body)], freedom, by);
      const auto given = pair.forces()[static_cast<std::size_t>(body)];
      return (Eigen::Matrix<Real, 6, 1>() << given.linear, given.angular).finished();
    };
    matrix.col(freedom) = -(force(step) - force(-step)) / (2 * step);
  }
  return matrix;
}

void displace(state::Motion<3>& motion, int freedom, Real by) {
  if (freedom < 3) {
    motion.position[freedom] += by;
    return;
  }
  motion.rotation = Eigen::AngleAxis<Real>(by, Vector3::Unit(freedom - 3)).toRotationMatrix() * motion.rotation;
}

void push(state::Motion<3>& motion, int freedom, Real by) { (freedom < 3 ? motion.velocity : motion.spin)[freedom % 3] = by; }

Real largest(const Matrix6& matrix, const state::Bodies<3>& bodies, Index body, std::vector<int> free) {
  const auto& inertia = bodies.inertia[static_cast<std::size_t>(body)];
  const Matrix3 rotation = bodies.motion[static_cast<std::size_t>(body)].rotation;
  Matrix6 mass = Matrix6::Zero();
  mass.topLeftCorner<3, 3>().diagonal().setConstant(inertia.mass);
  mass.bottomRightCorner<3, 3>() = rotation * inertia.inverse_moments.cwiseInverse().asDiagonal() * rotation.transpose();
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd k(n, n), m(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      k(i, j) = matrix(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
      m(i, j) = mass(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
    }
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(k, m).eigenvalues().maxCoeff();
}

TEST(joint_rates, are_the_largest_eigenvalues_of_what_the_block_feels) {
  BondedPair pair;
  for (const Index body : {0, 1}) {
    const auto rates = pair.joints().rates(body);
    const Matrix6 stiffness = response(body, 1e-9, displace), damping = response(body, 1e-3, push);
    // The master's force acts at the slave's vertices: its own turning moves no point, to first order the same matrix.
    EXPECT_NEAR(rates.stiffness, largest(stiffness, pair.bodies(), body, {0, 1, 2, 3, 4, 5}), 1e-5 * rates.stiffness);
    // Joints round places on the slave to single precision.
    EXPECT_NEAR(rates.damping, largest(damping, pair.bodies(), body, {0, 1, 2, 3, 4, 5}), 1e-7 * rates.damping);
  }
}

/// All processes must find the same rates, but only those that evaluate a joint know how far it has slipped.
TEST(joint_rates, are_those_of_the_beginning_however_far_a_joint_has_slipped) {
  BondedPair pair;
  JointRecord joint = pair.joints().record(0);
  const ElasticJoint& kind = pair.joints().elastic(0);
  const FaceSprings before = face_springs(joint, kind, joint.master, pair.bodies());
  const auto axes = face_axes(joint.normal, joint.tilt);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Vector3& corner = joint.vertex[v].corner;
    const Vector3 own = corner[0] * axes[0] + corner[1] * axes[1] + corner[2] * axes[2];
    EXPECT_LT((before.corners[v] - own).norm(), 1e-6 * own.norm());
    joint.vertex[v].corner[1] += 0.1 * own.norm();
  }
  const FaceSprings after = face_springs(joint, kind, joint.master, pair.bodies());
  for (std::size_t v = 0; v < vertex_count; ++v) EXPECT_EQ(after.corners[v], before.corners[v]);
}

TEST(joint_rates, leave_out_what_is_locked) {
  BondedPair pair;
  FaceSprings face;
  const auto& motion = pair.bodies().motion[1];
  const auto mesh = sazare::test::two_blocks();
  for (std::size_t corner = 0; corner < 3; ++corner)
    face.corners[corner] = motion.rotation.transpose() * (mesh.nodes[corner] - motion.position);
  face.corner_area = pair.area() / 3;
  face.normal_stiffness = 450e9;
  face.shear_stiffness = 90e9;
  BodyMatrices matrices;
  add_face(matrices, face);
  const Matrix6 stiffness = response(1, 1e-9, displace);
  const auto& bodies = pair.bodies();
  const auto rates_with_locks = [&](state::Locks locks) {
    state::Bodies<3> locked = bodies;
    locked.locks[1] = locks;
    return largest_rates(matrices, locked, 1);
  };
  const auto locked = rates_with_locks({0b001, 0b110});
  EXPECT_NEAR(locked.stiffness, largest(stiffness, bodies, 1, {1, 2, 3}), 1e-5 * locked.stiffness);
  EXPECT_LT(locked.stiffness, pair.joints().rates(1).stiffness);
  EXPECT_EQ(rates_with_locks({0b111, 0b111}).stiffness, 0);
}

}  // namespace
}  // namespace sazare::methods::blocks
