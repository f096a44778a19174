#include "sazare/cases/format/structure_check.hpp"

#include <fmt/format.h>

#include <vector>

#include "sazare/cases/format/suggest.hpp"
#include "sazare/cases/format/value_check.hpp"

namespace sazare::cases {
namespace {

std::vector<std::string> key_names(const Table& table) {
  std::vector<std::string> names;
  for (const Key& key : table.keys) names.emplace_back(key.name);
  return names;
}

std::vector<std::string> table_names(std::span<const Table> schema) {
  std::vector<std::string> names;
  for (const Table& table : schema) names.emplace_back(table.name);
  return names;
}

/// The tables that have this key, as "[time]" or "[[joints]] and [contact]".
std::string tables_with_key(std::span<const Table> schema, std::string_view key) {
  std::string out;
  for (const Table& table : schema)
    if (find_key(table, key) != nullptr) out += (out.empty() ? "" : " or ") + table_header(table);
  return out;
}

class StructureCheck {
public:
  StructureCheck(std::span<const Table> schema, Problems& problems) : schema_(schema), problems_(problems) {}

  void run(Value& root) {
    for (Member& member : std::get<Value::Members>(root.data)) check_member(member);
    for (const Table& table : schema_)
      if (table.need == Need::required && root.find(table.name) == nullptr) report_missing(table);
  }

private:
  void report_missing(const Table& table) {
    std::string keys;
    for (const Key& key : table.keys)
      if (key.need == Need::required) keys += (keys.empty() ? "" : ", ") + std::string(key.name);
    problems_.error({}, fmt::format("the case has no {}", table_header(table)),
                    fmt::format("add {}{}: {}", table_header(table), keys.empty() ? "" : " with " + keys, table.sentence));
  }

  void check_member(Member& member) {
    const Table* table = find_table(schema_, member.key);
    if (table == nullptr) {
      report_unknown_table(member);
    } else if (table->repeated) {
      check_list(*table, member);
    } else if (member.value.is_table()) {
      check_table(*table, member.value);
    } else {
      member.value.wrong = true;
      const std::string help = fmt::format("write {} and its keys below it", table_header(*table));
      problems_.error(member.key_place, fmt::format("{} is one table", member.key), help);
    }
  }

  void report_unknown_table(const Member& member) {
    const bool is_key = !member.value.is_table() && !member.value.is_list();
    const std::string owners = is_key ? tables_with_key(schema_, member.key) : "";
    if (!owners.empty()) {
      problems_.error(member.key_place, fmt::format("\"{}\" stands outside any table", member.key),
                      fmt::format("it is a key of {}", owners));
      return;
    }
    problems_.error(member.key_place, fmt::format("unknown {} \"{}\"", is_key ? "key" : "table", member.key),
                    suggestion(member.key, table_names(schema_), "tables"));
  }

  void check_list(const Table& table, Member& member) {
    auto* items = std::get_if<Value::Items>(&member.value.data);
    if (items == nullptr) {
      member.value.wrong = true;
      problems_.error(member.key_place, fmt::format("{} is a list of tables", member.key),
                      fmt::format("write {} with double brackets, once for each entry", table_header(table)));
      return;
    }
    for (Value& item : *items) {
      if (item.is_table()) {
        check_table(table, item);
        continue;
      }
      item.wrong = true;
      problems_.error(item.place, fmt::format("an entry of {} is a table, found {}", member.key, describe(item)),
                      fmt::format("write {} and the keys of the entry below it", table_header(table)));
    }
    if (items->empty() && table.need == Need::required)
      problems_.error(member.key_place, fmt::format("{} needs at least one entry", member.key), std::string(table.sentence));
  }

  void check_table(const Table& table, Value& value) {
    for (Member& member : std::get<Value::Members>(value.data)) {
      const Key* key = find_key(table, member.key);
      if (key != nullptr)
        check_value(*key, member.value, problems_);
      else
        report_unknown_key(table, member);
    }
    for (const Key& key : table.keys) {
      if (key.need != Need::required || value.find(key.name) != nullptr) continue;
      problems_.error(value.place, fmt::format("{} has no \"{}\"", table_header(table), key.name), how_to_add(key));
    }
  }

  void report_unknown_key(const Table& table, const Member& member) {
    const auto names = key_names(table);
    const std::string what = fmt::format("unknown key \"{}\" in {}", member.key, table_header(table));
    const std::string owners = tables_with_key(schema_, member.key);
    problems_.error(member.key_place, what,
                    owners.empty() ? suggestion(member.key, names, "keys") : fmt::format("it is a key of {}", owners));
  }

  std::span<const Table> schema_;
  Problems& problems_;
};

}  // namespace

std::string table_header(const Table& table) {
  return table.repeated ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name);
}

std::string how_to_add(const Key& key) {
  const std::string range = range_text(key.range);
  return fmt::format("add {} = ... ({}{}{}): {}", key.name, type_text(key), range.empty() ? "" : ", ", range, key.sentence);
}

void check_structure(Value& root, std::span<const Table> schema, Problems& problems) {
  StructureCheck(schema, problems).run(root);
}

}  // namespace sazare::cases
