#include "sazare/cases/format/usual_values.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/units.hpp"

namespace sazare::cases {
namespace {

constexpr Real impossible = 1e30;  // times the largest usual value

bool is_usual(const UsualRange& range, Real number) {
  return number == 0 || std::isinf(number) || (std::abs(number) >= range.low && std::abs(number) <= range.high);
}

/// "2.39 g/cm3 would be 2390": every unit of the field in which the number would be a usual one.
std::string units_that_explain(const Key& key, Real number) {
  constexpr std::array units{"g/cm3", "kPa", "MPa", "GPa",   "MPa/m", "GPa/m", "MPa/mm", "N/mm", "kJ/m2", "km/s", "ms",  "us",
                             "mm",    "rad", "%",   "cm/s2", "mm/s2", "cm2",   "mm2",    "cm4",  "mm4",   "kN",   "kN m"};
  std::string text;
  for (const char* const unit : units) {
    const auto in_unit = converted({number, unit}, key.unit);
    if (!in_unit || !std::isfinite(*in_unit) || !is_usual(key.usual, *in_unit)) continue;
    text +=
        fmt::format("{}{} {} would be {}", text.empty() ? "" : ", ", short_number(number, 6), unit, short_number(*in_unit, 6));
  }
  return text;
}

}  // namespace

bool warn_of_unusual(const Key& key, const Value& value, Real number, Problems& problems) {
  if (is_usual(key.usual, number)) return true;
  const bool below = std::abs(number) < key.usual.low;
  if (!below && std::abs(number) / key.usual.high > impossible) {
    problems.error(value.place,
                   fmt::format("{} = {}{}{} is beyond anything that can be computed with: usual are {} to {}", key.name,
                               short_number(number, 6), key.unit.empty() ? "" : " ", key.unit, short_number(key.usual.low),
                               short_number(key.usual.high)),
                   "check the power of ten");
    return false;
  }
  const std::string units = units_that_explain(key, number);
  problems.warning(
      value.place,
      fmt::format("{} = {}{}{} is unusual: it is {} {}", key.name, short_number(number, 6), key.unit.empty() ? "" : " ", key.unit,
                  below ? "below" : "above", short_number(below ? key.usual.low : key.usual.high)),
      fmt::format("{}{}", units, units.empty() ? "check the unit and the power of ten" : "; otherwise check the power of ten"));
  return true;
}

}  // namespace sazare::cases
