#pragma once

/// Links of elements that stand side by side on the lattice of a block, or in an irregular packing.
///
/// Links of a lattice share the numbers of their kind. Those of a packing, its facets, have their own lengths, reaches and
/// eccentricities in columns beside what they share.
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

/// `second` stands beyond `first` along an axis of the block: 0 its x axis, 1 its y axis; of a facet `own_direction`.
struct FaceLink {
  static constexpr int own_direction = 2;

  Index first = 0;
  Index second = 0;
  int axis = 0;
  Index kind = 0;
  Real slip = 0;  ///< of its springs at the beginning, see laws::SpringState [m]
};

/// A link of an irregular packing, formula exact. The springs of its kind are those of a facet of half length 1 m between nuclei
/// 1 m apart; stiffness and strength are theirs times the facet's own length over its distance, and times its length.
struct FacetLink {
  Index first = 0;
  Index second = 0;
  Index kind = 0;
  int first_face = 0, second_face = 0;     ///< by the bits of geometry::Outline
  Vector<2> direction;                     ///< n in the axes of both elements, from the first to the second
  Real first_reach = 0, second_reach = 0;  ///< r1, r2 [m]
  Real first_shift = 0, second_shift = 0;  ///< e1, e2 [m]
  Real half_face = 0;                      ///< r [m]
  Real distance = 0;                       ///< between the nuclei [m]
  Real reduced_mass = 0;                   ///< m1 m2/(m1 + m2) [kg]
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

  FaceLinks(const state::Particles<2>& particles, std::vector<FaceKind> kinds, std::vector<FaceLink> links,
            std::vector<FacetLink> facets = {});

  Index count() const { return static_cast<Index>(links_.size()); }
  const FaceLink& link(Index number) const { return links_[static_cast<std::size_t>(number)]; }
  const FaceKind& kind_of(Index number) const { return kinds_[static_cast<std::size_t>(link(number).kind)]; }

  /// Joins an element with itself, to fill the lanes.
  bool is_padding(Index number) const { return link(number).first == link(number).second; }
  /// The faces that a link joins, by the bits of geometry::Outline.
  int first_face(Index number) const;
  int second_face(Index number) const;

  /// Calls visit(link, neighbour) for every link of an element, the open ones too.
  template <class Visit>
  void visit_links(Index element, Visit&& visit) const;

  /// Direction of a link in its elements' axes, and its springs, each.
  Vector<2> direction_of(Index number) const;
  laws::Facet<Real> springs_of(Index number) const;

  bool is_open(Index number) const { return open_[static_cast<std::size_t>(number)] != 0; }
  /// Whether a spring of it has ever broken.
  bool has_broken(Index number) const;

  /// Forces of all links; `elapsed` is the time since the last evaluation [s].
  void evaluate(const state::Particles<2>& particles, Real elapsed);

  /// Force on the second element of a link when last evaluated [N].
  Vector<2> force_of(Index number) const {
    return {slots_.force_x[static_cast<std::size_t>(number)], slots_.force_y[static_cast<std::size_t>(number)]};
  }

  /// Links that have opened in the last evaluation, in order.
  std::span<const Index> opened() const { return opened_; }

  /// Adds the force [N] and moment [N m] of all links of a pack of elements.
  void gather(std::size_t pack, std::array<Lanes, 3>& sum) const;

  Real elastic_energy(const state::Particles<2>& particles) const;
  SpringLosses losses() const;
  Index broken_springs() const;
  Index broken_links() const { return open_links_; }

