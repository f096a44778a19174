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
  const std::filesystem::path& folder_;
};

}  // namespace sazare::cases
