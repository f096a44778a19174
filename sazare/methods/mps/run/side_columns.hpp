#pragma once

/// Columns of layers beside the free-field sides of a case, and copies of the ground at these sides (free_field.hpp).

#include "sazare/methods/mps/run/model.hpp"

namespace sazare::runs {

/// What stands beside the ground, before a step is chosen.
template <int D>
struct SideParts {
  struct Copy {
    std::size_t column = 0;
    MpsParts<D> parts;
    std::vector<Index> follows;  ///< see SideCopy
    std::vector<typename methods::mps::SideCopy<D>::Pair> pairs;
  };

  std::vector<MpsParts<D>> columns;
  std::vector<Copy> copies;
  std::vector<methods::mps::SideDashpot> dashpots;

  /// The lesser of the limits of ground and columns.
  methods::mps::StableStep predict(methods::mps::StableStep ground) const;
  methods::mps::SideGround<D> stand(const cases::MpsCase& mps, Real step) const;
};

/// Throws UserError where the ground beside a side is not level.
template <int D>
SideParts<D> make_side_parts(const cases::CaseFile& file, const MpsParts<D>& ground);

extern template struct SideParts<2>;
extern template struct SideParts<3>;
extern template SideParts<2> make_side_parts<2>(const cases::CaseFile&, const MpsParts<2>&);
extern template SideParts<3> make_side_parts<3>(const cases::CaseFile&, const MpsParts<3>&);

}  // namespace sazare::runs
