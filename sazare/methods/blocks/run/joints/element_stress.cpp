#include "sazare/methods/blocks/run/joints/element_stress.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/run/material_points.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::runs {

namespace {

/// What holds an element: the sum of (x - o) f^T about its own centre, and what moves it to another point.
struct Held {
  Matrix3 dyads = Matrix3::Zero();         // [N m]
  Vector3 force = Vector3::Zero();         // of all joints [N]
  Vector3 open_centres = Vector3::Zero();  // sum, from the element's centre [m]
  int open = 0;                            // faces
};

Held held_by_joints(const BlocksModel& model, const levels::Snapshot<3>& now, Index element) {
  const PlacedElement placed(model.simulation->bodies(), now, element);
  auto corners = geometry::corners_of(model.mesh, element);
  for (Vector3& corner : corners) corner = placed.moved(corner);
  const Vector3 middle = geometry::centroid(corners);
  Held held;
  for (int face = 0; face < 4; ++face) {
    const auto& [a, b, c] = geometry::tetrahedron_faces[at(face)];
    const Vector3 centre = (corners[at(a)] + corners[at(b)] + corners[at(c)]) / 3 - middle;
    const Index joint = model.joints->joint_at(element, face);
    if (joint < 0 || model.joints->state(joint) == methods::blocks::JointState::broken) {
      held.open_centres += centre;
      ++held.open;
      continue;
    }
    const Vector3 on_second = model.joints->force(joint);
    const Vector3 force = model.joints->links()[at(joint)].second == element ? on_second : Vector3(-on_second);
    held.dyads += centre * force.transpose();
    held.force += force;
  }
  return held;
}

/// None where the element is rigid.
const methods::blocks::DeformableElement* element_of(const BlocksModel& model, Index element) {
  return model.elements == nullptr ? nullptr : model.elements->element_of(element);
}

/// Of a deformable element by its own strain, of a rigid one by its joints.
Matrix3 stress_of(const BlocksModel& model, const levels::Snapshot<3>& now, Index element) {
  if (const auto* own = element_of(model, element)) {
    const Matrix3& rotation = now.pose[at(element)].rotation;
    return rotation * tensor_of(own->stress(now.strain[at(element)].strain)) * rotation.transpose();
  }
  const Held held = held_by_joints(model, now, element);
  Matrix3 dyads = held.dyads;
  if (held.open > 0) dyads -= held.open_centres / held.open * held.force.transpose();
  return (dyads + dyads.transpose()) / (2 * geometry::volume(geometry::corners_of(model.mesh, element)));
}

}  // namespace

ElementStresses element_stresses(const BlocksModel& model, const levels::Snapshot<3>& now) {
  const std::size_t count = model.mesh.tetrahedra.size();
  ElementStresses all{std::vector<Vector3>(count), std::vector<Vector3>(count), std::vector<Real>(count),
                      std::vector<Real>(count),    std::vector<Real>(count),    std::vector<Real>(count)};
  parallel::parallel_for(count, 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Matrix3 stress = stress_of(model, now, static_cast<Index>(i));
      all.normal[i] = stress.diagonal();
      all.shear[i] = {stress(0, 1), stress(1, 2), stress(2, 0)};
      const Matrix3 deviator = stress - stress.trace() / 3 * Matrix3::Identity();
      all.von_mises[i] = std::sqrt(1.5) * deviator.norm();
      const Vector3 principal = Eigen::SelfAdjointEigenSolver<Matrix3>(stress, Eigen::EigenvaluesOnly).eigenvalues();
      all.smallest[i] = principal[0];
      all.largest[i] = principal[2];
      if (const auto* own = element_of(model, static_cast<Index>(i)))
        all.volumetric_strain[i] = own->volumetric_strain(now.strain[i].strain);
    }
  });
  return all;
}

}  // namespace sazare::runs
