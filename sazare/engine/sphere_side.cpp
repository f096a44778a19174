#include "sazare/engine/sphere_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/core/error.hpp"

namespace sazare::engine {

namespace {

constexpr Real whole = 1e-9;  // of a number of steps

/// Where spheres are, with all of their volume.
Eigen::AlignedBox3d box_of(const state::Spheres& spheres) {
  Eigen::AlignedBox3d box;
  for (const state::SpherePlace& place : spheres.place) {
    const Vector3 centre = spheres.box.wrapped(place.centre());
    box.extend(Vector3(centre.array() - place.radius));
    box.extend(Vector3(centre.array() + place.radius));
  }
  return box;
}

std::int64_t steps_in(Real window, Real step) {
  const Real count = std::round(window / step);
  if (count < 1 || std::abs(window / step - count) > whole * count)
    throw UserError(
        fmt::format("the window of {:.6g} s is {:.9g} steps of the spheres, of {:.6g} s each, and must be a whole "
                    "number of them",
                    window, window / step, step));
  return static_cast<std::int64_t>(count);
}

/// Triangles of a surface; in the plane the nodes of a segment stand at the one end of the slab and, further by `nodes`, at the
/// other.
std::vector<std::array<Index, 3>> triangles_of(const coupling::SurfaceShape& shape, Index nodes) {
  std::vector<std::array<Index, 3>> triangles;
  const auto dimension = static_cast<std::size_t>(shape.dimension);
  for (std::size_t i = 0; i + dimension <= shape.faces.size(); i += dimension) {
    const Index a = shape.faces[i], b = shape.faces[i + 1];
    if (dimension == 3) {
      triangles.push_back({a, b, shape.faces[i + 2]});
      continue;
    }
    triangles.push_back({a, b + nodes, b});
    triangles.push_back({a, a + nodes, b + nodes});
  }
  return triangles;
}

}  // namespace

void SphereSide::attach(const coupling::SurfaceShape& shape) {
  shape_ = shape;
  steps_ = steps_in(shape.window, stepper_->rules().step);
  Eigen::AlignedBox3d spheres = box_of(stepper_->spheres());
  low_ = spheres.min().z() - shape.width;
  high_ = spheres.max().z() + shape.width;
  from_ = to_ = std::vector<Real>(shape.nodes.size(), 0);
  std::vector<Vector3> nodes = places(to_);
  Eigen::AlignedBox3d surface;
  for (const Vector3& node : nodes) surface.extend(node);
  if (const Real gap = surface.exteriorDistance(spheres); gap > surface.diagonal().norm())
    throw UserError(
        fmt::format("no body is near the surface: the nearest is {:.3g} m away or more, further than the surface is "
                    "long",
                    gap));
  methods::spheres::Wall wall;
  wall.name = "surface";
  wall.material = material_;
  const auto triangles = triangles_of(shape, static_cast<Index>(shape.nodes.size()) / shape.dimension);
  wall.nodal = methods::spheres::NodalSurface(std::move(nodes), triangles);
  stepper_->add_surface(std::move(wall));
}

/// Of the nodes in space; in the plane first those at the lower end of the slab, then those at the other.
std::vector<Vector3> SphereSide::places(const std::vector<Real>& displacement) const {
  std::vector<Vector3> result;
  const auto dimension = static_cast<std::size_t>(shape_.dimension);
  for (const Real z : {low_, high_}) {
    for (std::size_t i = 0; i < displacement.size(); i += dimension) {
      Vector3 place(0, 0, z);
      for (std::size_t axis = 0; axis < dimension; ++axis)
        place[static_cast<int>(axis)] = shape_.nodes[i + axis] + displacement[i + axis];
      result.push_back(place);
    }
    if (!is_plane()) break;
  }
  return result;
}

/// Of the nodes of the continuum: the sum across the slab, by its width.
std::vector<Real> SphereSide::folded(const std::vector<Vector3>& forces, Real factor) const {
  std::vector<Real> result(shape_.nodes.size(), 0);
  const auto dimension = static_cast<std::size_t>(shape_.dimension);
  const std::size_t nodes = result.size() / dimension;
  for (std::size_t n = 0; n < forces.size(); ++n)
    for (std::size_t axis = 0; axis < dimension; ++axis)
      result[n % nodes * dimension + axis] += factor * forces[n][static_cast<int>(axis)];
  if (is_plane())
    for (Real& value : result) value /= shape_.width;
  return result;
}

coupling::SurfaceForce SphereSide::start() {
  stepper_->start();
  const auto force = folded(stepper_->walls().surface()->force(), 1);
  return {-1, 0, 0, force, force};
}

void SphereSide::begin(const coupling::SurfaceMotion& motion) {
  if (motion.window == windows_ && motion.pass == 0) {
    from_ = to_;
    saved_ = *stepper_;
    ++windows_;
  } else if (motion.window + 1 == windows_ && motion.pass > 0 && saved_) {
    *stepper_ = *saved_;
  } else {
    throw UserError(fmt::format("pass {} of window {} was asked of spheres that have gone through {} windows", motion.pass,
                                motion.window, windows_));
  }
  if (motion.displacement.size() != shape_.nodes.size())
    throw UserError(fmt::format("the motion has {} numbers, the surface {}", motion.displacement.size(), shape_.nodes.size()));
  to_ = motion.displacement;
}

coupling::SurfaceForce SphereSide::answer(const coupling::SurfaceMotion& motion) {
  begin(motion);
  std::vector<Vector3> from = places(from_), velocity = places(to_);
  for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] = (velocity[n] - from[n]) / shape_.window;
  stepper_->lead(std::move(from), std::move(velocity));
  for (std::int64_t step = 0; step < steps_; ++step) stepper_->advance();
  stepper_->settle();
  const auto& surface = *stepper_->walls().surface();
  return {motion.window, motion.pass, motion.time, folded(surface.impulse(), 1 / shape_.window), folded(surface.force(), 1)};
}

void SphereSide::take_back() {
  if (!saved_) throw UserError("there is no window that could be taken back");
  *stepper_ = *saved_;
  saved_.reset();
  to_ = from_;
  --windows_;
}

void SphereSide::columns(Archive& archive) {
  archive("windows", windows_);
  archive("to", to_);
}

}  // namespace sazare::engine
