#include "sazare/methods/hybrid/body_side.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sazare/core/error.hpp"

namespace sazare::methods::hybrid {

namespace {

constexpr Real whole = 1e-9;         // of a number of steps
constexpr Real most_steps = 0x1p53;  // beyond, every number is whole

}  // namespace

void WindowCourse::open(const coupling::SurfaceShape& shape, Real step, const char* bodies) {
  const Real count = std::round(shape.window / step);
  if (count < 1 || count > most_steps || std::abs(shape.window / step - count) > whole * count)
    throw UserError(
        fmt::format("the window of {:.6g} s is {:.9g} steps of the {}, of {:.6g} s each, and must be a whole "
                    "number of them",
                    shape.window, shape.window / step, bodies, step));
  shape_ = shape;
  bodies_ = bodies;
  steps_ = static_cast<std::int64_t>(count);
  from_ = to_ = std::vector<Real>(shape.nodes.size(), 0);
}

bool WindowCourse::begin(const coupling::SurfaceMotion& motion, bool can_repeat) {
  const bool is_new = motion.window == windows_ && motion.pass == 0;
  if (!is_new && !(motion.window + 1 == windows_ && motion.pass > 0 && can_repeat))
    throw UserError(fmt::format(
        "pass {} of window {} was requested of {} that have completed {} windows{}", motion.pass, motion.window, bodies_,
        windows_, motion.pass > 0 && !can_repeat ? ", and repeat none: so says the coupling scheme of their case" : ""));
  if (motion.displacement.size() != shape_.nodes.size())
    throw UserError(fmt::format("the motion has {} numbers, the surface {}", motion.displacement.size(), shape_.nodes.size()));
  if (is_new) {
    from_ = to_;
    ++windows_;
  }
  to_ = motion.displacement;
  return is_new;
}

void WindowCourse::take_back() {
  to_ = from_;
  --windows_;
}

void WindowCourse::columns(Archive& archive) {
  archive("windows", windows_);
  archive("to", to_);
}

void check_near(const Eigen::AlignedBox3d& surface, const Eigen::AlignedBox3d& bodies) {
  if (const Real gap = surface.exteriorDistance(bodies); gap > surface.diagonal().norm())
    throw UserError(
        fmt::format("no body is near the surface: the nearest is {:.3g} m away or more, further than the surface is "
                    "long",
                    gap));
}

}  // namespace sazare::methods::hybrid
