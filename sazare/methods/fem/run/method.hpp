#pragma once

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// The row of method fem in the table of methods.
Method fem_method();

}  // namespace sazare::runs
