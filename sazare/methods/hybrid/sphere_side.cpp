#include "sazare/methods/hybrid/sphere_side.hpp"

#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

namespace {

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

}  // namespace

void SphereSide::attach(const coupling::SurfaceShape& shape) {
  course_.open(shape, stepper_->rules().step, "spheres");
  Eigen::AlignedBox3d spheres = box_of(stepper_->spheres());
  surface_ = {shape, spheres.min().z() - shape.width, spheres.max().z() + shape.width};
  std::vector<Vector3> nodes = surface_.places(course_.to());
  Eigen::AlignedBox3d surface;
  for (const Vector3& node : nodes) surface.extend(node);
  check_near(surface, spheres);
  methods::spheres::Wall wall;
  wall.name = "surface";
  wall.material = material_;
  wall.nodal = geometry::NodalSurface(std::move(nodes), surface_.triangles());
  stepper_->add_surface(std::move(wall));
}

coupling::SurfaceForce SphereSide::start() {
  stepper_->start();
  const auto force = surface_.folded(stepper_->walls().surface()->force(), 1);
  return {-1, 0, 0, force, force};
}

coupling::SurfaceForce SphereSide::answer(const coupling::SurfaceMotion& motion) {
  const bool is_new = course_.begin(motion, saved_.has_value());
  if (!is_new)
    *stepper_ = *saved_;
  else if (can_return_)
    saved_ = *stepper_;
  std::vector<Vector3> from = surface_.places(course_.from()), velocity = surface_.places(course_.to());
  const Real window = course_.shape().window;
  for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] = (velocity[n] - from[n]) / window;
  stepper_->lead(std::move(from), std::move(velocity));
  for (std::int64_t step = 0; step < course_.steps(); ++step) stepper_->advance();
  stepper_->evaluate_now();
  const auto& nodes = *stepper_->walls().surface();
  return {motion.window, motion.pass, motion.time, surface_.folded(nodes.impulse(), 1 / window),
          surface_.folded(nodes.force(), 1)};
}

void SphereSide::take_back() {
  if (!saved_) throw UserError("there is no saved window to return to");
  *stepper_ = *saved_;
  saved_.reset();
  course_.take_back();
}

}  // namespace sazare::methods::hybrid
