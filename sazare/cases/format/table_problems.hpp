#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "sazare/cases/format/csv_fields.hpp"

namespace sazare::cases {

/// The faults of a table in a file that a case names, told at their line and column: ten at most, after which no row is read.
class TableProblems {
public:
  /// `kind` of file in words, such as "table".
  TableProblems(int source, const Place& named_at, Problems& problems, std::string_view kind)
      : source_(source), named_at_(named_at), problems_(problems), kind_(kind) {}

  /// At a line counted from 1; at the whole file where it is 0.
  void report(int line, const Field& field, const std::string& what, std::string help);

  /// Whether the field is a number; else reports it.
  bool read_number(int line, const Field& field, std::string_view name, Real& value);

  /// Calls read_row(line, text) for those of the file's lines below the titles that are not blank.
  template <class ReadRow>
  void read_rows(const std::vector<std::string>& lines, ReadRow&& read_row) const {
    for (std::size_t i = 1; i < lines.size() && !are_full(); ++i)
      if (!trimmed(lines[i], 0, lines[i].size()).text.empty()) read_row(static_cast<int>(i) + 1, lines[i]);
  }

  bool any() const { return errors_ > 0; }
  bool are_full() const { return errors_ >= most; }

private:
  static constexpr int most = 10;

  int source_;
  Place named_at_;
  Problems& problems_;
  std::string kind_;
  int errors_ = 0;
};

}  // namespace sazare::cases
