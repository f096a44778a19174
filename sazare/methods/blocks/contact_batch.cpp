#include "sazare/methods/blocks/contact_batch.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/methods/blocks/deformation/lane_strains.hpp"
#include "sazare/state/body_lanes.hpp"

namespace sazare::methods::blocks {

namespace {

using LaneTouch = SphereTouchOf<Lanes>;

struct LaneSpheres {
  LaneVector centre;
  Lanes radius;
};

LaneSpheres load_spheres(const LanePointers<const ContactSphere>& spheres) {
  static_assert(sizeof(ContactSphere) == 4 * sizeof(Real));
  const auto n = load_quad(spheres, 0);
  return {{{n[0], n[1], n[2]}}, n[3]};
}

LaneSpheres placed(const LaneSpheres& spheres, const state::LanePlaces& at) {
  return {at.position + at.rotation * spheres.centre, spheres.radius};
}

/// What a body shows to an impulse, see ContactBody.
struct LaneSoftness {
  LaneMatrix rotation;
  LaneVector inverse_moments;
  Lanes inverse_mass;

  Lanes operator()(const LaneVector& arm, const LaneVector& direction) const {
    const LaneVector turning = transposed(rotation, cross(arm, direction));
    Lanes sum = inverse_mass;
    for (int i = 0; i < 3; ++i) sum = add_product(turning[i] * turning[i], inverse_moments[i], sum);
    return sum;
  }
};

LaneSoftness load_softness(const LaneMatrix& rotation, const LanePointers<const state::Inertia<3>>& bodies) {
  static_assert(offsetof(state::Inertia<3>, inverse_moments) == 4 * sizeof(Real) &&
                offsetof(state::Inertia<3>, mass) == 7 * sizeof(Real));
  const auto n = load_quad(bodies, 4);
  return {rotation, {{n[0], n[1], n[2]}}, 1.0 / n[3]};
}

/// How a strain moves a point of its body, which lies at a place of the undeformed one.
struct LaneStraining {
  LaneVector velocity;    ///< [m/s]
  LaneVector place;       ///< in the body frame [m]
  Lanes inverse_inertia;  ///< [1/(kg m2)]

  /// What it adds to the softness: the square of the symmetric part of direction times place.
  Lanes softness(const LaneMatrix& rotation, const LaneVector& direction) const {
    const LaneVector along = transposed(rotation, direction);
    const Lanes both = dot(along, place);
    return 0.5 * inverse_inertia * add_product(dot(along, along), dot(place, place), both * both);
  }
};

LaneStraining straining(const LaneMatrix& rotation, const LaneVector& place, const LanePointers<const state::Strain>& bodies) {
  LaneStraining found{rotation * product(load_strain(bodies).rate, place), place, {}};
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    found.inverse_inertia[static_cast<int>(lane)] = bodies[lane]->inverse_inertia;
  return found;
}

struct LaneContactForce {
  terms::LanePairForce total, dashpot, friction;
  std::array<Lanes, 2> unused{};

  void store(const LanePointers<ContactForce>& to) const {
    static_assert(sizeof(LaneContactForce) == lane_count * sizeof(ContactForce));
    store_records(std::bit_cast<std::array<Lanes, 20>>(*this), to);
  }
};

}  // namespace

/// Members of the batch, one in each lane; idle lanes repeat the first.
struct ContactBatch::InLanes {
  LanePointers<SpherePair> spheres;
  LanePointers<const Pair> pairs;
  LanePointers<const ContactSphere> first_sphere, second_sphere;
  LanePointers<const state::Motion<3>> first, second;
  LanePointers<const state::Strain> first_strain, second_strain;  ///< none where the bodies of the batch are rigid

  LaneVector first_tangent, second_tangent;  ///< tangent points of both spheres; else not set

  bool are_strained() const { return first_strain[0] != nullptr; }

