#pragma once

/// What every side of bodies does with the windows of a coupled run.

#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/coupling/window_messages.hpp"

namespace sazare::test {

/// `sides` may go back and `once` may not; both stand after so many windows of a run with windows of 1 ms.
template <class Sides>
void expect_windows_can_be_taken_back(Sides& sides, Sides& once, std::int64_t windows) {
  for (Sides* each : {&sides, &once}) {
    each->start();
    each->advance(static_cast<int>(windows));
  }
  coupling::SurfaceMotion motion{
      windows, 0, 1e-3 * static_cast<Real>(windows + 1), std::vector<Real>(sides.continuum().shape().nodes.size(), 1e-4), {}};
  const auto first = sides.bodies().answer(motion);
  sides.bodies().take_back();
  EXPECT_EQ(sides.bodies().windows(), windows);
  EXPECT_EQ(sides.bodies().answer(motion).mean, first.mean);
  once.bodies().answer(motion);
  motion.pass = 1;
  EXPECT_EQ(sides.bodies().answer(motion).mean, first.mean);
  EXPECT_THROW(once.bodies().answer(motion), UserError);
  EXPECT_THROW(once.bodies().take_back(), UserError);
}

}  // namespace sazare::test
