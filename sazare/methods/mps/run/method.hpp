#pragma once

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// The row of method mps in the table of methods.
Method mps_method();

}  // namespace sazare::runs
