#include "sazare/cases/method_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sazare/cases/case_keys.hpp"

namespace sazare::cases {

TablesWithChoice::TablesWithChoice(CaseFormats formats, std::span<const Table> tables) : tables_(tables.begin(), tables.end()) {
  std::vector<std::string_view> sentences;
  for (const CaseFormat& format : formats) {
    names_.push_back(format.method);
    sentences.push_back(format.sentence);
  }
  sentence_ = fmt::format("How the body is modelled: {}.", fmt::join(sentences, ", "));
  keys_.assign(case_keys.begin(), case_keys.end());
  for (Key& key : keys_)
    if (key.name == "method") {
      key.type = Type::choice;
      key.choices = names_;
      key.sentence = sentence_;
    }
  for (Table& table : tables_)
    if (table.name == case_table.name) table.keys = keys_;
}

}  // namespace sazare::cases
