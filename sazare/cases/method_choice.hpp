#pragma once

#include <string>
#include <vector>

#include "sazare/cases/case_format.hpp"

namespace sazare::cases {

/// The tables of a method with the choices of the key `method`, which only the list of all methods knows.
class TablesWithChoice {
public:
  TablesWithChoice(CaseFormats formats, std::span<const Table> tables);
  TablesWithChoice(const TablesWithChoice&) = delete;
  TablesWithChoice& operator=(const TablesWithChoice&) = delete;

  std::span<const Table> tables() const { return tables_; }

private:
  std::vector<std::string_view> names_;
  std::string sentence_;
  std::vector<Key> keys_;
  std::vector<Table> tables_;
};

}  // namespace sazare::cases
