#include "sazare/methods/hybrid/block_side.hpp"

#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

void BlockSide::attach(const coupling::SurfaceShape& shape) {
  course_.open(shape, simulation_->levels().step(0), "blocks");
  Eigen::AlignedBox3d blocks, surface;
  const auto& bodies = simulation_->bodies();
  for (Index body = 0; body < bodies.size(); ++body) {
    const auto i = static_cast<std::size_t>(body);
    blocks.extend(Vector3(bodies.motion[i].position.array() - bodies.reach[i]));
    blocks.extend(Vector3(bodies.motion[i].position.array() + bodies.reach[i]));
  }
  surface_ = {shape, blocks.min().z() - shape.width, blocks.max().z() + shape.width};
  std::vector<Vector3> nodes = surface_.places(course_.to());
  for (const Vector3& node : nodes) surface.extend(node);
  check_near(surface, blocks);
  contacts_->attach(std::move(nodes), surface_.triangles());
}

/// What lies on the surface at the beginning is felt from the first step on.
coupling::SurfaceForce BlockSide::start() {
  simulation_->start();
  const auto force = surface_.folded(contacts_->force(), 1);
  return {-1, 0, 0, force, force};
}

void BlockSide::go_back() {
  saved_->turn_round();
  simulation_->columns(*saved_);
  saved_->turn_round();
}

coupling::SurfaceForce BlockSide::answer(const coupling::SurfaceMotion& motion) {
  const bool is_new = course_.begin(motion, saved_.has_value());
  if (!is_new)
    go_back();
  else if (can_return_)
    simulation_->columns(saved_.emplace());
  const std::vector<Vector3> from = surface_.places(course_.from());
  std::vector<Vector3> velocity = surface_.places(course_.to());
  const Real window = course_.shape().window;
  for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] = (velocity[n] - from[n]) / window;
  contacts_->lead(simulation_->now(), from, std::move(velocity));
  for (std::int64_t step = 0; step < course_.steps(); ++step) simulation_->advance();
  return {motion.window, motion.pass, motion.time, surface_.folded(contacts_->impulse(), 1 / window),
          surface_.folded(contacts_->force(), 1)};
}

void BlockSide::take_back() {
  if (!saved_) throw UserError("there is no saved window to return to");
  go_back();
  saved_.reset();
  course_.take_back();
}

}  // namespace sazare::methods::hybrid
