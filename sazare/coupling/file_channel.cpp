#include "sazare/coupling/file_channel.hpp"

#include <fmt/format.h>

#include "sazare/coupling/surface_messages.hpp"

namespace sazare::coupling {

SurfaceForce FileContinuumChannel::open(const SurfaceShape& shape) {
  check_shape(shape);
  shape_ = shape;
  exchange_.meet();
  exchange_.send(to_message(shape));
  return receive(-1, 0);
}

void FileContinuumChannel::reopen(const SurfaceShape& shape) {
  shape_ = shape;
  exchange_.meet();
  check_same(to_shape(exchange_.own(0)), shape, "the resumed case");
}

SurfaceForce FileContinuumChannel::exchange(const SurfaceMotion& motion) {
  exchange_.send(to_message(motion, shape_));
  return receive(motion.window, motion.pass);
}

SurfaceForce FileContinuumChannel::receive(std::int64_t window, std::int32_t pass) {
  SurfaceForce force = to_force(exchange_.receive(exchange_.next() - 1), shape_);
  if (force.window != window || force.pass != pass)
    throw MachineError(
        fmt::format("{}: is out of step: the bodies answer window {}, pass {}, and the motion was of window {}, pass {}",
                    file_name(Side::bodies, exchange_.next() - 1).string(), force.window, force.pass, window, pass));
  window_ = window + 1;
  return force;
}

void FileContinuumChannel::close() { exchange_.part(Farewell::done, window_); }

SurfaceShape FileBodyChannel::open() {
  exchange_.meet();
  shape_ = to_shape(exchange_.receive(0));
  return shape_;
}

std::optional<SurfaceMotion> FileBodyChannel::receive() {
  Message message = exchange_.receive(exchange_.next());
  if (message.kind == Kind::farewell) {
    exchange_.part(Farewell::done, message.window);
    return std::nullopt;
  }
  return to_motion(std::move(message), shape_);
}

void FileBodyChannel::answer(const SurfaceForce& force) { exchange_.send(to_message(force, shape_)); }

}  // namespace sazare::coupling
