#pragma once

#include <string>

#include "sazare/methods/mps/run/model.hpp"

namespace sazare::runs {

/// Warns where ground with a strength has to find its rest with too few particles over the height of its slopes to judge whether
/// it stands; empty where that is not so.
template <int D>
std::string warn_of_coarse_slopes(const cases::CaseFile& file, const Filling<D>& filling);

extern template std::string warn_of_coarse_slopes<2>(const cases::CaseFile&, const Filling<2>&);
extern template std::string warn_of_coarse_slopes<3>(const cases::CaseFile&, const Filling<3>&);

}  // namespace sazare::runs
