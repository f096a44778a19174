#include "sazare/methods/blocks/rates/joint_rates.hpp"

#include <Eigen/Eigenvalues>

#include "sazare/core/time.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

using Freedoms = Eigen::Matrix<Real, 6, Eigen::Dynamic, 0, 6, 6>;
using FreeMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

/// Directions in which the body may move, as columns in its body frame.
Freedoms free_directions(const Matrix3& rotation, state::Locks locks) {
  Freedoms free(6, 0);
  for (int axis = 0; axis < 6; ++axis) {
    const int locked = axis < 3 ? locks.translation >> axis : locks.rotation >> (axis - 3);
    if (locked & 1) continue;
    free.conservativeResize(6, free.cols() + 1);
    free.rightCols(1).setZero();
    free.rightCols(1).block<3, 1>(axis < 3 ? 0 : 3, 0) = rotation.transpose().col(axis % 3);
  }
  return free;
}

Real largest_eigenvalue(const FreeMatrix& matrix, const FreeMatrix& mass) {
  if (matrix.rows() == 0 || matrix.squaredNorm() == 0) return 0;
  const Eigen::GeneralizedSelfAdjointEigenSolver<FreeMatrix> solver(matrix, mass, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  return solver.eigenvalues().maxCoeff();
}

/// Springs of a kind over an area, their corners still to be set.
FaceSprings springs_of(const ElasticJoint& kind, Real corner_area) {
  return {{}, corner_area, kind.normal_stiffness, kind.shear_stiffness, kind.normal_damping, kind.shear_damping};
}

}  // namespace

void add_face(BodyMatrices& matrices, const FaceSprings& face) {
  const auto& c = face.corners;
  const Vector3 normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  const Matrix3 across = normal * normal.transpose();
  const Matrix3 along = Matrix3::Identity() - across;
  const Matrix3 stiffness = face.corner_area * (face.normal_stiffness * across + face.shear_stiffness * along);
  const Matrix3 damping = face.corner_area * (face.normal_damping * across + face.shear_damping * along);
  for (const Vector3& corner : c) {
    Eigen::Matrix<Real, 3, 6> moves;  // velocity of the corner from velocity and spin
    moves.leftCols<3>().setIdentity();
    moves.rightCols<3>() << 0, corner.z(), -corner.y(), -corner.z(), 0, corner.x(), corner.y(), -corner.x(), 0;
    matrices.stiffness.rigid += moves.transpose() * stiffness * moves;
    matrices.damping.rigid += moves.transpose() * damping * moves;
    if (!matrices.is_strained) continue;
    Eigen::Matrix<Real, 3, 6> strains;  // and from the rate of the strain
    for (int i = 0; i < 6; ++i) strains.col(i) = tensor_of(Vector6::Unit(i)) * corner;
    const auto add = [&](FreedomMatrix& to, const Matrix3& of) {
      to.between += moves.transpose() * of * strains;
      to.strain += strains.transpose() * of * strains;
    };
    add(matrices.stiffness, stiffness);
    add(matrices.damping, damping);
  }
}

FaceSprings face_springs(const JointRecord& joint, const ElasticJoint& kind, Index body, const state::Bodies<3>& bodies) {
  FaceSprings face = springs_of(kind, joint.vertex_area);
  const auto start = [&](Index of) -> const Vector3& { return bodies.start[static_cast<std::size_t>(of)]; };
  for (std::size_t v = 0; v < vertex_count; ++v) {
    face.corners[v] = joint.arm_of(v);
    if (body == joint.slave) continue;
    const Vector3 place = start(joint.slave) + state::start_rotation(bodies, joint.slave) * joint.arm_of(v);
    face.corners[v] = state::start_rotation(bodies, body).transpose() * (place - start(body));
  }
  return face;
}

std::vector<terms::Rates> joint_rates(std::span<const ElasticJoint> kinds, std::span<const JointFace> faces,
                                      const state::Bodies<3>& bodies) {
  std::vector<BodyMatrices> matrices(at(bodies.size()), BodyMatrices{!bodies.strain.empty(), {}, {}});
  for (const JointFace& face : faces)
    for (const Index body : {face.master, face.slave}) {
      const auto& motion = bodies.motion[at(body)];
      const auto& c = face.corners;
      FaceSprings springs = springs_of(elastic_joint(kinds, face), (c[1] - c[0]).cross(c[2] - c[0]).norm() / 6);
      for (std::size_t v = 0; v < vertex_count; ++v) springs.corners[v] = motion.rotation.transpose() * (c[v] - motion.position);
      add_face(matrices[at(body)], springs);
    }
  std::vector<terms::Rates> rates(matrices.size());
  parallel::parallel_for(rates.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t body = begin; body < end; ++body)
      rates[body] = largest_rates(matrices[body], bodies, static_cast<Index>(body));
  });
  return rates;
}

terms::Rates largest_rates(const BodyMatrices& matrices, const state::Bodies<3>& bodies, Index body) {
  const auto& inertia = bodies.inertia[at(body)];
  const Freedoms free = free_directions(state::start_rotation(bodies, body), bodies.locks[at(body)]);
  FreedomMatrix mass;
  mass.rigid.diagonal() << Vector3::Constant(inertia.mass), inertia.inverse_moments.cwiseInverse();
  const bool is_strained = matrices.is_strained && bodies.strain[at(body)].inverse_inertia > 0;
  if (is_strained) mass.strain.diagonal().setConstant(1 / bodies.strain[at(body)].inverse_inertia);
  const auto of_free = [&](const FreedomMatrix& matrix) {
    FreeMatrix all = free.transpose() * matrix.rigid * free;
    if (!is_strained) return all;
    const auto rigid = all.rows();
    FreeMatrix whole(rigid + 6, rigid + 6);
    whole.topLeftCorner(rigid, rigid) = all;
    whole.topRightCorner(rigid, 6) = free.transpose() * matrix.between;
    whole.bottomLeftCorner(6, rigid) = whole.topRightCorner(rigid, 6).transpose();
    whole.bottomRightCorner(6, 6) = matrix.strain;
    return whole;
  };
  const FreeMatrix free_mass = of_free(mass);
  return {largest_eigenvalue(of_free(matrices.stiffness), free_mass), largest_eigenvalue(of_free(matrices.damping), free_mass)};
}

}  // namespace sazare::methods::blocks
