#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sazare/cases/format/enum_words.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/schema.hpp"
#include "sazare/cases/format/structure_check.hpp"

namespace sazare::cases {

/// "[a, b]"
std::string list_text(const auto& items, auto text_of) {
  std::string out = "[";
  for (std::size_t i = 0; i < items.size(); ++i) out += (i > 0 ? ", " : "") + text_of(items[i]);
  return out + "]";
}

/// A key of an inline table: bare where TOML allows it.
inline std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && key.find_first_not_of(
                                        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_-") == std::string::npos;
  return bare ? key : string_text(key);
}

/// Writes the keys of one table; the visitor of `visit_fields`.
class FieldWriter {
public:
  FieldWriter(std::string& out, const Table& table, const std::filesystem::path& folder) : out_(out), table_(table), folder_(folder) {
    out_ += fmt::format("\n{}\n", table_header(table));
  }

  template <class Member>
  void operator()(std::string_view key, const Member& member) {
    line(key, text(member));
  }

  bool has(std::string_view, bool held) const { return held; }

  void friction(Real coefficient) { (*this)("friction_coefficient", coefficient); }

  void line(std::string_view key, const std::string& value) {
    const Key* known = find_key(table_, key);
    if (known == nullptr) throw std::logic_error("key " + std::string(key) + " is missing from the schema");
    if (value.empty()) return;
    const std::string unit = known->unit.empty() ? "" : fmt::format("  # {}", known->unit);
    out_ += fmt::format("{} = {}{}\n", key, value, unit);
  }

private:
  static std::string text(const std::string& value) { return string_text(value); }
  static std::string text(bool value) { return value ? "true" : "false"; }
  static std::string text(int value) { return std::to_string(value); }
  static std::string text(Real value) { return number_text(value); }
  static std::string text(const std::optional<Real>& value) { return value ? number_text(*value) : ""; }
  static std::string text(const Vector3& value) {
    return fmt::format("[{}, {}, {}]", number_text(value.x()), number_text(value.y()), number_text(value.z()));
  }
  std::string text(const std::filesystem::path& value) const {
    return string_text((folder_.empty() ? value : value.lexically_relative(std::filesystem::absolute(folder_))).string());
  }
  static std::string text(const std::vector<std::string>& value) { return list_text(value, string_text); }
  static std::string text(const std::array<std::string, 2>& value) { return list_text(value, string_text); }
  static std::string text(const std::array<bool, 3>& axes) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < 3; ++i)
      if (axes[i]) names.emplace_back(1, static_cast<char>('x' + i));
    return list_text(names, string_text);
  }
  static std::string text(const std::vector<std::array<Real, 2>>& points) {
    return list_text(points,
                     [](const auto& point) { return fmt::format("[{}, {}]", number_text(point[0]), number_text(point[1])); });
  }
  static std::string text(const std::vector<std::pair<std::string, Real>>& value) {
    if (value.empty()) return "{}";
    const std::string list =
        list_text(value, [](const auto& item) { return fmt::format("{} = {}", key_text(item.first), number_text(item.second)); });
    return "{ " + list.substr(1, list.size() - 2) + " }";
  }
  template <class Enum>
  requires requires { EnumWords<Enum>::words; }
  static std::string text(Enum value) {
    return fmt::format("\"{}\"", EnumWords<Enum>::words.at(static_cast<std::size_t>(value)));
  }

  std::string& out_;
  const Table& table_;
  const std::filesystem::path& folder_;
};

}  // namespace sazare::cases
