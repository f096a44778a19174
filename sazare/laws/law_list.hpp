#pragma once

/// Lists of laws: std::tuple of types, of which a case chooses one by its word.
///
/// A law of such a list has `word`, the word of the case that chooses it, and `parameters`, a std::array of LawParameter: what it
/// takes beside what all laws of the list take. Both become keys of the case, with their checks and their page of the reference.

#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

/// A number that a law takes beside those which all laws of its list take.
struct LawParameter {
  std::string_view name;
  std::string_view unit;
  std::string_view note;      ///< when it is required
  std::string_view sentence;  ///< what it is
  bool may_be_zero = false;
  bool may_be_absent = false;
  Real usual_least = 0;  ///< between these its numbers lie in practice
  Real usual_most = std::numeric_limits<Real>::infinity();
};

/// The place of a law in a list; only a law of the list compiles.
template <class Laws, class Law, std::size_t n = 0>
consteval int place_of_law() {
  if constexpr (std::is_same_v<Law, std::tuple_element_t<n, Laws>>)
    return n;
  else
    return place_of_law<Laws, Law, n + 1>();
}

/// Returns visit(Law{}) for the law at a place of a list.
template <class Laws, std::size_t n = 0, class Visitor>
auto visit_law_at(std::size_t place, Visitor&& visit) {
  if constexpr (n + 1 < std::tuple_size_v<Laws>) {
    if (place != n) return visit_law_at<Laws, n + 1>(place, std::forward<Visitor>(visit));
  } else {
    assert(place == n && "the place is one of the list");
  }
  return visit(std::tuple_element_t<n, Laws>{});
}

/// The words that choose the laws of a list, in its order.
template <class Laws>
inline constexpr auto words_of_laws = []<std::size_t... n>(std::index_sequence<n...>) {
  return std::array{std::tuple_element_t<n, Laws>::word...};
}
(std::make_index_sequence<std::tuple_size_v<Laws>>{});

namespace detail {

/// The parameters of all laws, each once, and how many they are.
template <class... Laws>
consteval auto all_parameters(const std::tuple<Laws...>*) {
  std::pair<std::array<LawParameter, (Laws::parameters.size() + ... + 0)>, std::size_t> all{};
  const auto add = [&](const LawParameter& parameter) {
    for (std::size_t n = 0; n < all.second; ++n)
      if (all.first[n].name == parameter.name) return;
    all.first[all.second++] = parameter;
  };
  const auto add_those_of = [&](const auto& parameters) {
    for (const LawParameter& parameter : parameters) add(parameter);
  };
  (add_those_of(Laws::parameters), ...);
  return all;
}

}  // namespace detail

/// The parameters of all laws of a list, each once: laws may share a parameter.
template <class Laws>
inline constexpr auto parameters_of_laws = [] {
  constexpr auto all = detail::all_parameters(static_cast<const Laws*>(nullptr));
  std::array<LawParameter, all.second> each{};
  for (std::size_t n = 0; n < each.size(); ++n) each[n] = all.first[n];
  return each;
}();

/// Whether a law takes a parameter.
template <class Law>
constexpr bool takes(std::string_view parameter) {
  for (const LawParameter& own : Law::parameters)
    if (own.name == parameter) return true;
  return false;
}

/// Picks from the values of all parameters of a list those that a law takes, in the order of the law.
template <class Laws, class Law, class Value>
std::array<Value, Law::parameters.size()> own_parameters(const std::array<Value, parameters_of_laws<Laws>.size()>& all) {
  std::array<Value, Law::parameters.size()> own{};
  for (std::size_t n = 0; n < all.size(); ++n)
    for (std::size_t k = 0; k < own.size(); ++k)
      if (Law::parameters[k].name == parameters_of_laws<Laws>[n].name) own[k] = all[n];
  return own;
}

/// The value of one of the parameters of a list, by its name.
template <class Laws, class Value>
const Value& parameter_of(const std::array<Value, parameters_of_laws<Laws>.size()>& all, std::string_view name) {
  std::size_t place = 0;
  while (parameters_of_laws<Laws>[place].name != name) ++place;
  return all[place];
}

}  // namespace sazare::laws
