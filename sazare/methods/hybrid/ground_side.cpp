#include "sazare/methods/hybrid/ground_side.hpp"

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

template <int D>
void GroundSide<D>::attach(const coupling::SurfaceShape& shape) {
  if (shape.dimension != D)
    throw UserError(D == 2 ? "the particles of method mps are in the plane, and the surface is not"
                           : "the particles of method mps are in space, and the surface is in the plane");
  this->course().open(shape, this->stepper().rules().step, "particles");
  const auto& particles = this->stepper().particles();
  // In the plane the particles lie at z = 0, in the middle of a slab that is wider than they are.
  surface_ = {shape, -particles.spacing, particles.spacing};
  Eigen::AlignedBox3d surface, ground;
  std::vector<Vector3> nodes = surface_.places(this->course().to());
  for (const Vector3& node : nodes) surface.extend(node);
  const Vector3 around = 0.5 * particles.spacing * Vector3::Ones();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Vector3 centre = Vector3::Zero();
    for (std::size_t axis = 0; axis < D; ++axis) centre[static_cast<int>(axis)] = particles.position(axis, i);
    ground.extend(Vector3(centre - around));
    ground.extend(Vector3(centre + around));
  }
  check_near(surface, ground);
  forces_->attach(particles, std::move(nodes), surface_.triangles());
}

template <int D>
void GroundSide<D>::put_surface() {
  surface_.move_to(this->course().shape());
  forces_->put_surface(surface_.places(this->course().to()));
}

template class GroundSide<2>;
template class GroundSide<3>;

}  // namespace sazare::methods::hybrid
