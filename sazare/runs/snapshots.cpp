#include "sazare/runs/snapshots.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/runs/material_points.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

using Numbers = std::vector<Real>;
using Integers = std::vector<std::int32_t>;

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// Every cell has its own points, in their order.
Integers own_points(std::size_t points) {
  Integers numbers(points);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

struct Snapshots::ElementData {
  std::vector<Vector3> points, displacement, velocity;
  Numbers speed, step, damage;
  Integers level, fragment;
};

struct Snapshots::JointData {
  std::vector<Vector3> points;
  Integers state, kind;
  Numbers opening, slip;
};

Snapshots::Snapshots(const std::filesystem::path& folder, const BlocksModel& model)
    : model_(&model), elements_(folder, "elements"), joints_(folder, "joints") {
  const auto links = model.joints->links();
  faces_.resize(at(model.joints->count()));
  const auto elements = static_cast<Index>(model.mesh.tetrahedra.size());
  for (Index element = 0; element < elements; ++element) {
    tags_.push_back(static_cast<std::int32_t>(geometry::element_tag(model.mesh, element)));
    const auto corners = geometry::corners_of(model.mesh, element);
    for (int face = 0; face < 4; ++face) {
      const Index joint = model.joints->joint_at(element, face);
      if (joint < 0 || links[at(joint)].first != element) continue;
      Face& made = faces_[at(joint)];
      made.joint = joint;
      for (std::size_t corner = 0; corner < 3; ++corner)
        made.corners[corner] = corners[at(geometry::tetrahedron_faces[at(face)][corner])];
      made.normal = geometry::outward_normal(corners, face);
    }
  }
}

void Snapshots::finish_writing() {
  if (writing_.valid()) writing_.get();
}

void Snapshots::sync() {
  finish_writing();
  elements_.sync();
  joints_.sync();
}

void Snapshots::resume(std::size_t count) {
  elements_.resume(count);
  joints_.resume(count);
}

void Snapshots::write(Real time, const engine::Snapshot<3>& now, const FragmentMap& fragments) {
  finish_writing();
  writing_ = std::async(std::launch::async, [this, time, elements = element_data(now, fragments), joints = joint_data(now)] {
    write_elements(time, elements);
    write_joints(time, joints);
  });
}

std::vector<Real> Snapshots::damage() const {
  std::vector<Real> damage;
  for (Index element = 0; element < static_cast<Index>(tags_.size()); ++element) {
    Real joints = 0, broken = 0;
    for (int face = 0; face < 4; ++face) {
      const Index joint = model_->joints->joint_at(element, face);
      if (joint < 0) continue;
      ++joints;
      if (model_->joints->state(joint) == methods::blocks::JointState::broken) ++broken;
    }
    damage.push_back(joints > 0 ? broken / joints : 0);
  }
  return damage;
}

Snapshots::ElementData Snapshots::element_data(const engine::Snapshot<3>& now, const FragmentMap& fragments) const {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const auto& levels = model_->simulation->levels();
  ElementData data;
  for (Index element = 0; element < bodies.size(); ++element) {
    for (const Vector3& corner : geometry::corners_of(model_->mesh, element))
      data.points.push_back(moved_point(bodies, now, element, corner));
    data.displacement.push_back(now.pose[at(element)].position - bodies.start[at(element)]);
    data.speed.push_back(now.velocity[at(element)].norm());
    data.level.push_back(levels.level(element));
    data.step.push_back(levels.step(data.level.back()));
  }
  data.velocity = now.velocity;
  data.damage = damage();
  data.fragment = fragments.of_element;
  return data;
}

Snapshots::JointData Snapshots::joint_data(const engine::Snapshot<3>& now) const {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const auto links = model_->joints->links();
  JointData data;
  for (const Face& face : faces_) {
    const Link& link = links[at(face.joint)];
    const Matrix3 turned = now.pose[at(link.first)].rotation * bodies.start_rotation[at(link.first)].transpose();
    const Vector3 normal = turned * face.normal;
    Real widest = -std::numeric_limits<Real>::infinity(), farthest = 0;
    for (const Vector3& corner : face.corners) {
      const Vector3 near = moved_point(bodies, now, link.first, corner);
      const Vector3 apart = moved_point(bodies, now, link.second, corner) - near;
      data.points.push_back(near);
      widest = std::max(widest, normal.dot(apart));
      farthest = std::max(farthest, (apart - normal.dot(apart) * normal).norm());
    }
    data.opening.push_back(widest);
    data.slip.push_back(farthest);
    data.state.push_back(static_cast<std::int32_t>(model_->joints->state(face.joint)));
    data.kind.push_back(model_->joints->report(face.joint).kind);
  }
  return data;
}

void Snapshots::write_elements(Real time, const ElementData& data) {
  const Integers connectivity = own_points(data.points.size());
  elements_.write({observe::Grid::Cell::tetrahedron, data.points, connectivity,
                   observe::cell_data(columns::blocks::elements, tags_, model_->mesh.region, model_->material, data.displacement,
                                      data.velocity, data.speed, data.level, data.step, data.fragment, data.damage),
                   time});
}

void Snapshots::write_joints(Real time, const JointData& data) {
  const Integers connectivity = own_points(data.points.size());
  joints_.write({observe::Grid::Cell::triangle, data.points, connectivity,
                 observe::cell_data(columns::blocks::joints, data.state, data.opening, data.slip, data.kind), time});
}

}  // namespace sazare::runs
