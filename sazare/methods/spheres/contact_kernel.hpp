#pragma once

/// Forces of touching pairs, twice as many at once as there are lanes.

#include <algorithm>
#include <span>
#include <vector>

#include "sazare/core/lane_math.hpp"
#include "sazare/core/lane_records.hpp"
#include "sazare/core/twin_lanes.hpp"
#include "sazare/methods/spheres/load_rows.hpp"
#include "sazare/methods/spheres/pair_contacts.hpp"

namespace sazare::methods::spheres {

/// `rests`: contacts may have an overlap at rest, beyond which alone they push. It shrinks with the overlap and never grows, so
/// that spheres which come apart meet as others do.
template <laws::ContactModel model, bool rolls, bool rests>
class ContactKernel {
public:
  ContactKernel(PairContacts& contacts, const state::Spheres& spheres, const PairContacts::Task& task)
      : pairs_(contacts),
        contacts_(contacts.contacts_[task.block]),
        spheres_(spheres),
        own_(task.own),
        slots_(task.loads.slots(task.own)),
        block_begin_(static_cast<Index>(task.loads.begin_of(task.block))),
        approach_(task.approach),
        step_(task.step),
        box_(spheres.box),
        is_one_material_(contacts.table_.materials == 1) {
    if (is_one_material_) {
      const auto& one = contacts.table_.of(0, 0);
      constants_ = {one.normal, one.tangential, one.normal_damping, one.tangential_damping, one.friction, one.rolling};
    }
  }

  /// The contacts from a number on, `at_once` or as many as are left; what is too much repeats one of them and does not count.
  /// All that it calls becomes part of it, which the compiler by itself finds too much.
  [[gnu::flatten]] void evaluate(std::size_t begin) {
    const int lanes = static_cast<int>(std::min(BlockContacts::at_once, contacts_.size() - begin));
    std::array<Contact, BlockContacts::at_once> padded;
    const Contact* some = &contacts_[begin];
    if (lanes < TwinLanes::count) {
      padded.fill(*some);
      std::copy_n(some, lanes, padded.begin());
      some = padded.data();
    }
    const auto [first, first_velocity, first_spin] = read(some, &Contact::first);
    const auto [second, second_velocity, second_spin] = read(some, &Contact::second);
    const Triple<TwinLanes> apart = box_.nearest({second[0] - first[0], second[1] - first[1], second[2] - first[2]});
    const TwinLanes square = dot(apart, apart), inverse_distance = inverse_square_root(square),
                    distance = square * inverse_distance, reach = first[3] + second[3],
                    masses = first_velocity[3] + second_velocity[3];
    const TwinLanes inverse_of_both = inverse(reach * masses);  // one division instead of two
    laws::ContactMotion<TwinLanes> at;
    at.normal = inverse_distance * apart;
    const TwinLanes gap = distance - reach;
    TwinLanes beyond = -gap, rest;
    if constexpr (rests) {
      rest = maximum(minimum(contacts_.rest_of(begin), beyond), 0);
      contacts_.rest_of(begin) = rest;
      beyond -= rest;
    }
    const TwinMask touches = beyond > 0.0;
    at.overlap = select(touches, beyond, tiny);
    at.reduced_radius = first[3] * second[3] * (inverse_of_both * masses);
    at.reduced_mass = first_velocity[3] * second_velocity[3] * (inverse_of_both * reach);
    at.step = step_;
    TwinLanes half = 0.5 * at.overlap;
    if constexpr (rests) half += 0.5 * rest;
    const TwinLanes first_arm = first[3] - half, second_arm = second[3] - half;
    const Triple<TwinLanes> one{first_spin[0], first_spin[1], first_spin[2]},
        other{second_spin[0], second_spin[1], second_spin[2]};
    const Triple<TwinLanes> velocity{second_velocity[0] - first_velocity[0], second_velocity[1] - first_velocity[1],
                                     second_velocity[2] - first_velocity[2]};
    at.velocity = velocity - cross(first_arm * one + second_arm * other, at.normal);
    if constexpr (rolls) at.rolling = at.reduced_radius * cross(other - one, at.normal);
    if (!is_one_material_) look_up(first_spin[3], second_spin[3]);
    laws::ContactMemory<TwinLanes> memory;
    memory.sliding = contacts_.sliding_of(begin);
    if constexpr (rolls) memory.rolling = contacts_.rolling_of(begin);
    auto force = laws::contact_force<model, rolls>(constants_, at, memory);
    if (any(~touches)) leave_alone(begin, lanes, touches, gap, force);
    contacts_.sliding_of(begin) = memory.sliding;
    if constexpr (rolls) contacts_.rolling_of(begin) = memory.rolling;
    deliver(force, at, first_arm, second_arm, begin, lanes);
    book(force, touches, lanes);
  }

  /// Takes the contacts that have parted off the list, the last one first: what stands behind one that goes stays.
  void part() {
    for (auto contact = parted_.rbegin(); contact != parted_.rend(); ++contact) contacts_.remove(*contact);
  }

  ContactSums sums() const {
    ContactSums total;
    for (int lane = 0; lane < TwinLanes::count; ++lane) {
      total.elastic += elastic_[lane];
      total.sliding += sliding_[lane];
      total.dashpot_work += dashpot_work_[lane];
      total.sliding_work += sliding_work_[lane];
      total.contacts += static_cast<std::int64_t>(touching_[lane]);
    }
    return total;
  }

private:
  static constexpr Real tiny = 1e-30;  // an overlap at which nothing of the law fails

  /// A sphere in each lane.
  struct SphereLanes {
    std::array<TwinLanes, 4> place, velocity, spin;
  };

