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

}  // namespace sazare::cases
