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

#include <tuple>
#include <utility>

#include "sazare/laws/granular/hertz.hpp"
#include "sazare/laws/granular/jkr.hpp"
#include "sazare/laws/granular/linear.hpp"
#include "sazare/laws/granular/mindlin_deresiewicz.hpp"

namespace sazare::laws {

using ContactLaws = std::tuple<Hertz, Linear, Jkr, MindlinDeresiewicz>;

/// Where a law stands in the list; only one that is in it compiles.
template <class Law>
consteval int number_of_law() {
  return place_of_law<ContactLaws, Law>();
}

/// Names for the laws where none is known at compile time.
enum class ContactModel {
  hertz = number_of_law<Hertz>(),
  linear = number_of_law<Linear>(),
  jkr = number_of_law<Jkr>(),
  mindlin_deresiewicz = number_of_law<MindlinDeresiewicz>()
};

template <class Law>
inline constexpr ContactModel model_of = static_cast<ContactModel>(number_of_law<Law>());

/// What `visit(Law{})` returns for the law of a model.
template <class Visitor>
auto visit_law(ContactModel model, Visitor&& visit) {
  return visit_law_at<ContactLaws>(static_cast<std::size_t>(model), std::forward<Visitor>(visit));
}

/// The words of contact.model, in the order of the list.
inline constexpr auto contact_law_words = words_of_laws<ContactLaws>;

/// What laws take of two materials beside restitution and friction.
inline constexpr auto law_parameters = parameters_of_laws<ContactLaws>;

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
