#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sazare/core/vector.hpp"

/// Lines of CSV files as fields that know where they stand.
namespace sazare::cases {

struct Field {
  std::string_view text;
  int column = 1;
};

/// What stands between two places of a line, without blanks around it.
Field trimmed(std::string_view line, std::size_t begin, std::size_t end);

/// What stands between commas.
std::vector<Field> split(std::string_view line);

/// Without the mark that some programs put before the first line.
std::string_view without_byte_order_mark(std::string_view line);

/// What is wrong with a number; `what` is empty where nothing is.
struct NumberProblem {
  std::string what, help;
};
NumberProblem read_number_field(const Field& field, std::string_view name, Real& value);

}  // namespace sazare::cases