  void columns(Archive& archive);

private:
  /// Links of one kind and axis, in whole lanes.
  struct Group {
    Index kind = 0;
    int axis = 0;
    std::size_t begin = 0, end = 0;
    bool shares_start_offset = false;  ///< `start_offset_` is the same for all of them
  };
  /// Links of a group that are evaluated together, and where the loss of their dashpots is summed up.
  struct Part {
    std::size_t begin = 0, end = 0;
    Real* loss = nullptr;
    Real elapsed = 0;
    bool shares_start_offset = false;
  };
  struct LatticeFaces;
  struct PackingFaces;
  /// Numbers of facets, by their place among the facets.
  struct FacetColumns {
    std::array<state::Column, 2> direction;
    state::Column first_reach, second_reach, first_shift, second_shift, half_face;  ///< [m]
    state::Column stiffness;  ///< half_face over distance: of the springs, over those of the kind
    state::Column damping;    ///< of the dashpots, over those of the kind: the root of stiffness times reduced mass [kg^1/2]
    std::vector<std::array<int, 2>> faces;
  };
  /// Where the facets of a pack of elements stand in `facet_table_`: rows in which they come first, then second.
  struct FacetRows {
    std::size_t begin = 0, first = 0, second = 0;
  };
  /// Slots of forces, by the link's place: on the second element, and both moments.
  struct Slots {
    state::Column force_x, force_y, first_moment, second_moment;
  };

  /// Whether any of them yields.
  bool evaluate_whole(const state::Particles<2>& particles, std::size_t group, std::size_t band, Real elapsed);
  template <laws::FaceFormula formula, class Faces>
  bool evaluate_whole(const state::Particles<2>& particles, const laws::FaceSprings& kind, const Faces& faces, const Part& part);
  void damage_those_that_yield();
  void damage(Index number);
  void evaluate_damaged(const state::Particles<2>& particles, Real elapsed);
  void evaluate_damaged(const state::Particles<2>& particles, std::size_t place, Real elapsed);
  void close_energy_balance();
  template <class Face>
  void advance_damaged(const FaceKind& kind, const Face& face, const laws::FaceMotion<Real>& motion, std::size_t place,
                       Real elapsed);
  laws::FaceMotion<Real> motion_of(const state::Particles<2>& particles, std::size_t number) const;
  bool is_facet(std::size_t number) const { return links_[number].axis == FaceLink::own_direction; }
  void add_lattice(const std::vector<FaceLink>& links);
  void add_facets(const std::vector<FacetLink>& facets);
  void pad(Index kind, int axis, std::size_t begin);
  void share_start_offset(Group& group);
  bool is_whole(std::size_t number) const { return (whole_[number / lane_count] >> number % lane_count & 1) != 0; }
  void make_face_table(std::size_t elements);
  void make_facet_table(std::size_t elements);

  std::vector<FaceKind> kinds_;
  std::vector<FaceLink> links_;  ///< padded groups; a padding link joins an element with itself
  std::vector<Group> groups_;
  std::array<std::vector<Index>, 4> face_;  ///< by face and element, padded: its link, or the one after the last
  std::size_t lattice_end_ = 0;             ///< from here on links are facets
  FacetColumns facets_;
  std::vector<FacetRows> facet_rows_;  ///< by pack of elements; empty without facets
  std::vector<Index> facet_table_;     ///< rows of one link for each lane, or the one after the last
  std::vector<Index> first_, second_;
  std::array<state::Column, 2> start_offset_;  ///< x2 - x1 at the beginning [m]
  state::Column slip_;                         ///< of whole links, see laws::SpringState
  std::vector<LaneBits> whole_;                ///< by pack: which of its links are whole
  std::size_t bands_ = 0;                      ///< into which every group is cut
  state::Column dashpot_loss_;                 ///< of whole links so far, by band, group and lane [J]
  std::array<state::Column, 3> last_rate_;     ///< of whole links when their dashpots were last evaluated: a', b', v' [m/s]
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

template <class Visit>
void FaceLinks::visit_links(Index element, Visit&& visit) const {
  const auto i = static_cast<std::size_t>(element);
  const auto call = [&](Index number) {
    if (number != count()) visit(number, link(number).first == element ? link(number).second : link(number).first);
  };
  for (const auto& column : face_)
    if (!column.empty()) call(column[i]);
  if (facet_rows_.empty()) return;
  const FacetRows& rows = facet_rows_[i / lane_count];
  for (std::size_t row = 0; row < rows.first + rows.second; ++row)
    call(facet_table_[rows.begin + row * lane_count + i % lane_count]);
}

}  // namespace sazare::methods::rectangles
