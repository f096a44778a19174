#include "sazare/methods/hybrid/rectangle_side.hpp"

#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

void RectangleSide::attach(const coupling::SurfaceShape& shape) {
  if (shape.dimension != 2) throw UserError("the elements of method rectangles are two-dimensional, and the surface is not");
  course().open(shape, stepper().rules().step, "rectangles");
  const std::vector<Vector3> nodes = places(course().to());
  Eigen::AlignedBox3d surface, bodies;
  for (const Vector3& node : nodes) surface.extend(node);
  const auto& particles = stepper().particles();
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
  const auto& nodes = course().shape().nodes;
  for (std::size_t i = 0; i < nodes.size(); i += 2)
    result.emplace_back(nodes[i] + displacement[i], nodes[i + 1] + displacement[i + 1], 0);
  return result;
}

/// Per metre of the elements' thickness.
std::vector<Real> RectangleSide::folded(const std::vector<Vector3>& forces, Real factor) const {
  std::vector<Real> result;
  for (const Vector3& force : forces)
    for (int axis = 0; axis < 2; ++axis) result.push_back(factor * force[axis] / course().shape().width);
  return result;
}

}  // namespace sazare::methods::hybrid
