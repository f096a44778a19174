#include "sazare/cases/format/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sazare::cases {
namespace {

/// Decimal digits d1 d2 d3 ... and exponent of d1.d2d3...
struct Decimal {
  std::string digits;
  int exponent = 0;
};

/// `scientific` is what "{:e}" prints: d.ddde+xx
Decimal decimal(const std::string& scientific) {
  const std::size_t e = scientific.find('e');
  Decimal result;
  for (char c : scientific.substr(0, e))
    if (c != '.') result.digits += c;
  result.exponent = std::stoi(scientific.substr(e + 1));
  while (result.digits.size() > 1 && result.digits.back() == '0') result.digits.pop_back();
  return result;
}

/// The digits with the decimal point after `whole` of them.
std::string with_point(const std::string& digits, int whole) {
  const int count = static_cast<int>(digits.size());
  if (whole <= 0) return "0." + std::string(static_cast<std::size_t>(-whole), '0') + digits;
  if (whole >= count) return digits + std::string(static_cast<std::size_t>(whole - count), '0');
  return digits.substr(0, static_cast<std::size_t>(whole)) + '.' + digits.substr(static_cast<std::size_t>(whole));
}

std::string engineering(const Decimal& number) {
  const int exponent = number.exponent;
  if (exponent >= -3 && exponent < 6) return with_point(number.digits, exponent + 1);
  const int thousands = 3 * static_cast<int>(std::floor(exponent / 3.0));
  return fmt::format("{}e{}", with_point(number.digits, exponent - thousands + 1), thousands);
}

std::string text(Real value, const std::string& scientific) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (value == 0) return "0";
  return fmt::format("{}{}", value < 0 ? "-" : "", engineering(decimal(scientific)));
}

/// The shortest digits that read back to the same number, as d.ddde+xx.
std::string shortest_scientific(Real magnitude) {
  for (int digits = 0; digits < 17; ++digits) {
    std::string candidate = fmt::format("{:.{}e}", magnitude, digits);
    if (std::strtod(candidate.c_str(), nullptr) == magnitude) return candidate;
  }
  return fmt::format("{:.17e}", magnitude);
}

}  // namespace

std::string number_text(Real value) {
  std::string result = text(value, shortest_scientific(std::abs(value)));
  const bool plain = result.find_first_of(".en") == std::string::npos;
  return plain ? result + ".0" : result;
}

std::string short_number(Real value, int digits) { return text(value, fmt::format("{:.{}e}", std::abs(value), digits - 1)); }

std::string string_text(const std::string& value) {
  std::string out = "\"";
  for (char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (code < 0x20 || code == 0x7f)
      out += fmt::format("\\u{:04x}", code);
    else
      out += c;
  }
  return out + '"';
}

}  // namespace sazare::cases
