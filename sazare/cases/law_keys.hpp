#pragma once

/// Keys for what the laws of a list take, and tables of keys joined with them.

#include <algorithm>
#include <array>

#include "sazare/cases/format/schema.hpp"
#include "sazare/laws/law_list.hpp"

namespace sazare::cases {

/// A key for each parameter of the laws of a list.
template <class Laws>
consteval auto keys_of_laws() {
  constexpr auto& parameters = laws::parameters_of_laws<Laws>;
  std::array<Key, parameters.size()> keys{};
  for (std::size_t n = 0; n < keys.size(); ++n)
    keys[n] = {.name = parameters[n].name,
               .type = Type::number,
               .unit = parameters[n].unit,
               .range = parameters[n].may_be_zero ? not_negative : positive,
               .usual = {parameters[n].usual_least, parameters[n].usual_most},
               .note = parameters[n].note,
               .sentence = parameters[n].sentence};
  return keys;
}

template <std::size_t... counts>
consteval auto joined(const std::array<Key, counts>&... parts) {
  std::array<Key, (counts + ...)> all{};
  auto next = all.begin();
  ((next = std::copy(parts.begin(), parts.end(), next)), ...);
  return all;
}

}  // namespace sazare::cases
