#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

#include "sazare/cases/case_format.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/method_choice.hpp"
#include "sazare/cases/study_file.hpp"

namespace sazare::cases {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* page_head = R"(# The case file

A case is a TOML file. All numbers are in SI units, given here for each key; file names are relative to the case
file. Keys that are not listed are errors. `sazare check CASE` reads a case, lists everything that is wrong, and
prints it with the defaults that hold for it. `--set table.key=value` changes a key for one run; entries of a list are numbered
from 0: `--set joints.0.cohesion=5e6`.

This page is written from the table that also checks cases. `sazare schema` prints the same as a JSON schema for
editors.
)";

void add_range(Json& json, const Range& range) {
  if (std::isfinite(range.low)) json[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) json[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
}

Json list_of(Json item, std::size_t least, std::size_t most) {
  Json json{{"type", "array"}, {"items", std::move(item)}};
  if (least > 0) json["minItems"] = least;
  if (most > 0) json["maxItems"] = most;
  return json;
}

Json type_json(const Key& key) {
  switch (key.type) {
    case Type::text:
    case Type::file:
      return {{"type", "string"}, {"minLength", 1}};
    case Type::choice:
      return {{"type", "string"}, {"enum", std::vector<std::string_view>(key.choices.begin(), key.choices.end())}};
    case Type::boolean:
      return {{"type", "boolean"}};
    case Type::number:
    case Type::integer: {
      Json json{{"type", key.type == Type::integer ? "integer" : "number"}};
      add_range(json, key.range);
      return json;
    }
    case Type::vector:
      return list_of({{"type", "number"}}, 3, 3);
    case Type::names:
      return list_of({{"type", "string"}}, 1, 0);
    case Type::two_names:
      return list_of({{"type", "string"}}, 2, 2);
    case Type::axes:
      return list_of({{"type", "string"}, {"enum", {"x", "y", "z"}}}, 0, 3);
    case Type::numbers:
      return {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}};
    case Type::values:
      return list_of({{"type", "number"}}, 1, 0);
    case Type::points:
      return list_of(list_of({{"type", "number"}}, 2, 2), 3, 0);
  }
  return {};
}

/// Unit, sentence, note and default in one line, as editors show them.
std::string description(const Key& key) {
  std::string out(key.sentence);
  if (!key.unit.empty()) out += fmt::format(" [{}]", key.unit);
  if (!key.note.empty()) out += fmt::format(" ({})", key.note);
  if (!key.default_text.empty()) out += fmt::format(" Default: {}.", key.default_text);
  return out;
}

Json table_json(const Table& table) {
  Json properties = Json::object();
  std::vector<std::string_view> required;
  for (const Key& key : table.keys) {
    Json json = type_json(key);
    json["description"] = description(key);
    properties[std::string(key.name)] = std::move(json);
    if (key.need == Need::required) required.push_back(key.name);
  }
  Json object{{"type", "object"},
              {"description", table.sentence},
              {"properties", std::move(properties)},
              {"additionalProperties", false}};
  if (!required.empty()) object["required"] = required;
  return table.repeated ? list_of(std::move(object), table.need == Need::required ? 1 : 0, 0) : object;
}

std::string need_text(const Key& key) {
  if (key.need == Need::required) return "required";
  std::string out = key.default_text.empty() ? "" : fmt::format("`{}`", key.default_text);
  if (!key.note.empty()) out += fmt::format("{}{}", out.empty() ? "" : "; ", key.note);
  return out;
}

std::string markdown_type(const Key& key) {
  if (key.type != Type::choice) {
    switch (key.type) {
      case Type::text:
        return "text";
      case Type::boolean:
        return "`true` or `false`";
      case Type::number:
        return "number";
      case Type::integer:
        return "whole number";
      case Type::vector:
        return "three numbers";
      case Type::names:
        return "names";
      case Type::two_names:
        return "two names";
      case Type::axes:
        return "axes";
      case Type::file:
        return "file";
      case Type::points:
        return "points";
      case Type::values:
        return "numbers";
      default:
        return "names and numbers";
    }
  }
  std::string out;
  for (std::string_view word : key.choices) out += fmt::format("{}`\"{}\"`", out.empty() ? "" : ", ", word);
  return out;
}

std::string markdown_range(const Key& key) {
  std::string range = range_text(key.range);
  if (key.range.infinite) range += ", or inf";
  if (key.usual.low > 0 || std::isfinite(key.usual.high))
    range += fmt::format("; usually {} to {}", short_number(key.usual.low), short_number(key.usual.high));
  return range;
}

Json method_json(std::string_view method, std::span<const Table> tables) {
  Json properties = Json::object();
  std::vector<std::string_view> required;
  for (const Table& table : tables) {
    properties[std::string(table.name)] = table_json(table);
    if (table.need == Need::required) required.push_back(table.name);
  }
  properties["case"]["properties"]["method"] = {{"const", method}};
  return {{"title", fmt::format("Sazare case, method {}", method)},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"required", required},
          {"additionalProperties", false}};
}

void append_table(std::string& out, const Table& table) {
  const std::string_view how = table.repeated                 ? (table.need == Need::required ? " At least one." : " Any number.")
                               : table.need == Need::required ? " Required."
                                                              : " Optional.";
  out += fmt::format("\n## `{}`\n\n{}{}\n\n", table_header(table), table.sentence, how);
  out += "| key | value | unit | range | default or need | meaning |\n|---|---|---|---|---|---|\n";
  for (const Key& key : table.keys)
    out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, markdown_type(key), key.unit, markdown_range(key),
                       need_text(key), key.sentence);
}

}  // namespace

std::string schema_json(CaseFormats formats) {
  Json alternatives = Json::array();
  for (const CaseFormat& format : formats)
    alternatives.push_back(method_json(format.method, TablesWithChoice(formats, format.tables).tables()));
  const Json json{
      {"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Sazare case"}, {"oneOf", std::move(alternatives)}};
  return json.dump(2) + "\n";
}

std::string schema_markdown(CaseFormats formats) {
  std::string out = page_head;
  for (const CaseFormat& format : formats) {
    out += fmt::format("\n# Method `{}`\n", format.method);
    const TablesWithChoice with_choice(formats, format.tables);
    for (const Table& table : with_choice.tables()) append_table(out, table);
  }
  out += "\n# Study files\n\nFamilies of cases for `sazare study`: every combination of the parameters, for every family.\n";
  for (const Table& table : study_schema()) append_table(out, table);
  return out;
}

}  // namespace sazare::cases
