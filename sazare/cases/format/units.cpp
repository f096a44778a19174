#include "sazare/cases/format/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace sazare::cases {
namespace {

/// Factor to SI and the powers of kg, m, s and degree.
struct Unit {
  Real factor = 1;
  std::array<int, 4> powers{};
};

struct Symbol {
  std::string_view name;
  Unit unit;
  bool takes_prefix;
};

constexpr std::size_t longest_quantity = 200;  // characters
constexpr Real degrees_per_radian = 180 / std::numbers::pi;

constexpr std::array symbols{
    Symbol{"Pa", {1, {1, -1, -2, 0}}, true},       Symbol{"N", {1, {1, 1, -2, 0}}, true},
    Symbol{"J", {1, {1, 2, -2, 0}}, true},         Symbol{"m", {1, {0, 1, 0, 0}}, true},
    Symbol{"s", {1, {0, 0, 1, 0}}, true},          Symbol{"g", {1e-3, {1, 0, 0, 0}}, true},
    Symbol{"t", {1e3, {1, 0, 0, 0}}, false},       Symbol{"bar", {1e5, {1, -1, -2, 0}}, true},
    Symbol{"min", {60, {0, 0, 1, 0}}, false},      Symbol{"h", {3600, {0, 0, 1, 0}}, false},
    Symbol{"sec", {1, {0, 0, 1, 0}}, false},       Symbol{"kgf", {standard_gravity, {1, 1, -2, 0}}, false},
    Symbol{"tf", {1000 * standard_gravity, {1, 1, -2, 0}}, false}, Symbol{"psi", {6894.757293168, {1, -1, -2, 0}}, false},
    Symbol{"deg", {1, {0, 0, 0, 1}}, false},       Symbol{"degree", {1, {0, 0, 0, 1}}, false},
    Symbol{"degrees", {1, {0, 0, 0, 1}}, false},   Symbol{"°", {1, {0, 0, 0, 1}}, false},
    Symbol{"Hz", {1, {0, 0, -1, 0}}, true},        Symbol{"rad", {degrees_per_radian, {0, 0, 0, 1}}, false},
};

struct Prefix {
  std::string_view name;
  Real factor;
};

constexpr std::array prefixes{Prefix{"G", 1e9},  Prefix{"M", 1e6},  Prefix{"k", 1e3},  Prefix{"c", 1e-2}, Prefix{"m", 1e-3},
                              Prefix{"µ", 1e-6}, Prefix{"μ", 1e-6}, Prefix{"u", 1e-6}, Prefix{"n", 1e-9}, Prefix{"h", 1e2}};

std::optional<Unit> simple_unit(std::string_view name) {
  for (const Symbol& symbol : symbols)
    if (symbol.name == name) return symbol.unit;
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const Symbol& symbol : symbols) {
      if (!symbol.takes_prefix || symbol.name != name.substr(prefix.name.size())) continue;
      Unit unit = symbol.unit;
      unit.factor *= prefix.factor;
      return unit;
    }
  }
  return std::nullopt;
}

/// A symbol with an optional power: "m3", "s^2", "m²".
std::optional<Unit> powered_unit(std::string_view name) {
  int power = 1;
  for (const auto& [mark, value] : {std::pair{"²", 2}, std::pair{"³", 3}, std::pair{"⁴", 4}}) {
    if (!name.ends_with(mark)) continue;
    name.remove_suffix(std::string_view(mark).size());
    power = value;
  }
  if (!name.empty() && name.back() >= '2' && name.back() <= '4') {
    power = name.back() - '0';
    name.remove_suffix(1);
    if (name.ends_with('^')) name.remove_suffix(1);
  }
  const auto base = simple_unit(name);
  if (!base) return std::nullopt;
  Unit result{std::pow(base->factor, power), {}};
  for (std::size_t i = 0; i < 4; ++i) result.powers[i] = power * base->powers[i];
  return result;
}

/// Products by blank, '*' or '·'; everything after a '/' divides, as people write it: "MN·s/m3", "1/s".
std::optional<Unit> parse_unit(std::string_view text) {
  if (text.starts_with("1/")) text.remove_prefix(1);
  Unit result;
  int sign = 1;
  bool found = false;
  while (!text.empty()) {
    if (text.front() == ' ' || text.front() == '*' || text.starts_with("·")) {
      text.remove_prefix(text.starts_with("·") ? 2 : 1);
      continue;
    }
    if (text.front() == '/') {
      sign = -1;
      text.remove_prefix(1);
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" */"), text.find("·"));
    const auto factor = powered_unit(text.substr(0, end));
    if (!factor) return std::nullopt;
    result.factor *= std::pow(factor->factor, sign);
    for (std::size_t i = 0; i < 4; ++i) result.powers[i] += sign * factor->powers[i];
    found = true;
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end);
  }
  return found ? std::optional(result) : std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view text) {
  text = trimmed(text);
  if (text.size() > longest_quantity) return std::nullopt;
  if (text.starts_with('+')) text.remove_prefix(1);
  Quantity quantity;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), quantity.value);
  if (failure != std::errc{}) return std::nullopt;
  quantity.unit = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return quantity;
}

std::optional<Real> converted(const Quantity& quantity, std::string_view unit) {
  if (quantity.unit.empty()) return quantity.value;
  if (quantity.unit == "%" && unit.empty()) return quantity.value / 100;
  const auto from = parse_unit(quantity.unit);
  const auto to = parse_unit(unit);
  if (!from || !to || from->powers != to->powers) return std::nullopt;
  return quantity.value * from->factor / to->factor;
}

bool is_unit(std::string_view unit) { return parse_unit(unit).has_value(); }

}  // namespace sazare::cases
