#include "sazare/cases/format/case_text.hpp"

namespace sazare::cases {

Place Entry::place(std::string_view key) const {
  const Value* found = value == nullptr ? nullptr : value->find(key);
  return found == nullptr ? header() : found->place;
}

Place Entry::place(std::string_view key, std::size_t position) const {
  const Value* found = value == nullptr ? nullptr : value->find(key);
  const auto* items = found == nullptr ? nullptr : found->items();
  return items == nullptr || position >= items->size() ? place(key) : (*items)[position].place;
}

std::vector<Entry> entries(const Value& root, const Table& table) {
  const Value* value = root.find(table.name);
  if (!table.repeated) return {{value != nullptr && value->is_table() ? value : nullptr, &table}};
  std::vector<Entry> result;
  if (value == nullptr || !value->is_list()) return result;
  for (const Value& item : *value->items()) result.push_back({item.is_table() ? &item : nullptr, &table});
  return result;
}

}  // namespace sazare::cases
