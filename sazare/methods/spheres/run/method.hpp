#pragma once

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// The row of method spheres in the table of methods.
Method spheres_method();

}  // namespace sazare::runs
