#include "sazare/cases/format/table_problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sazare::cases {

void TableProblems::report(int line, const Field& field, const std::string& what, std::string help) {
  if (are_full()) return;
  if (++errors_ == most) help += fmt::format("; the rest of the {} was not read", kind_);
  const int width = std::max<int>(1, static_cast<int>(field.text.size()));
  problems_.error_in_other_file({source_, line, field.column, width}, named_at_, what, std::move(help));
}

bool TableProblems::read_number(int line, const Field& field, std::string_view name, Real& value) {
  const NumberProblem problem = read_number_field(field, name, value);
  if (!problem.what.empty()) report(line, field, problem.what, problem.help);
  return problem.what.empty();
}

}  // namespace sazare::cases
