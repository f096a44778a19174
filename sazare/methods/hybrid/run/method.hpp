#pragma once

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// The row of method hybrid in the table of methods.
Method hybrid_method();

}  // namespace sazare::runs
