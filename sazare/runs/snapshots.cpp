#include "sazare/runs/snapshots.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/runs/material_points.hpp"

namespace sazare::runs {

namespace {

using observe::CellData;
using Numbers = std::vector<Real>;
using Integers = std::vector<std::int32_t>;

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

CellData cell_data(const std::string& name, const Numbers& values) { return {name, 1, std::span<const Real>(values)}; }
CellData cell_data(const std::string& name, const Integers& values) {
  return {name, 1, std::span<const std::int32_t>(values)};
}
CellData cell_data(const std::string& name, const std::vector<Vector3>& values) {
  const Real* first = values.empty() ? nullptr : values.front().data();
  return {name, 3, std::span(first, 3 * values.size())};
}

/// Every cell has its own points, in their order.
Integers own_points(std::size_t points) {
  Integers numbers(points);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

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

void Snapshots::sync() {
  elements_.sync();
  joints_.sync();
}

void Snapshots::resume(std::size_t count) {
  elements_.resume(count);
  joints_.resume(count);
}

void Snapshots::write(Real time, const engine::Snapshot<3>& now, const FragmentMap& fragments) {
  write_elements(time, now, fragments);
  write_joints(time, now);
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

void Snapshots::write_elements(Real time, const engine::Snapshot<3>& now, const FragmentMap& fragments) {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const auto& levels = model_->simulation->levels();
  std::vector<Vector3> points, displacement;
  Numbers speed, step;
  Integers level;
  for (Index element = 0; element < bodies.size(); ++element) {
    for (const Vector3& corner : geometry::corners_of(model_->mesh, element))
      points.push_back(moved_point(bodies, now, element, corner));
    displacement.push_back(now.pose[at(element)].position - bodies.start[at(element)]);
    speed.push_back(now.velocity[at(element)].norm());
    level.push_back(levels.level(element));
    step.push_back(levels.step(level.back()));
  }
  const Integers connectivity = own_points(points.size());
  const Numbers shares = damage();
  elements_.write({observe::Grid::Cell::tetrahedron, points, connectivity,
                   {cell_data("element", tags_), cell_data("region", model_->mesh.region),
                    cell_data("material", model_->material), cell_data("displacement", displacement),
                    cell_data("velocity", now.velocity), cell_data("speed", speed), cell_data("level", level),
                    cell_data("step", step), cell_data("fragment", fragments.of_element), cell_data("damage", shares)},
                   time});
}

void Snapshots::write_joints(Real time, const engine::Snapshot<3>& now) {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const auto links = model_->joints->links();
  std::vector<Vector3> points;
  Integers state, kind;
  Numbers opening, slip;
  for (const Face& face : faces_) {
    const Link& link = links[at(face.joint)];
    const Matrix3 turned = now.pose[at(link.first)].rotation * bodies.start_rotation[at(link.first)].transpose();
    const Vector3 normal = turned * face.normal;
    Real widest = -std::numeric_limits<Real>::infinity(), farthest = 0;
    for (const Vector3& corner : face.corners) {
      const Vector3 near = moved_point(bodies, now, link.first, corner);
      const Vector3 apart = moved_point(bodies, now, link.second, corner) - near;
      points.push_back(near);
      widest = std::max(widest, normal.dot(apart));
      farthest = std::max(farthest, (apart - normal.dot(apart) * normal).norm());
    }
    opening.push_back(widest);
    slip.push_back(farthest);
    const methods::blocks::JointReport report = model_->joints->report(face.joint);
    state.push_back(static_cast<std::int32_t>(report.state));
    kind.push_back(report.kind);
  }
  const Integers connectivity = own_points(points.size());
  joints_.write({observe::Grid::Cell::triangle, points, connectivity,
                 {cell_data("state", state), cell_data("opening", opening), cell_data("slip", slip),
                  cell_data("kind", kind)},
                 time});
}

}  // namespace sazare::runs
