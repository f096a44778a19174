#pragma once

/// Words with which `check` explains a case, for all methods.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/enum_words.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/tables.hpp"

namespace sazare::cases {

/// A number with so many significant digits.
inline std::string number(Real value, int digits = 4) { return short_number(value, digits); }

/// "(1, 0, -2.5)"
std::string vector_text(const Vector3& value);

/// A value of a choice as it stands in a case.
template <class Enum>
std::string_view word(Enum value) {
  return EnumWords<Enum>::words.at(static_cast<std::size_t>(value));
}

/// A line of the explanation: what it is about, and the text.
std::string line(std::string_view topic, std::string_view text);

/// ", x moves as base" for each axis along which a motion is given; of an incident wave ", wave enters along x".
std::string motion_names_text(std::span<const std::string> motion, bool is_incident_wave = false);

/// Lines of all motions with their peaks in SI units and in those of records [gal, cm/s, cm].
std::string explain_motions(const std::vector<Motion>& motions, Real end);

/// The tension cut-off of a Mohr-Coulomb strength.
std::string cut_off_text(const std::optional<Real>& tensile_strength);

/// A line where there is gravity.
std::string explain_gravity(const Vector3& acceleration, std::string_view more = "");

/// A line of the wave velocities [m/s] of a material, and of the frequency of S waves that are ten elements or particles of this
/// size [m] long: shorter ones are not followed well.
std::string explain_waves(const std::string& material, Real p_wave, Real s_wave, Real size);

/// "9.17e4 kg, weight 899 kN", with N, kN or MN by its size; of a body in the plane per metre.
std::string mass_text(Real mass, bool in_plane = false);

/// Warns, at its entry, of each motion whose own frequency is above that of S waves of this velocity [m/s] that are ten elements
/// or particles of this size [m] long: that of a wavelet, of a record the largest acceleration over that of its velocity.
std::string warn_of_short_waves(const CaseSource& source, const std::vector<Motion>& motions, Real end, Real s_wave, Real size);

/// "limit 1.2e-5 s"; says so where no springs act and any step is stable.
std::string limit_text(Real limit, int digits = 4);

/// "6.66e6 Pa (6.66 MPa)"; without brackets below a thousand pascals.
std::string stress_text(Real stress);

}  // namespace sazare::cases