  /// One of the two spheres of `at_once` contacts.
  SphereLanes read(const Contact* contacts, Index Contact::*sphere) const {
    const auto at = [&](std::size_t lane) { return static_cast<std::size_t>(contacts[lane].*sphere); };
    return {load_twins([&](std::size_t lane) { return &spheres_.place[at(lane)].x; }),
            load_twins([&](std::size_t lane) { return &spheres_.place[at(lane)].vx; }),
            load_twins([&](std::size_t lane) { return &spheres_.spin[at(lane)].x; })};
  }

  /// Four doubles of as many records, see `load_quads`.
  template <class From>
  static std::array<TwinLanes, 4> load_twins(const From& from) {
    const auto one = load_quads(from), other = load_quads([&](std::size_t lane) { return from(lane + lane_count); });
    return {TwinLanes{one[0], other[0]}, {one[1], other[1]}, {one[2], other[2]}, {one[3], other[3]}};
  }

  /// Pairs that do not push: no force, and where there is a gap sleep for as long as it lasts.
  void leave_alone(std::size_t begin, int lanes, TwinMask touches, const TwinLanes& gap, laws::ContactForce<TwinLanes>& force) {
    force.normal = select(touches, force.normal, 0);
    for (auto* part : {&force.friction, &force.rolling}) *part = select(touches, *part, Triple<TwinLanes>{});
    for (int lane = 0; lane < lanes; ++lane) {
      if (touches[lane] || gap[lane] < 0) continue;
      const std::size_t contact = begin + static_cast<std::size_t>(lane);
      pairs_.sleep_on(contacts_[contact].pair, approach_ + gap[lane]);
      parted_.push_back(contact);
    }
  }

  void look_up(const TwinLanes& one, const TwinLanes& other) {
    std::array<const Real*, BlockContacts::at_once> from;
    for (int lane = 0; lane < TwinLanes::count; ++lane)
      from[static_cast<std::size_t>(lane)] =
          pairs_.table_.numbers(static_cast<Index>(one[lane]) * pairs_.table_.materials + static_cast<Index>(other[lane]));
    const auto numbers = load_twins([&](std::size_t lane) { return from[lane]; }),
               more = load_twins([&](std::size_t lane) { return from[lane] + 4; });
    constants_ = {numbers[0], numbers[1], numbers[2], numbers[3], more[0], more[1]};
  }

  /// Equal and opposite forces; moments about both centres, whose arms together are the distance.
  void deliver(const laws::ContactForce<TwinLanes>& force, const laws::ContactMotion<TwinLanes>& at, const TwinLanes& first_arm,
               const TwinLanes& second_arm, std::size_t begin, int lanes) {
    const Triple<TwinLanes> push = force.normal * at.normal + force.friction, moment = cross(force.friction, at.normal), none;
    Triple<TwinLanes> first_moment = first_arm * moment, second_moment = second_arm * moment;
    if constexpr (rolls) {
      const Triple<TwinLanes> rolling = at.reduced_radius * cross(at.normal, force.rolling);
      first_moment = first_moment - rolling;
      second_moment = second_moment + rolling;
    }
    const std::span contacts(&contacts_[begin], static_cast<std::size_t>(lanes));
    const std::size_t in_first = std::min<std::size_t>(lane_count, contacts.size());
    const Loads loads{none - push, first_moment, push, second_moment};
    add(loads, &TwinLanes::first, contacts.first(in_first));
    add(loads, &TwinLanes::second, contacts.subspan(in_first));
  }

  /// What contacts bring to their first and their second spheres.
  struct Loads {
    Triple<TwinLanes> first_force, first_moment, second_force, second_moment;
  };

  /// One half of them.
  void add(const Loads& loads, Lanes TwinLanes::*half, std::span<const Contact> contacts) {
    const LoadRows first(lanes_of(loads.first_force, half), lanes_of(loads.first_moment, half)),
        second(lanes_of(loads.second_force, half), lanes_of(loads.second_moment, half));
    // Their own copies: for all that the compiler knows, a load that is written to might be one of the members.
    state::SphereLoad* const own = own_;
    const LoadTable::Slots slots = slots_;
    const Index block_begin = block_begin_;
    for (std::size_t lane = 0; lane < lane_count && lane < contacts.size(); ++lane) {
      first.add(lane, own + (contacts[lane].first - block_begin));
      second.add(lane, slots[contacts[lane].slot]);
    }
  }

  static Triple<Lanes> lanes_of(const Triple<TwinLanes>& numbers, Lanes TwinLanes::*half) {
    return {numbers.x.*half, numbers.y.*half, numbers.z.*half};
  }

  void book(const laws::ContactForce<TwinLanes>& force, TwinMask touches, int lanes) {
    TwinLanes counts = select(touches, 1, 0);
    for (int lane = lanes; lane < TwinLanes::count; ++lane) counts.set(lane, 0);
    elastic_ += counts * force.elastic_energy;
    sliding_ += counts * force.sliding_energy;
    dashpot_work_ += counts * step_ * force.dashpot_power;
    sliding_work_ += counts * step_ * force.sliding_power;
    touching_ += counts;
  }

  PairContacts& pairs_;
  BlockContacts& contacts_;
  const state::Spheres& spheres_;
  state::SphereLoad* own_;
  LoadTable::Slots slots_;
  Index block_begin_;
  Real approach_;
  TwinLanes step_;
  BoxLanes<TwinLanes> box_;
  bool is_one_material_;
  laws::ContactConstants<TwinLanes> constants_;
  std::vector<std::size_t> parted_;
  TwinLanes elastic_, sliding_, dashpot_work_, sliding_work_, touching_;
};

}  // namespace sazare::methods::spheres
