#pragma once

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// The row of method rectangles in the table of methods.
Method rectangles_method();

}  // namespace sazare::runs
