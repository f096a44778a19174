#pragma once

#include <string>

#include "sazare/methods/mps/run/model.hpp"

namespace sazare::runs {

/// Warns of parts of the ground that links join to nothing that a boundary holds or moves, such as those beyond a gap between
/// regions; empty where there are none.
template <int D>
std::string warn_of_loose_parts(const cases::CaseFile& file, const MpsParts<D>& parts);

extern template std::string warn_of_loose_parts<2>(const cases::CaseFile&, const MpsParts<2>&);
extern template std::string warn_of_loose_parts<3>(const cases::CaseFile&, const MpsParts<3>&);

}  // namespace sazare::runs
