#pragma once

#include <string_view>

#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/hybrid/case/case.hpp"

/// The method of the continuum: hybrid cases know it by these names.
namespace sazare::cases {

using ContinuumCase = FemCase;
inline constexpr std::string_view continuum_method = "fem";

/// The continuum's case, which has been read.
inline const ContinuumCase& continuum_of(const HybridCase& hybrid) { return hybrid.continuum->as<ContinuumCase>(); }

}  // namespace sazare::cases
