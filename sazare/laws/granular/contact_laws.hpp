#pragma once

/// The laws of granular contact: all that is chosen by law goes through this list. A law is a type with the members that `Hertz`
/// has. A law that is added to the list is a word of contact.model, and its parameters are keys of [contact] and [[pairs]].
///
/// Spheres touch when they overlap. Where a law adheres, they remain in contact until the neck between them breaks, and the law
/// has these members as well:
///
///     holds(constants, overlap, radius)          whether spheres in contact remain so, at an overlap that may be negative
///     neck(constants, reduced_radius)            the largest gap across which they remain in contact [m]
///     parting_loss(constants, reduced_radius)    energy of the normal spring when the neck breaks, which is dissipated [J]

#include <cassert>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sazare/laws/granular/hertz.hpp"
#include "sazare/laws/granular/jkr.hpp"
#include "sazare/laws/granular/linear.hpp"

namespace sazare::laws {

using ContactLaws = std::tuple<Hertz, Linear, Jkr>;

inline constexpr std::size_t contact_law_count = std::tuple_size_v<ContactLaws>;

/// Where a law stands in the list; only one that is in it compiles.
template <class Law, std::size_t n = 0>
consteval int number_of_law() {
  if constexpr (std::is_same_v<Law, std::tuple_element_t<n, ContactLaws>>)
    return n;
  else
    return number_of_law<Law, n + 1>();
}

/// Names for the laws where none is known at compile time.
enum class ContactModel { hertz = number_of_law<Hertz>(), linear = number_of_law<Linear>(), jkr = number_of_law<Jkr>() };

template <class Law>
inline constexpr ContactModel model_of = static_cast<ContactModel>(number_of_law<Law>());

/// What `visit(Law{})` returns for the law of a model.
template <std::size_t n = 0, class Visitor>
auto visit_law(ContactModel model, Visitor&& visit) {
  const bool is_this = static_cast<std::size_t>(model) == n;
  if constexpr (n + 1 < contact_law_count) {
    if (!is_this) return visit_law<n + 1>(model, std::forward<Visitor>(visit));
  } else {
    assert(is_this && "a model is a law of the list");
  }
  return visit(std::tuple_element_t<n, ContactLaws>{});
}

/// The words of contact.model, in the order of the list.
inline constexpr auto contact_law_words = []<std::size_t... n>(std::index_sequence<n...>) {
  return std::array{std::tuple_element_t<n, ContactLaws>::word...};
}(std::make_index_sequence<contact_law_count>{});

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

/// What laws take of two materials beside restitution and friction. Laws may share a parameter.
inline constexpr auto law_parameters = [] {
  constexpr auto all = detail::all_parameters(static_cast<const ContactLaws*>(nullptr));
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

/// Energy in the normal spring of a pair at an overlap [J].
inline Real normal_energy(ContactModel model, const ContactConstants<Real>& constants, Real overlap, Real reduced_radius) {
  if (!(overlap > 0)) return 0;
  return visit_law(model, [&]<class Law>(Law) { return Law::stored_energy(constants, overlap, reduced_radius); });
}

/// The overlap at which the normal spring of a pair holds an energy [m].
inline Real overlap_of_energy(ContactModel model, const ContactConstants<Real>& constants, Real energy, Real reduced_radius) {
  if (!(energy > 0)) return 0;
  return visit_law(model, [&]<class Law>(Law) { return Law::overlap_of_energy(constants, energy, reduced_radius); });
}

}  // namespace sazare::laws
