#include <fmt/format.h>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/seen_names.hpp"

namespace sazare::cases {

void check_unique_names(const CheckContext& context, std::string_view table, std::span<const std::string> names) {
  SeenNames seen;
  const auto list = context.entries_of(table);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string& name = names[i];
    if (name.empty()) continue;
    const Place place = list[i].has("name") ? list[i].place("name") : list[i].place("surface");
    if (name.find_first_of(",\"\n\r") != std::string::npos)
      context.problems.error(place, fmt::format("the name \"{}\" contains a comma, a quote or a line break", name),
                             "names become columns of CSV files; use letters, digits, spaces, '-' and '_'");
    if (const Place* before = seen.before(name, place))
      context.problems.error(place, fmt::format("two of the {} are called \"{}\"", table, name),
                             fmt::format("give each its own name; {}", other_line(*before)));
  }
}

void check_names_apart(const CheckContext& context, std::string_view table, std::span<const std::string> names,
                       std::string_view other, std::span<const std::string> other_names) {
  const auto list = context.entries_of(table), others = context.entries_of(other);
  for (std::size_t i = 0; i < others.size(); ++i)
    for (std::size_t k = 0; k < list.size(); ++k)
      if (!other_names[i].empty() && other_names[i] == names[k])
        context.problems.error(others[i].place("name"),
                               fmt::format("one of the {} and one of the {} are called \"{}\"", table, other, other_names[i]),
                               fmt::format("give each its own name; {}", other_line(list[k].place("name"))));
}

}  // namespace sazare::cases
