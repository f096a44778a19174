#pragma once

#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/mps/run/filling.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// `filling` is a hash of where the particles stand.
RunIdentity identify(const cases::MpsCase& mps, const std::string& filling);

/// A hash of where the particles stand and of what region they are.
template <int D>
std::string filling_hash(const Filling<D>& filling);

extern template std::string filling_hash<2>(const Filling<2>&);
extern template std::string filling_hash<3>(const Filling<3>&);

}  // namespace sazare::runs
