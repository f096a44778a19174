#include "sazare/methods/blocks/run/snapshots.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "sazare/core/large_tables.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/levels/motion/kick.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/methods/blocks/run/joints/element_stress.hpp"
#include "sazare/methods/blocks/run/material_points.hpp"
#include "sazare/methods/blocks/run/natural_joints.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

using methods::blocks::JointState;

/// Numbers from a function of their place.
template <class T, class NumberAt>
observe::MadeNumbers<T> made(std::size_t count, NumberAt number_at) {
  return {count, [number_at](std::size_t first, std::span<T> piece) {
            for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = number_at(static_cast<Index>(first + i));
          }};
}

/// Vectors, `per_item` of them for each item, which a function gives as a list.
template <class VectorsOf>
observe::MadeNumbers<Real> made_vectors(std::size_t items, std::size_t per_item, VectorsOf vectors_of) {
  return {3 * per_item * items, [per_item, vectors_of](std::size_t first, std::span<Real> piece) {
            for (std::size_t number = 0; number < piece.size();) {
              const auto vectors = vectors_of(static_cast<Index>((first + number) / (3 * per_item)));
              for (std::size_t own = (first + number) / 3 % per_item; own < per_item && number < piece.size(); ++own)
                for (int axis = 0; axis < 3; ++axis) piece[number++] = vectors[own][axis];
            }
          }};
}

/// The face of a joint as one of its first element, at the beginning.
struct StartFace {
  std::array<Vector3, 3> corners;  // [m]
  Vector3 normal;                  // out of the first element
};

StartFace face_of(const BlocksModel& model, Index joint) {
  const Index element = model.joints->links()[at(joint)].first;
  int face = 0;
  while (model.joints->joint_at(element, face) != joint) ++face;
  const auto corners = geometry::corners_of(model.mesh, element);
  const auto& [a, b, c] = geometry::tetrahedron_faces[at(face)];
  return {{corners[at(a)], corners[at(b)], corners[at(c)]}, geometry::outward_normal(corners, face)};
}

/// How far the faces of joints are apart, by joint: the largest of their corners.
struct Gaps {
  std::vector<Real> opening, slip;  // [m]
};

Gaps gaps_of(const BlocksModel& model, const levels::Snapshot<3>& now) {
  const state::Bodies<3>& bodies = model.simulation->bodies();
  const auto links = model.joints->links();
  Gaps gaps;
  gaps.opening.reserve(links.size());
  gaps.slip.reserve(links.size());
  for (Index joint = 0; joint < model.joints->count(); ++joint) {
    const StartFace face = face_of(model, joint);
    const PlacedElement first(bodies, now, links[at(joint)].first), second(bodies, now, links[at(joint)].second);
    const Vector3 normal = first.turned(face.normal);
    Real widest = -std::numeric_limits<Real>::infinity(), farthest = 0;
    for (const Vector3& corner : face.corners) {
      const Vector3 apart = second.moved(corner) - first.moved(corner);
      widest = std::max(widest, normal.dot(apart));
      farthest = std::max(farthest, (apart - normal.dot(apart) * normal).norm());
    }
    gaps.opening.push_back(widest);
    gaps.slip.push_back(farthest);
  }
  return gaps;
}

std::vector<Vector3> spins_of(const state::Bodies<3>& bodies, const levels::Snapshot<3>& now) {
  std::vector<Vector3> spins;
  spins.reserve(now.pose.size());
  for (std::size_t body = 0; body < now.pose.size(); ++body)
    spins.push_back(
        motion::spin_of(now.pose[body].rotation, bodies.inertia[body], bodies.locks[body], now.angular_momentum[body]));
  return spins;
}

/// How a joint has come to be a crack: 1 by opening, 2 by slip, 0 not at all.
std::int8_t mode_of(const methods::blocks::Joints& joints, Index joint) {
  if (!is_crack(joints.state(joint))) return 0;
  return joints.losses(joint).is_mostly_shear() ? 2 : 1;
}

/// Share of an element's joints that broke.
Real damage_of(const methods::blocks::Joints& joints, std::span<const JointState> state, Index element) {
  Real all = 0, broken = 0;
  for (int face = 0; face < 4; ++face) {
    const Index joint = joints.joint_at(element, face);
    if (joint < 0) continue;
    ++all;
    if (is_crack(state[at(joint)])) ++broken;
  }
  return all > 0 ? broken / all : 0;
}

}  // namespace

/// All that changes while a snapshot is written.
struct Snapshots::Picture {
  Real time = 0;
  levels::Snapshot<3> now;
  std::vector<Vector3> spin;           ///< by element [rad/s]
  std::vector<std::int8_t> level;      ///< by element
  std::vector<std::int32_t> fragment;  ///< by element
  std::vector<JointState> state;       ///< by joint
  std::vector<std::int8_t> mode;       ///< by joint, see mode_of
  std::vector<Real> rate_factor;       ///< by joint: of the strength, by its rate of loading; empty where no joint follows it
  NaturalJoints natural;
  ElementStresses stress;
};