  LaneTouch touch(const state::LanePlaces& first_place, const state::LanePlaces& second_place) const {
    LaneSpheres own = placed(load_spheres(first_sphere), first_place), other = placed(load_spheres(second_sphere), second_place);
    if (are_strained()) {
      own.centre = own.centre + first_place.rotation * product(load_strain(first_strain).strain, first_tangent);
      other.centre = other.centre + second_place.rotation * product(load_strain(second_strain).strain, second_tangent);
    }
    return blocks::touch(own, other);
  }
};

void ContactBatch::clear() {
  pairs_.clear();
  may_touch_.clear();
  touching_.clear();
  forces_.clear();
}

void ContactBatch::evaluate(const laws::SphereContact& law, const ContactSurface& surface, const Vector3& pole) {
  find_touching(surface);
  forces_.resize(touching_.size());
  for (std::size_t i = 0; i < touching_.size(); i += lane_count) {
    const std::size_t count = std::min<std::size_t>(lane_count, touching_.size() - i);
    push(law, pole, in_lanes(std::span(touching_).subspan(i, count), surface), std::span(forces_).subspan(i, count));
  }
}

ContactForce ContactBatch::force(const Pair& pair) const {
  ContactForce sum;
  for (const ContactForce& each : std::span(forces_).subspan(pair.first_touch, pair.touching)) sum += each;
  return sum;
}

ContactStrainForce ContactBatch::strain_force(const Pair& pair, const ContactSurface& surface) const {
  ContactStrainForce sum;
  const Matrix3 first = pair.first.motion.rotation.transpose(), second = pair.second.motion.rotation.transpose();
  for (std::size_t i = pair.first_touch; i < pair.first_touch + pair.touching; ++i) {
    const Vector3 &own = surface.tangent_point(touching_[i].spheres->first),
                  &other = surface.tangent_point(touching_[i].spheres->second);
    const auto add = [&](const terms::PairForce<3>& force, ContactStrainForce::Numbers& to) {
      to.head<6>() -= force_on_strain(first * force.linear, own);
      to.tail<6>() += force_on_strain(second * force.linear, other);
    };
    add(forces_[i].total, sum.total);
    add(forces_[i].dashpot, sum.dashpot);
    add(forces_[i].friction, sum.friction);
  }
  return sum;
}

ContactBatch::InLanes ContactBatch::in_lanes(std::span<const Member> members, const ContactSurface& surface) const {
  InLanes lanes;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Member member = members[lane < members.size() ? lane : 0];
    lanes.spheres[lane] = member.spheres;
    lanes.pairs[lane] = &pairs_[member.pair];
    lanes.first_sphere[lane] = &surface.sphere(member.spheres->first);
    lanes.second_sphere[lane] = &surface.sphere(member.spheres->second);
    lanes.first[lane] = &pairs_[member.pair].first.motion;
    lanes.second[lane] = &pairs_[member.pair].second.motion;
    lanes.first_strain[lane] = pairs_[member.pair].first.strain;
    lanes.second_strain[lane] = pairs_[member.pair].second.strain;
    if (!lanes.are_strained()) continue;
    for (int axis = 0; axis < 3; ++axis) {
      lanes.first_tangent[axis][static_cast<int>(lane)] = surface.tangent_point(member.spheres->first)[axis];
      lanes.second_tangent[axis][static_cast<int>(lane)] = surface.tangent_point(member.spheres->second)[axis];
    }
  }
  return lanes;
}

[[gnu::flatten]] void ContactBatch::find_touching(const ContactSurface& surface) {
  for (std::size_t i = 0; i < may_touch_.size(); i += lane_count) {
    const auto members = std::span(may_touch_).subspan(i, std::min<std::size_t>(lane_count, may_touch_.size() - i));
    const InLanes lanes = in_lanes(members, surface);
    const Lanes overlap = lanes.touch(state::load_places(lanes.first), state::load_places(lanes.second)).overlap;
    for (std::size_t lane = 0; lane < members.size(); ++lane) keep_if_touching(members[lane], overlap[static_cast<int>(lane)]);
  }
}

