#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sazare/cases/format/document.hpp"

namespace sazare::cases {
namespace {

constexpr std::size_t deepest_path = 64;
constexpr std::string_view form = "write it as --set table.key=value, such as --set time.end=1e-3";

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t dot = path.find('.');
    parts.emplace_back(path.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    path.remove_prefix(dot + 1);
  }
}

void set_places(Value& value, const Place& place) {
  value.place = place;
  if (auto* items = std::get_if<Value::Items>(&value.data))
    for (Value& item : *items) set_places(item, place);
  if (auto* members = std::get_if<Value::Members>(&value.data)) {
    for (Member& member : *members) {
      member.key_place = place;
      set_places(member.value, place);
    }
  }
}

/// The value as TOML; a word that is not a TOML value is taken as a string, since shells eat quotes.
Value parse_value(const std::string& text, const Place& place) {
  Problems ignored;
  ignored.add_source(source_from_text("", text));
  Value result;
  const bool one_line = text.find('\n') == std::string::npos;
  auto document = one_line ? parse_document("value = " + text, 0, ignored) : std::nullopt;
  if (document && document->members()->size() == 1)
    result = std::move(*document->find("value"));
  else
    result.data = text;
  set_places(result, place);
  return result;
}

struct Override {
  std::vector<std::string> path;
  Place path_place;
  Place value_place;
};

/// The entry of `list` that the text numbers, or nullptr with a problem.
Value* find_entry(Value::Items& list, const std::string& index_text, const std::string& list_name, const Place& place,
                  Problems& problems) {
  std::size_t index = 0;
  const char* end = index_text.data() + index_text.size();
  const auto [stop, failure] = std::from_chars(index_text.data(), end, index);
  const std::string last = list.empty()       ? "it is empty"
                           : list.size() == 1 ? "it has only entry 0"
                                              : fmt::format("it has entries 0 to {}", list.size() - 1);
  if (failure != std::errc{} || stop != end) {
    problems.error(place, fmt::format("{} is a list: a number was expected after it, found \"{}\"", list_name, index_text),
                   fmt::format("write {}.0 for the first entry; {}", list_name, last));
    return nullptr;
  }
  if (index >= list.size()) {
    problems.error(place, fmt::format("{} has no entry {}", list_name, index), last);
    return nullptr;
  }
  return &list[index];
}

/// Walks to the parent of the last part, making tables that are missing.
void put(Value& root, const Override& setting, Value value, Problems& problems) {
  Value* at = &root;
  std::string name;
  for (std::size_t i = 0; i < setting.path.size(); ++i) {
    const std::string& part = setting.path[i];
    const bool is_last = i + 1 == setting.path.size();
    Value* next = nullptr;
    if (auto* items = std::get_if<Value::Items>(&at->data)) {
      next = find_entry(*items, part, name, setting.path_place, problems);
      if (next == nullptr) return;
    } else if (auto* members = std::get_if<Value::Members>(&at->data)) {
      next = at->find(part);
      if (next == nullptr) {
        members->push_back({part, setting.path_place, Value{Value::Members{}, setting.path_place}});
        next = &members->back().value;
      } else if (is_last) {
        std::ranges::find(*members, part, &Member::key)->key_place = setting.path_place;
      }
    } else {
      problems.error(setting.path_place, fmt::format("{} is not a table, it has no key {}", name, part), std::string(form));
      return;
    }
    name += (name.empty() ? "" : ".") + part;
    at = next;
  }
  *at = std::move(value);
}

}  // namespace

void apply_override(Value& root, const std::string& setting, Problems& problems, const std::string& side) {
  const std::size_t equals = setting.find('=');
  const std::string key = setting.substr(0, equals);
  Source source = source_from_text(key.empty() ? "--set" : "--set " + side + key, "--set " + side + setting);
  source.has_line_numbers = false;
  const int index = problems.add_source(std::move(source));
  const int begin = static_cast<int>(std::string_view("--set ").size() + side.size()) + 1;
  Override change{split_path(key), {index, 1, begin, std::max<int>(1, static_cast<int>(key.size()))}, {}};
  if (equals == std::string::npos || key.empty() || change.path.size() > deepest_path || std::ranges::count(change.path, std::string()) > 0) {
    problems.error(change.path_place, "this is not of the form table.key=value", std::string(form));
    return;
  }
  const std::string text = setting.substr(equals + 1);
  const int width = std::max<int>(1, static_cast<int>(text.size()));
  change.value_place = {index, 1, begin + static_cast<int>(equals) + 1, width};
  if (text.empty()) {
    problems.error(change.value_place, fmt::format("there is no value for {}", key), std::string(form));
    return;
  }
  put(root, change, parse_value(text, change.value_place), problems);
}

}  // namespace sazare::cases
