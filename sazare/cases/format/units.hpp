#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sazare/core/vector.hpp"

/// Reads texts such as "450 GPa", only to say in a message what the number in SI units would be. Case files
/// hold plain numbers.
namespace sazare::cases {

inline constexpr Real standard_gravity = 9.80665;  // m/s2

struct Quantity {
  Real value = 0;    // as written
  std::string unit;  // as written, may be empty
};

/// The number and the unit in a text such as "450 GPa"; nothing when it does not begin with a number.
std::optional<Quantity> parse_quantity(std::string_view text);

/// The quantity's value in `unit`; nothing when its unit is unknown or measures something else.
std::optional<Real> converted(const Quantity& quantity, std::string_view unit);

/// True when the text is a unit that is known here.
bool is_unit(std::string_view unit);

}  // namespace sazare::cases
