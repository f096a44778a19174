#pragma once

/// Links of elements that stand side by side on the lattice of a block.
///
/// A link none of whose springs has slipped or broken is whole: its force follows in closed form from one number of memory,
/// whatever the number of its springs, and lanes of links are evaluated together. A link whose weakest spring reaches its limit
/// becomes damaged: from then on it has a memory for each spring. It opens when no spring is joined any more; then its elements
/// meet as squares.

#include <span>
#include <vector>

#include "sazare/laws/face_link.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::methods::rectangles {

/// What links of a material are.
struct FaceKind {
  laws::FaceSprings springs;
  laws::FaceFormula formula = laws::FaceFormula::small;
};

/// `second` stands beyond `first` along an axis of the block: 0 its x axis, 1 its y axis.
struct FaceLink {
  Index first = 0;
  Index second = 0;
  int axis = 0;
  Index kind = 0;
  Real slip = 0;  ///< of its springs at the beginning, see laws::SpringState [m]
};

/// What the springs of all links have lost so far [J].
struct SpringLosses {
  Real dashpot = 0;
  Real friction = 0;
  Real fracture = 0;
};

class FaceLinks {
public:
  static constexpr Index none = -1;

  FaceLinks(const state::Particles<2>& particles, std::vector<FaceKind> kinds, std::vector<FaceLink> links);

  Index count() const { return static_cast<Index>(links_.size()); }
  const FaceLink& link(Index number) const { return links_[static_cast<std::size_t>(number)]; }
  const FaceKind& kind_of(Index number) const { return kinds_[static_cast<std::size_t>(link(number).kind)]; }

  /// Link at a face of an element, by the bits of geometry::Outline; `none` where there is none or it is open.
  Index at_face(Index element, int face) const;
  bool is_open(Index number) const { return open_[static_cast<std::size_t>(number)] != 0; }
  /// Whether a spring of it has ever broken.
  bool has_broken(Index number) const;

  /// Forces of all links; `elapsed` is the time since the last evaluation [s].
  void evaluate(const state::Particles<2>& particles, Real elapsed);

  /// Links that have opened in the last evaluation, in order.
  std::span<const Index> opened() const { return opened_; }

  /// Adds the force [N] and moment [N m] of all links of a block of lanes of elements.
  void gather(std::size_t block, std::array<Lanes, 3>& sum) const;

  Real elastic_energy(const state::Particles<2>& particles) const;
  SpringLosses losses() const;
  Index broken_springs() const;
  Index open_links() const { return open_links_; }

  void columns(Archive& archive);

private:
  /// Links of one kind and axis, in whole lanes.
  struct Group {
    Index kind = 0;
    int axis = 0;
    std::size_t begin = 0, end = 0;
  };
  /// Slots of forces, by the link's place: on the second element, and both moments.
  struct Slots {
    state::Column force_x, force_y, first_moment, second_moment;
  };

  /// Whether any of them yields.
  template <laws::FaceFormula formula>
  bool evaluate_whole(const state::Particles<2>& particles, const Group& group, Real elapsed);
  void damage_those_that_yield();
  void damage(Index number);
  void evaluate_damaged(const state::Particles<2>& particles, Real elapsed);
  void evaluate_damaged(const state::Particles<2>& particles, std::size_t place, Real elapsed);
  void close_books();
  laws::FaceMotion<Real> motion_of(const state::Particles<2>& particles, std::size_t number) const;
  void make_face_table(std::size_t elements);

  std::vector<FaceKind> kinds_;
  std::vector<FaceLink> links_;  ///< padded groups; a padding link joins an element with itself
  std::vector<Group> groups_;
  std::array<std::vector<Index>, 4> face_;  ///< by face and element, padded: its link, or the one after the last
  std::vector<Index> first_, second_;
  std::array<state::Column, 2> rest_;       ///< x2 - x1 at the beginning [m]
  state::Column slip_;                      ///< of whole links, see laws::SpringState
  state::Column active_;                    ///< 1 for a whole link
  state::Column dashpot_loss_;              ///< of whole links so far [J]
  std::array<state::Column, 3> last_rate_;  ///< of whole links when their dashpots were last evaluated: a', b', v' [m/s]
  std::vector<char> yields_;
  std::vector<char> open_;
  Slots slots_;

  std::vector<Index> damaged_;       ///< links, in the order in which they were damaged
  std::vector<Index> damaged_of_;    ///< by link: its place there, or `none`
  std::vector<Index> first_spring_;  ///< by place
  std::vector<laws::SpringState> springs_;
  std::vector<SpringLosses> damaged_loss_;  ///< by place
  std::vector<char> just_opened_;           ///< by place
  std::vector<Index> opened_;
  Index open_links_ = 0;
};

}  // namespace sazare::methods::rectangles
