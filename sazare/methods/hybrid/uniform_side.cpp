#include "sazare/methods/hybrid/uniform_side.hpp"

#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

template <int D>
coupling::SurfaceForce UniformSide<D>::start() {
  stepper_->start();
  return force();
}

template <int D>
coupling::SurfaceForce UniformSide<D>::force() const {
  const auto force = folded(nodes().force(), 1);
  return {-1, 0, 0, force, force};
}

template <int D>
void UniformSide<D>::move_to(const coupling::SurfaceShape& shape) {
  course_.move_to(shape);
  put_surface();
}

template <int D>
void UniformSide<D>::go_back() {
  saved_->turn_round();
  stepper_->columns(*saved_);
  saved_->turn_round();
}

template <int D>
coupling::SurfaceForce UniformSide<D>::answer(const coupling::SurfaceMotion& motion) {
  const bool is_new = course_.begin(motion, saved_.has_value());
  if (!is_new)
    go_back();
  else if (can_return_)
    stepper_->columns(saved_.emplace());
  const std::vector<Vector3> from = places(course_.from());
  std::vector<Vector3> velocity = places(course_.to());
  const Real window = course_.shape().window;
  for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] = (velocity[n] - from[n]) / window;
  lead(from, std::move(velocity));
  for (std::int64_t step = 0; step < course_.steps(); ++step) stepper_->advance();
  return {motion.window, motion.pass, motion.time, folded(nodes().impulse(), 1 / window), folded(nodes().force(), 1)};
}

template <int D>
void UniformSide<D>::take_back() {
  if (!saved_) throw UserError("there is no saved window to return to");
  go_back();
  saved_.reset();
  course_.take_back();
}

template class UniformSide<2>;
template class UniformSide<3>;

}  // namespace sazare::methods::hybrid
