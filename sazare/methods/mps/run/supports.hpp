#pragma once

/// From the boundaries of a case to what holds and moves its particles.

#include <string>
#include <utility>
#include <vector>

#include "sazare/methods/mps/run/model.hpp"

namespace sazare::runs {

/// Axis and direction of a side.
template <int D>
std::pair<std::size_t, int> outward(cases::Side side) {
  using cases::Side;
  switch (side) {
    case Side::left:
      return {0, -1};
    case Side::right:
      return {0, 1};
    case Side::front:
      return {1, -1};
    case Side::back:
      return {1, 1};
    case Side::bottom:
      return {D - 1, -1};
    default:
      return {D - 1, 1};
  }
}

/// Particles of each boundary of a case.
using Members = std::vector<std::vector<Index>>;

template <int D>
Members members_of(const cases::MpsCase& mps, const Filling<D>& filling);

/// How many particles each boundary has and where, ready to print, in the order in which they apply.
template <int D>
std::vector<std::string> words_of_sides(const cases::MpsCase& mps, const Members& members, const Filling<D>& filling);

/// Supports, boundary by boundary; what an earlier one holds stays held. Particles through which a boundary goes are cut in half.
template <int D>
void add_supports(const cases::MpsCase& mps, const Members& members, MpsParts<D>& parts);

extern template Members members_of<2>(const cases::MpsCase&, const Filling<2>&);
extern template Members members_of<3>(const cases::MpsCase&, const Filling<3>&);
extern template std::vector<std::string> words_of_sides<2>(const cases::MpsCase&, const Members&, const Filling<2>&);
extern template std::vector<std::string> words_of_sides<3>(const cases::MpsCase&, const Members&, const Filling<3>&);
extern template void add_supports<2>(const cases::MpsCase&, const Members&, MpsParts<2>&);
extern template void add_supports<3>(const cases::MpsCase&, const Members&, MpsParts<3>&);

}  // namespace sazare::runs
