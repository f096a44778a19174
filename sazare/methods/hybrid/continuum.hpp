#pragma once

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/stepper.hpp"

/// The finite elements that a hybrid run couples: the sides know them by these names.
namespace sazare::methods::hybrid {

template <int D>
using ContinuumStepper = fem::FemStepper<D>;
template <int D>
using ContinuumState = fem::FemState<D>;
using fem::NodalColumn, fem::dot, fem::norm, fem::number;

}  // namespace sazare::methods::hybrid
