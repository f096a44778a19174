#pragma once

#include <string_view>
#include <vector>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/format/field_reader.hpp"

namespace sazare::cases {

/// Fills the case of a method from the document; the visitor of its `visit_tables`.
class CaseReader {
public:
  explicit CaseReader(const CheckContext& context) : context_(context) {}

  template <class Case>
  Case read() {
    Case result;
    const Entry head = context_.entries_of("case").front();
    FieldReader(head, context_.folder)("title", result.title);
    visit_tables(*this, result);
    return result;
  }

  template <class Item>
  void one(std::string_view table, Item& item) {
    const Entry entry = context_.entries_of(table).front();
    FieldReader reader(entry, context_.folder);
    visit_fields(reader, item);
  }

  template <class Item>
  void list(std::string_view table, std::vector<Item>& items) {
    for (const Entry& entry : context_.entries_of(table)) {
      FieldReader reader(entry, context_.folder);
      visit_fields(reader, items.emplace_back());
    }
  }

private:
  const CheckContext& context_;
};

}  // namespace sazare::cases