Snapshots::Snapshots(const std::filesystem::path& folder, const BlocksModel& model)
    : model_(&model), elements_(folder, "elements"), joints_(folder, "joints") {}

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

void Snapshots::write(Real time, levels::Snapshot<3> now, const FragmentMap& fragments) {
  finish_writing();
  Picture taken{time, std::move(now), {}, {}, fragments.of_element, {}, {}, {}, natural_joints(*model_->joints), {}};
  taken.spin = spins_of(model_->simulation->bodies(), taken.now);
  release(taken.now.angular_momentum);
  taken.stress = element_stresses(*model_, taken.now);
  const Index elements = model_->simulation->bodies().size(), joints = model_->joints->count();
  taken.level.reserve(at(elements));
  taken.state.reserve(at(joints));
  taken.mode.reserve(at(joints));
  for (Index element = 0; element < elements; ++element)
    taken.level.push_back(static_cast<std::int8_t>(model_->simulation->levels().level(element)));
  for (Index joint = 0; joint < joints; ++joint) {
    taken.state.push_back(model_->joints->state(joint));
    taken.mode.push_back(mode_of(*model_->joints, joint));
    if (model_->joints->follow_rates()) taken.rate_factor.push_back(model_->joints->strength_factor(joint));
  }
  writing_ = std::async(std::launch::async, [this, taken = std::move(taken)]() mutable {
    const Picture picture = std::move(taken);  // goes when it is written, not when the next one comes
    write_elements(picture);
    write_joints(picture);
    elements_.sync_early();
    joints_.sync_early();
  });
}

void Snapshots::write_elements(const Picture& picture) {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const geometry::TetraMesh& mesh = model_->mesh;
  const std::size_t count = picture.level.size();
  const auto points = made_vectors(count, 4, [&](Index element) {
    const PlacedElement placed(bodies, picture.now, element);
    auto corners = geometry::corners_of(mesh, element);
    for (Vector3& corner : corners) corner = placed.moved(corner);
    return corners;
  });
  const auto tag =
      made<std::int32_t>(count, [&](Index element) { return static_cast<std::int32_t>(geometry::element_tag(mesh, element)); });
  const observe::MadeVectors displacement{made_vectors(count, 1, [&](Index element) {
    return std::array{Vector3(picture.now.pose[at(element)].position - model_->places_at_start()[at(element)])};
  })};
  const auto speed = made<Real>(count, [&](Index element) { return picture.now.velocity[at(element)].norm(); });
  const auto level = made<std::int32_t>(count, [&](Index element) { return std::int32_t{picture.level[at(element)]}; });
  const auto step =
      made<Real>(count, [&](Index element) { return model_->simulation->levels().step(picture.level[at(element)]); });
  const auto damage = made<Real>(count, [&](Index element) { return damage_of(*model_->joints, picture.state, element); });
  observe::Grid grid{observe::Grid::Cell::tetrahedron, {}, {}, {}, picture.time};
  grid.own_points = points;
  grid.cell_data = observe::cell_data(columns::blocks::elements, tag, mesh.region, model_->material, displacement,
                                      picture.now.velocity, picture.spin, speed, level, step, picture.fragment, damage,
                                      picture.stress.normal, picture.stress.shear, picture.stress.von_mises,
                                      picture.stress.largest, picture.stress.smallest, picture.stress.volumetric_strain);
  elements_.write(grid);
}

void Snapshots::write_joints(const Picture& picture) {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const auto links = model_->joints->links();
  const std::size_t count = picture.state.size();
  const Gaps gaps = gaps_of(*model_, picture.now);
  const auto points = made_vectors(count, 3, [&](Index joint) {
    const PlacedElement first(bodies, picture.now, links[at(joint)].first);
    auto corners = face_of(*model_, joint).corners;
    for (Vector3& corner : corners) corner = first.moved(corner);
    return corners;
  });
  const auto state = made<std::int32_t>(count, [&](Index joint) { return static_cast<std::int32_t>(picture.state[at(joint)]); });
  const auto mode = made<std::int32_t>(count, [&](Index joint) { return std::int32_t{picture.mode[at(joint)]}; });
  const CaseKinds& kinds = model_->kinds;
  const auto kind_of = [&](Index joint) { return at(model_->joints->record(joint).kind); };
  const auto kind = made<std::int32_t>(count, [&](Index joint) { return kinds.entry[kind_of(joint)]; });
  const auto factor = made<Real>(count, [&](Index joint) {
    return kinds.factor[kind_of(joint)] * (picture.rate_factor.empty() ? 1 : picture.rate_factor[at(joint)]);
  });
  observe::Grid grid{observe::Grid::Cell::triangle, {}, {}, {}, picture.time};
  grid.own_points = points;
  grid.cell_data = observe::cell_data(columns::blocks::joints, state, mode, gaps.opening, gaps.slip, kind, factor);
  if (const NaturalJoints& natural = picture.natural; natural.are_there())
    std::ranges::move(observe::cell_data(columns::blocks::natural_joints, natural.path, natural.mobilised_jrc, natural.closure,
                                         natural.dilation),
                      std::back_inserter(grid.cell_data));
  joints_.write(grid);
}

}  // namespace sazare::runs
