#pragma once

#include <span>
#include <string>
#include <vector>

#include "sazare/cases/format/field_writer.hpp"

namespace sazare::cases {

/// Writes the case of a method with every key that holds for it; the visitor of its `visit_tables`.
class CaseWriter {
public:
  CaseWriter(std::span<const Table> schema, const std::filesystem::path& folder) : schema_(schema), folder_(folder) {}

  /// A table that holds no key is left out.
  template <class Item>
  void one(std::string_view table, const Item& item) {
    const std::size_t before = out.size();
    if (!write_table(table, item)) out.resize(before);
  }

  template <class Item>
  void list(std::string_view table, const std::vector<Item>& items) {
    for (const Item& item : items) write_table(table, item);
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
  /// Whether it holds a key.
  template <class Item>
  bool write_table(std::string_view table, Item item) {
    FieldWriter writer(out, *find_table(schema_, table), folder_);
    const std::size_t head = out.size();
    visit_fields(writer, item);
    return out.size() > head;
  }

  std::string out = "# Every key of the case with the value that was used; SI units.\n";
  std::span<const Table> schema_;
  const std::filesystem::path& folder_;
};

}  // namespace sazare::cases
