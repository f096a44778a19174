#pragma once

/// Ground of a case whose strength falls with slip, and what its particles make of that.

#include <optional>
#include <span>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/mps/run/filling.hpp"
#include "sazare/methods/mps/softening.hpp"

namespace sazare::runs {

/// What softening takes from the particles of a case.
struct SofteningPlace {
  Real square_of_reach = 0;  ///< M of methods/mps/softening.hpp [m2]
  Real spacing = 0;          ///< [m]
  Real height = 0;           ///< of all ground [m]
  Real pressure = 0;         ///< weight of the heaviest column of ground, per area [Pa]
};

/// `material` is that of each particle.
template <int D>
SofteningPlace softening_place(const cases::MpsCase& mps, const methods::mps::LinkTable<D>& links, const Filling<D>& filling,
                               std::span<const Index> material);

/// Of ground that yields.
laws::MohrCoulomb peak_strength(const cases::Ground& ground);

/// None of ground whose strength stays.
std::optional<methods::mps::Softening> softening_of(const cases::Ground& ground, const SofteningPlace& place);

/// Refuses softening that the particles do not resolve anywhere, and ground that breaks before it has softened.
void check_softening(const cases::CaseFile& file, const SofteningPlace& place);

/// Of bands that have no room, and of those that are too narrow for the particles deep below.
std::string warn_of_softening(const cases::CaseFile& file, const SofteningPlace& place);

/// How each ground softens, ready to print.
std::string softening_lines(const cases::MpsCase& mps, const SofteningPlace& place);

extern template SofteningPlace softening_place<2>(const cases::MpsCase&, const methods::mps::LinkTable<2>&, const Filling<2>&,
                                                  std::span<const Index>);
extern template SofteningPlace softening_place<3>(const cases::MpsCase&, const methods::mps::LinkTable<3>&, const Filling<3>&,
                                                  std::span<const Index>);

}  // namespace sazare::runs