void ContactBatch::keep_if_touching(const Member& member, Real overlap) {
  SpherePair& spheres = *member.spheres;
  Pair& pair = pairs_[member.pair];
  pair.overlap = pair.overlap || overlap > 0;
  if (overlap < spheres.initial_overlap) spheres.initial_overlap = std::max(overlap, Real{0});
  if (!(overlap > spheres.initial_overlap)) {
    spheres.memory = {};
    return;
  }
  if (pair.touching++ == 0) pair.first_touch = touching_.size();
  touching_.push_back(member);
}

/// Forces of the members in the lanes, and what they remember.
[[gnu::flatten]] void ContactBatch::push(const laws::SphereContact& law, const Vector3& pole, const InLanes& members,
                                         std::span<ContactForce> forces) const {
  static_assert(offsetof(SpherePair, initial_overlap) == sizeof(Real) && offsetof(SpherePair, memory) == 3 * sizeof(Real));
  LanePointers<const state::Inertia<3>> first_inertia, second_inertia;
  LanePointers<ContactForce> to;
  laws::SphereMotionOf<Lanes> shared;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Pair& pair = *members.pairs[lane];
    const int i = static_cast<int>(lane);
    first_inertia[lane] = &pair.first.inertia;
    second_inertia[lane] = &pair.second.inertia;
    to[lane] = &forces[lane < forces.size() ? lane : 0];
    shared.contacts[i] = static_cast<Real>(pair.touching);
    shared.step[i] = std::max(pair.due.acting, 2 * pair.due.ahead);
    shared.elapsed[i] = pair.due.acting;
  }
  const state::LanePlaces first = state::load_places(members.first), second = state::load_places(members.second);
  const LaneTouch at = members.touch(first, second);
  const LaneVector arm = at.point - first.position, other_arm = at.point - second.position;
  const state::LaneVelocities mine = state::load_velocities(members.first), theirs = state::load_velocities(members.second);
  LaneVector opening = add_cross(theirs.spin, other_arm, theirs.velocity) - add_cross(mine.spin, arm, mine.velocity);
  LaneStraining strain{}, other_strain{};
  if (members.are_strained()) {
    strain = straining(first.rotation, members.first_tangent, members.first_strain);
    other_strain = straining(second.rotation, members.second_tangent, members.second_strain);
    opening = opening + (other_strain.velocity - strain.velocity);
  }
  const LaneSoftness soft = load_softness(first.rotation, first_inertia),
                     other_soft = load_softness(second.rotation, second_inertia);
  shared.overlap = at.overlap - load_quad(members.spheres, 0)[1];
  const auto known = load_quad(members.spheres, 3);
  laws::SphereMemoryOf<Lanes> memory{known[0], {{known[1], known[2], known[3]}}};
  turn_with_spheres(memory, at.normal, opening, at.arm, at.other_arm, mine.spin, theirs.spin, shared.elapsed);
  const auto softness = [&](const LaneVector& along) {
    const Lanes rigid = soft(arm, along) + other_soft(other_arm, along);
    if (!members.are_strained()) return rigid;
    return rigid + (strain.softness(first.rotation, along) + other_strain.softness(second.rotation, along));
  };
  const auto force = force_at(law, at.normal, opening, softness, shared, memory);
  const LaneVector &friction = memory.friction, dashpot = force.dashpot * at.normal;
  store_quad({memory.dashpot, friction[0], friction[1], friction[2]}, members.spheres, 3);
  const LaneVector total = add_product(force.elastic, at.normal, dashpot + force.friction);
  const LaneVector point = at.point - broadcast(pole);
  const auto acting_at_point = [&](const LaneVector& acting) { return terms::LanePairForce::at(point, acting); };
  LaneContactForce{acting_at_point(total), acting_at_point(dashpot), acting_at_point(force.friction)}.store(to);
}

}  // namespace sazare::methods::blocks
