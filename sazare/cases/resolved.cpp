#include "sazare/cases/resolved.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "sazare/cases/fem_fields.hpp"
#include "sazare/cases/fields.hpp"
#include "sazare/cases/hybrid_fields.hpp"
#include "sazare/cases/number_text.hpp"
#include "sazare/cases/rectangles_fields.hpp"
#include "sazare/cases/schema.hpp"
#include "sazare/cases/spheres_fields.hpp"
#include "sazare/cases/structure_check.hpp"

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

std::string list_text(const auto& items, auto text_of) {
  std::string out = "[";
  for (std::size_t i = 0; i < items.size(); ++i) out += (i > 0 ? ", " : "") + text_of(items[i]);
  return out + "]";
}

/// A key of an inline table: bare where TOML allows it.
std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && key.find_first_not_of(
                                        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_-") == std::string::npos;
  return bare ? key : string_text(key);
}

/// Writes the keys of one table; the visitor of `visit_fields`.
class FieldWriter {
public:
  FieldWriter(std::string& out, const Table& table, const fs::path& folder) : out_(out), table_(table), folder_(folder) {
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
  std::string text(const fs::path& value) const {
    return string_text((folder_.empty() ? value : value.lexically_relative(fs::absolute(folder_))).string());
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
  const fs::path& folder_;
};

/// The visitor of `visit_tables`.
class CaseWriter {
public:
  CaseWriter(std::span<const Table> schema, const fs::path& folder) : schema_(schema), folder_(folder) {}

  template <class Item>
  void one(std::string_view table, Item item) {
    FieldWriter writer(out, *find_table(schema_, table), folder_);
    visit_fields(writer, item);
  }

  template <class Item>
  void list(std::string_view table, const std::vector<Item>& items) {
    for (const Item& item : items) one(table, item);
  }

  template <class Case>
  std::string write(Case content, const std::string& method) {
    FieldWriter head(out, *find_table(schema_, "case"), folder_);
    head("title", content.title);
    head("method", method);
    visit_tables(*this, content);
    return out;
  }

private:
  std::string out = "# Every key of the case with the value that was used; SI units.\n";
  std::span<const Table> schema_;
  const fs::path& folder_;
};

}  // namespace

std::string write_resolved(const BlocksCase& blocks, const fs::path& folder) {
  return CaseWriter(blocks_schema(), folder).write(blocks, "blocks");
}

std::string write_resolved(const MpsCase& mps, const fs::path& folder) {
  return CaseWriter(mps_schema(), folder).write(mps, "mps");
}

std::string write_resolved(const RectanglesCase& rectangles, const fs::path& folder) {
  return CaseWriter(rectangles_schema(), folder).write(rectangles, "rectangles");
}

std::string write_resolved(const SpheresCase& spheres, const fs::path& folder) {
  return CaseWriter(spheres_schema(), folder).write(spheres, "spheres");
}

std::string write_resolved(const FemCase& fem, const fs::path& folder) {
  return CaseWriter(fem_schema(), folder).write(fem, "fem");
}

std::string write_resolved(const HybridCase& hybrid, const fs::path& folder) {
  return CaseWriter(hybrid_schema(), folder).write(hybrid, "hybrid");
}

}  // namespace sazare::cases
