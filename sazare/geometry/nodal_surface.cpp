#include "sazare/geometry/nodal_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sazare::geometry {

namespace {

Vector3 centroid(const geometry::Triangle& corners) { return (corners[0] + corners[1] + corners[2]) / 3; }

/// Inertia of three equal masses of 1 at the corners, about their centroid.
Matrix3 inertia(const geometry::Triangle& corners) {
  Matrix3 sum = Matrix3::Zero();
  for (const Vector3& corner : corners) {
    const Vector3 arm = corner - centroid(corners);
    sum += arm.squaredNorm() * Matrix3::Identity() - arm * arm.transpose();
  }
  return sum;
}

}  // namespace

Vector3 FacePoint::spin() const {
  const Vector3 mean = (velocities[0] + velocities[1] + velocities[2]) / 3, middle = centroid(corners);
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += (corners[k] - middle).cross(velocities[k] - mean);
  return inertia(corners).inverse() * sum;
}

std::array<Vector3, 3> FacePoint::on_corners(const Vector3& force, const Vector3& couple) const {
  std::array<Vector3, 3> forces = {shares[0] * force, shares[1] * force, shares[2] * force};
  if (couple.isZero(0)) return forces;
  const Vector3 turning = inertia(corners).inverse() * couple, middle = centroid(corners);
  for (std::size_t k = 0; k < 3; ++k) forces[k] += turning.cross(corners[k] - middle);
  return forces;
}

NodalSurface::NodalSurface(std::vector<Vector3> places, std::vector<std::array<Index, 3>> faces)
    : SurfaceNodes(std::move(places)), faces_(std::move(faces)) {}

geometry::Triangle NodalSurface::corners(std::size_t face, Real time) const {
  geometry::Triangle triangle;
  for (std::size_t k = 0; k < 3; ++k) triangle[k] = place(faces_[face][k], time);
  return triangle;
}

FacePoint NodalSurface::point(std::size_t face, Real time, const Vector3& place) const {
  FacePoint point;
  point.nodes = faces_[face];
  point.corners = corners(face, time);
  for (std::size_t k = 0; k < 3; ++k) point.velocities[k] = velocity(faces_[face][k]);
  const Vector3 first = point.corners[1] - point.corners[0], second = point.corners[2] - point.corners[0],
                from = place - point.corners[0];
  const Real a = first.squaredNorm(), b = first.dot(second), c = second.squaredNorm(), area = a * c - b * b;
  const Real at_first = (c * from.dot(first) - b * from.dot(second)) / area,
             at_second = (a * from.dot(second) - b * from.dot(first)) / area;
  point.shares = {1 - at_first - at_second, at_first, at_second};
  return point;
}

FacetComplex NodalSurface::complex() const {
  std::vector<Vector3> nodes(node_count());
  for (std::size_t node = 0; node < nodes.size(); ++node) nodes[node] = place(static_cast<Index>(node), 0);
  return {nodes, faces_};
}

SurfaceNodes::SurfaceNodes(std::vector<Vector3> places)
    : places_(std::move(places)),
      velocities_(places_.size(), Vector3::Zero()),
      force_(velocities_),
      impulse_(velocities_),
      is_touched_(places_.size(), 0) {}

void SurfaceNodes::measure() {
  Real square = 0;
  for (const Vector3& velocity : velocities_) square = std::max(square, velocity.squaredNorm());
  largest_speed_ = std::sqrt(square);
}

Real SurfaceNodes::lead(Real time, Real step, std::vector<Vector3> from, std::vector<Vector3> with) {
  Real work = 0;
  for (const Index touched : touched_) {
    const auto node = static_cast<std::size_t>(touched);
    work -= 0.5 * step * force_[node].dot(with[node] - velocities_[node]);
  }
  std::ranges::fill(impulse_, Vector3::Zero());
  places_ = std::move(from);
  velocities_ = std::move(with);
  since_ = time;
  measure();
  return work;
}

void SurfaceNodes::add_work(std::span<const NodeForce> forces, Real step) {
  for (const Index touched : touched_) {
    const auto node = static_cast<std::size_t>(touched);
    impulse_[node] += 0.5 * step * force_[node];
    force_[node].setZero();
    is_touched_[node] = 0;
  }
  touched_.clear();
  for (const NodeForce& one : forces) {
    const auto node = static_cast<std::size_t>(one.node);
    force_[node] += one.force;
    if (is_touched_[node] == 0) touched_.push_back(one.node);
    is_touched_[node] = 1;
  }
  for (const Index touched : touched_)
    impulse_[static_cast<std::size_t>(touched)] += 0.5 * step * force_[static_cast<std::size_t>(touched)];
}

Real SurfaceNodes::work() const {
  Real work = 0;
  for (std::size_t node = 0; node < impulse_.size(); ++node) work -= impulse_[node].dot(velocities_[node]);
  return work;
}

void SurfaceNodes::columns(Archive& archive) {
  archive("places", places_);
  archive("velocities", velocities_);
  archive("since", since_);
  archive("force", force_);
  archive("impulse", impulse_);
  archive("touched", touched_);
  archive("is_touched", is_touched_);
  measure();
}

}  // namespace sazare::geometry
