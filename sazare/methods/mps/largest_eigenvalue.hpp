#pragma once

#include <functional>
#include <span>

#include "sazare/core/vector.hpp"

namespace sazare::methods::mps {

/// y = A x.
using LinearMap = std::function<void(std::span<const Real> x, std::span<Real> y)>;

/// Largest eigenvalue of a symmetric positive semidefinite matrix of n rows, relative error about `tolerance`: power iteration in
/// Lanczos's form, which takes the best of all iterates. The starting vector is always the same.
Real largest_eigenvalue(std::size_t n, const LinearMap& map, Real tolerance = 1e-7);

}  // namespace sazare::methods::mps
