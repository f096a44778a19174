#pragma once

/// Kinds of joints by their laws, as single numbers and in lanes.

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/time.hpp"
#include "sazare/laws/joint_laws.hpp"
#include "sazare/methods/blocks/joint_record.hpp"

namespace sazare::methods::blocks {

/// What joints of a law are made of; `P` as in the laws.
template <laws::JointLaw Law, class P>
struct JointParameters {
  typename Law::template Tension<P> tension;
  typename Law::template Shear<P> shear;
  P normal_damping{};  ///< c_n [Pa s/m]
  P shear_damping{};   ///< c_s [Pa s/m]
};

/// From any struct that has stiffness, strength and dashpots as members, and what the law alone takes.
template <laws::JointLaw Law, class Joint>
JointParameters<Law, Real> joint_parameters(const Joint& joint,
                                            const std::array<std::optional<Real>, Law::parameters.size()>& own = {}) {
  return {Law::tension(joint, own), Law::shear(joint, own), joint.normal_damping, joint.shear_damping};
}

/// Springs and dashpots per area of a face: four numbers side by side, which lanes read at once.
struct JointSprings {
  Real normal_stiffness = 0;  ///< [Pa/m]
  Real shear_stiffness = 0;   ///< [Pa/m]
  Real normal_damping = 0;    ///< [Pa s/m]
  Real shear_damping = 0;     ///< [Pa s/m]
};
static_assert(sizeof(JointSprings) == 4 * sizeof(Real));

/// Any joint as long as nothing has happened to it.
struct ElasticJoint : JointSprings {
  Real largest_opening = 0;  ///< beyond it the joint is not elastic any more [m]
  Real largest_stress = 0;   ///< at that opening [Pa]
  bool is_natural = false;
  laws::JointClosure<Real> closure{1, 0, 1};  ///< of a natural joint; its springs are those above
  laws::RoughShear<Real> rough = {};          ///< and likewise

  /// The elastic joint of this kind on a face that has its own springs: the strength of the kind stays.
  ElasticJoint with(const JointSprings& own) const {
    return {own, largest_stress / own.normal_stiffness, largest_stress, is_natural, closure, rough};
  }

  /// The opening [m] at which it bears a normal stress, tension positive [Pa].
  Real opening_under(Real stress) const {
    if (!is_natural || stress > 0) return stress / normal_stiffness;
    laws::JointClosure<Real> on_springs = closure;
    set_stiffness(on_springs, normal_stiffness);
    return -compression_under(on_springs, -stress);
  }
};

template <class Law>
ElasticJoint elastic_joint(const JointParameters<Law, Real>& kind) {
  ElasticJoint joint{{kind.tension.stiffness, kind.shear.stiffness, kind.normal_damping, kind.shear_damping},
                     elastic_peak(kind.tension),
                     elastic_limit(kind.tension)};
  if constexpr (laws::DilatesBySlip<Law>) {
    joint.is_natural = true;
    joint.closure = kind.tension;
    joint.rough = kind.shear;
  }
  return joint;
}

template <class... Kinds>
ElasticJoint elastic_joint(const std::variant<Kinds...>& kind) {
  return std::visit([](const auto& of_law) { return elastic_joint(of_law); }, kind);
}

template <class Kind>
std::vector<ElasticJoint> elastic_joints(const std::vector<Kind>& kinds) {
  std::vector<ElasticJoint> elastic;
  for (const Kind& kind : kinds) elastic.push_back(elastic_joint(kind));
  return elastic;
}

/// Whether the law of some kind remembers the path of slip.
template <class... Laws>
bool some_remember_path(const std::vector<std::variant<JointParameters<Laws, Real>...>>& kinds) {
  const auto remembers = []<class Law>(const JointParameters<Law, Real>&) { return laws::RemembersPath<Law>; };
  return std::ranges::any_of(kinds, [&](const auto& kind) { return std::visit(remembers, kind); });
}

/// Puts the numbers of a law's part into a lane.
template <class InLanes, class Single>
void set_numbers(InLanes& lanes, int lane, Single single) {
  static_assert(sizeof(Single) == sizeof(Real) * std::tuple_size_v<decltype(single.numbers())>, "numbers() leaves none out");
  std::apply(
      [&](auto&... to) { std::apply([&](const auto&... from) { ((to[lane] = from), ...); }, single.numbers()); },
      lanes.numbers());
}

template <class Law>
void set_lane(JointParameters<Law, Lanes>& lanes, int lane, const JointParameters<Law, Real>& kind) {
  set_numbers(lanes.tension, lane, kind.tension);
  set_numbers(lanes.shear, lane, kind.shear);
  lanes.normal_damping[lane] = kind.normal_damping;
  lanes.shear_damping[lane] = kind.shear_damping;
}

/// Takes the numbers of a law's part from a lane.
template <class Single, class InLanes>
Single lane_of(InLanes lanes, int lane) {
  Single single;
  std::apply([&](auto&... to) { std::apply([&](const auto&... from) { ((to = from[lane]), ...); }, lanes.numbers()); },
             single.numbers());
  return single;
}

/// Puts the springs of faces that have their own into their lanes.
template <class Law, class SpringsOfLane>
void set_springs(JointParameters<Law, Lanes>& kind, const SpringsOfLane& springs) {
  const auto own = load_quads([&](std::size_t lane) { return &springs(lane).normal_stiffness; });
  set_stiffness(kind.tension, own[0]);
  set_stiffness(kind.shear, own[1]);
  kind.normal_damping = own[2];
  kind.shear_damping = own[3];
}

/// The kinds of one law, at their places among all kinds. What stands at the places of others is never used.
template <class Law>
class KindsOfLaw {
public:
  using Single = JointParameters<Law, Real>;
  using InLanes = JointParameters<Law, Lanes>;

