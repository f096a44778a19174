#pragma once

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// The row of method blocks in the table of methods.
Method blocks_method();

}  // namespace sazare::runs
