#pragma once

#include <string>

#include "sazare/core/vector.hpp"

namespace sazare::cases {

/// The shortest text that TOML reads back as exactly this number, with exponents that are multiples of three
/// where an exponent is needed: 2390.0, 450e9, 133e-6, inf.
std::string number_text(Real value);

/// A number for messages and tables: at most `digits` significant digits, and no ".0" after whole numbers.
std::string short_number(Real value, int digits = 6);

/// A TOML string, quoted and escaped.
std::string string_text(const std::string& value);

}  // namespace sazare::cases
