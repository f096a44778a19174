#pragma once

/// Elements and supports that meet: squares against squares, walls and circles, wherever they touch.
///
/// Each point at which two outlines overlap has a spring and a dashpot normal to the face; along the face one spring serves
/// both points of a pair: laws/face_contact.hpp. A spring at each end of a face is the paper's layout (13.2): an element that
/// lies on a wall has the forces of (3) and (12), however far it turns. Circles have one point: the ordinary circular element.

#include <span>
#include <vector>

#include "sazare/laws/face_contact.hpp"
#include "sazare/methods/rectangles/face_links.hpp"
#include "sazare/neighbors/sphere_grid.hpp"
#include "sazare/state/outlines.hpp"

namespace sazare::methods::rectangles {

using ContactRules = laws::FaceContact;

/// Springs and dashpots of a pair of elements, or of an element and a support, which has no mass.
laws::ContactSprings contact_springs(const ContactRules& rules, const state::Outlines& outlines,
                                     const state::Particles<2>& particles, Index first, Index second);

struct Contact {
  Index first = 0;
  Index second = 0;
  geometry::Vector2 normal = geometry::Vector2::Zero();  ///< when they last touched; zero while apart
  Real shear = 0;                                        ///< force of the shear spring on the second along (n_y, -n_x) [N]
  SpringLosses loss;
  Real energy = 0;                                      ///< in its springs [J]
  geometry::Vector2 force = geometry::Vector2::Zero();  ///< on the second [N]
  Real first_moment = 0, second_moment = 0;             ///< [N m]
  std::array<Real, 4> dashpot{};                        ///< of the force on the second and both moments, what the dashpots gave
  Real dashpot_power = 0;                               ///< which they took when they were evaluated [W]

  bool touches() const { return !normal.isZero(); }
};

class Contacts {
public:
  Contacts(const ContactRules& rules, const state::Particles<2>& particles, const state::Outlines& outlines);

  /// Looks for pairs anew where anything has moved so far that one could be missing; then all forces.
  void evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, const FaceLinks& links, Real elapsed);

  /// Pairs have to be looked for, since links have opened.
  void forget_pairs() { searched_ = false; }

  /// Whether the last evaluation has looked for pairs anew.
  bool has_searched() const { return just_searched_; }

  bool has_pairs(std::size_t element) const { return begin_[element] != begin_[element + 1]; }
  /// Adds the force [N] and moment [N m] of all its contacts.
  void add_to(std::size_t element, std::array<Real, 3>& sum) const;

  const ContactRules& rules() const { return rules_; }
  std::span<const Contact> pairs() const { return pairs_; }
  Index touching() const;
  Real elastic_energy() const;
  SpringLosses losses() const;

  void columns(Archive& archive);

private:
  bool is_stale(const state::Particles<2>& particles) const;
  void look_at_surface(const state::Particles<2>& particles, const state::Outlines& outlines);
  void search(const state::Particles<2>& particles, const state::Outlines& outlines, const FaceLinks& links);
  void take_over(std::vector<Contact> found);
  void index_pairs(std::size_t elements);
  void evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, Contact& contact, Real elapsed) const;

  ContactRules rules_;
  Real skin_ = 0;  ///< [m]
  bool searched_ = false, just_searched_ = false;
  neighbors::SphereGrid grid_;
  std::vector<Index> surface_;         ///< elements and supports that may touch something
  std::array<state::Column, 2> seen_;  ///< their displacements at the last search [m]
  std::vector<Contact> pairs_;         ///< sorted by first and second
  SpringLosses past_losses_;           ///< of pairs that are apart
  std::vector<std::size_t> begin_;     ///< by element: where its pairs begin in `of_element_`
  std::vector<Index> of_element_;      ///< pairs by element
};

}  // namespace sazare::methods::rectangles