  void push_back(const Single& kind) {
    kinds_.push_back(kind);
    InLanes& lanes = lanes_.emplace_back();
    for (int lane = 0; lane < lane_count; ++lane) set_lane(lanes, lane, kind);
  }

  /// Parameters of each lane, until the next call in this thread.
  template <class Record>
  const InLanes& of(const LanePointers<Record>& joints) const {
    thread_local InLanes mixed;
    if (lanes_.size() == 1) return lanes_[0];
    const Index kind = joints[0]->kind;
    if (std::ranges::all_of(joints, [&](const JointRecord* joint) { return joint->kind == kind; })) return lanes_[at(kind)];
    for (int lane = 0; lane < lane_count; ++lane) set_lane(mixed, lane, kinds_[at(joints[at(lane)]->kind)]);
    return mixed;
  }

private:
  std::vector<Single> kinds_;
  std::vector<InLanes> lanes_;  ///< each kind in all lanes
};

/// All kinds of a run, each of one of the laws of a list.
template <class Laws>
class JointKinds;

template <class... Laws>
class JointKinds<std::tuple<Laws...>> {
public:
  using Kind = std::variant<JointParameters<Laws, Real>...>;

  explicit JointKinds(const std::vector<Kind>& kinds) {
    for (const Kind& kind : kinds) {
      law_.push_back(kind.index());
      const auto add = [&]<class Law>(KindsOfLaw<Law>& of_law) {
        const auto* own = std::get_if<JointParameters<Law, Real>>(&kind);
        of_law.push_back(own ? *own : JointParameters<Law, Real>{});
      };
      std::apply([&](auto&... of_law) { (add(of_law), ...); }, by_law_);
    }
  }

  /// A joint of this kind is in the run.
  void use(Index kind) { used_[law_[at(kind)]] = true; }

  /// Calls visit(kinds, law) for each law that is used; `law` is its place in the list.
  template <class Visit>
  void visit_laws(Visit&& visit) const {
    std::size_t law = 0;
    const auto call = [&](const auto& of_law) {
      if (used_[law]) visit(of_law, law);
      ++law;
    };
    std::apply([&](const auto&... of_law) { (call(of_law), ...); }, by_law_);
  }

  bool has_one_law() const { return std::ranges::count(used_, true) <= 1; }
  std::size_t law_of(Index kind) const { return law_[at(kind)]; }

private:
  std::tuple<KindsOfLaw<Laws>...> by_law_;
  std::vector<std::size_t> law_;  ///< by kind
  std::array<bool, sizeof...(Laws)> used_{};
};

/// A kind of joint of any law of the list.
using JointKind = JointKinds<laws::JointLaws>::Kind;

}  // namespace sazare::methods::blocks
