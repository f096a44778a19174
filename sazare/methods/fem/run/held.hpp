#pragma once

/// What holds the parts of a body of finite elements, for `check`.

#include <string>

#include "sazare/methods/fem/run/model.hpp"

namespace sazare::runs {

/// A line of the axes along which supports, or boundaries that carry the body at rest, hold nodes, and of the parts that nothing
/// holds: elements that hang together by nodes, joints, ties and members. `end` [s]: how far those fall in the run.
template <int D>
std::string held_text(const FemModel<D>& model, Real end);

extern template std::string held_text(const FemModel<2>&, Real);
extern template std::string held_text(const FemModel<3>&, Real);

}  // namespace sazare::runs
