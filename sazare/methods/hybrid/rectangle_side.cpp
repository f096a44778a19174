#include "sazare/methods/hybrid/rectangle_side.hpp"

#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

void RectangleSide::attach(const coupling::SurfaceShape& shape) {
  if (shape.dimension != 2) throw UserError("the elements of method rectangles are two-dimensional, and the surface is not");
  course_.open(shape, stepper_->rules().step, "rectangles");
  const std::vector<Vector3> nodes = places(course_.to());
  Eigen::AlignedBox3d surface, bodies;
  for (const Vector3& node : nodes) surface.extend(node);
  const auto& particles = stepper_->particles();
  for (std::size_t i = 0; i < static_cast<std::size_t>(elements_); ++i) {
    const Real reach = geometry::outer_radius(forces_->outlines().at(particles, i));
    const Vector3 centre(particles.position(0, i), particles.position(1, i), 0), around(reach, reach, 0);
    bodies.extend(Vector3(centre - around));
    bodies.extend(Vector3(centre + around));
  }
  check_near(surface, bodies);
  std::vector<methods::rectangles::SurfaceContacts::Segment> segments;
  for (std::size_t i = 0; i < shape.faces.size(); i += 2) segments.push_back({shape.faces[i], shape.faces[i + 1]});
  forces_->add_surface(particles, nodes, std::move(segments));
}

std::vector<Vector3> RectangleSide::places(const std::vector<Real>& displacement) const {
  std::vector<Vector3> result;
  const auto& nodes = course_.shape().nodes;
  for (std::size_t i = 0; i < nodes.size(); i += 2)
    result.emplace_back(nodes[i] + displacement[i], nodes[i + 1] + displacement[i + 1], 0);
  return result;
}

/// Per metre of the elements' thickness.
std::vector<Real> RectangleSide::folded(const std::vector<Vector3>& forces, Real factor) const {
  std::vector<Real> result;
  for (const Vector3& force : forces)
    for (int axis = 0; axis < 2; ++axis) result.push_back(factor * force[axis] / course_.shape().width);
  return result;
}

coupling::SurfaceForce RectangleSide::start() {
  stepper_->start();
  const auto force = folded(forces_->surface()->nodes().force(), 1);
  return {-1, 0, 0, force, force};
}

void RectangleSide::go_back() {
  saved_->turn_round();
  stepper_->columns(*saved_);
  saved_->turn_round();
}

coupling::SurfaceForce RectangleSide::answer(const coupling::SurfaceMotion& motion) {
  const bool is_new = course_.begin(motion, saved_.has_value());
  if (!is_new)
    go_back();
  else if (can_return_)
    stepper_->columns(saved_.emplace());
  const std::vector<Vector3> from = places(course_.from());
  std::vector<Vector3> velocity = places(course_.to());
  const Real window = course_.shape().window;
  for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] = (velocity[n] - from[n]) / window;
  forces_->lead(from, std::move(velocity));
  for (std::int64_t step = 0; step < course_.steps(); ++step) stepper_->advance();
  const auto& nodes = forces_->surface()->nodes();
  return {motion.window, motion.pass, motion.time, folded(nodes.impulse(), 1 / window), folded(nodes.force(), 1)};
}

void RectangleSide::take_back() {
  if (!saved_) throw UserError("there is no saved window to return to");
  go_back();
  saved_.reset();
  course_.take_back();
}

}  // namespace sazare::methods::hybrid
