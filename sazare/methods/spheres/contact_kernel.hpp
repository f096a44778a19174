#pragma once

/// Forces of touching pairs, in groups of twice as many as there are lanes.

#include <algorithm>
#include <span>
#include <vector>

#include "sazare/core/lane_math.hpp"
#include "sazare/core/lane_records.hpp"
#include "sazare/core/twin_lanes.hpp"
#include "sazare/methods/spheres/load_rows.hpp"
#include "sazare/methods/spheres/meeting.hpp"
#include "sazare/methods/spheres/pair_contacts.hpp"

namespace sazare::methods::spheres {

/// `rests`: contacts may have an overlap at rest, beyond which alone they push. It shrinks with the overlap and never grows, so
/// that spheres which come apart meet as others do.
template <laws::ContactModel model, bool rolls, bool rests>
class ContactKernel {
  static constexpr std::size_t groups_at_once = 2, in_group = BlockContacts::at_once;

public:
  static constexpr std::size_t at_once = groups_at_once * in_group;

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
        tells_energies_(task.tells_energies),
        is_one_material_(contacts.table_.materials == 1) {
    if (is_one_material_) {
      const auto& one = contacts.table_.of(0, 0);
      constants_ = {one.normal,   one.tangential, one.normal_damping, one.tangential_damping,
                    one.friction, one.rolling,    one.twisting};
    }
  }

  /// The contacts from a number on, `at_once` or as many as are left, in three passes: each holds few numbers at a time, for
  /// which there are registers, and its groups do not wait for one another. Asks for so many of the coming lines with each group.
  void evaluate(std::size_t begin, ComingLines& coming, std::size_t lines) {
    const std::span groups(groups_.data(), groups_from(begin));
    meet(groups);
    for (Group& group : groups) {
      press(group);
      coming.fetch(lines);
    }
    deliver(groups);
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
      total.dashpot_work += step_[lane] * dashpot_power_[lane];
      total.sliding_work += step_[lane] * sliding_power_[lane];
    }
    total.contacts = touching_;
    return total;
  }

private:
  static constexpr Real tiny = 1e-30;  // an overlap at which nothing of the law fails

  /// Contacts that are worked on together, and what a pass hands on to the next one.
  struct Group {
    std::size_t begin;
    int count;  ///< of lanes that count
    bool all_touch;
    TwinMask touches;  ///< where not all do
    laws::ContactMotion<TwinLanes> at;
    TwinLanes first_arm, second_arm;
    Triple<TwinLanes> force, moment_by_arm, turning;  ///< what the second spheres get, and what moments come from
  };

  /// Sets out the groups of the contacts from a number on, and returns how many there are.
  std::size_t groups_from(std::size_t begin) {
    const std::size_t end = std::min(begin + at_once, contacts_.size());
    std::size_t count = 0;
    for (std::size_t next = begin; next < end; next += in_group) {
      Group& group = groups_[count++];
      group.begin = next;
      group.count = static_cast<int>(std::min(in_group, end - next));
      group.all_touch = group.count == TwinLanes::count;
      if (!group.all_touch) group.touches = {lane_numbers() < group.count, lane_numbers() < group.count - lane_count};
    }
    return count;
  }

  using Padded = std::array<Contact, lane_count>;
  /// The contacts of half a group; what is too much repeats one of the group and does not count.
  const Contact* contacts_of(const Group& group, int offset, Padded& padded) const {
    if (group.count >= offset + lane_count) return &contacts_[group.begin] + offset;
    padded.fill(contacts_[group.begin]);
    if (group.count > offset) std::copy_n(&contacts_[group.begin] + offset, group.count - offset, padded.begin());
    return padded.data();
  }

  static void set(Triple<TwinLanes>& to, Lanes TwinLanes::*half, const Triple<Lanes>& from) {
    to.x.*half = from.x;
    to.y.*half = from.y;
    to.z.*half = from.z;
  }
  static void set(laws::Reduced<TwinLanes>& to, Lanes TwinLanes::*half, const Lanes& one, const Lanes& other) {
    to.product.*half = one * other;
    to.sum.*half = one + other;
  }

  /// Where and how fast spheres meet.
  [[gnu::flatten, gnu::noinline]] void meet(std::span<Group> groups) {
    for (Group& group : groups) {
      meet(group, &TwinLanes::first, 0);
      meet(group, &TwinLanes::second, lane_count);
    }
  }

  void meet(Group& group, Lanes TwinLanes::*half, int offset) {
    Padded padded;
    const Contact* const some = contacts_of(group, offset, padded);
    laws::ContactMotion<TwinLanes>& at = group.at;
    auto [apart, velocity, radius, radius2, mass, mass2, one, other] = meeting_of(
        spheres_.place.data(), spheres_.spin.data(), [&](std::size_t lane) { return static_cast<std::size_t>(some[lane].first); },
        [&](std::size_t lane) { return static_cast<std::size_t>(some[lane].second); });
    set(at.mass, half, mass, mass2);
    set(at.radius, half, radius, radius2);
    const Lanes square = box_.square_of_nearest(apart), inverse_distance = inverse_square_root(square),
                gap = add_product(square, inverse_distance, -(at.radius.sum.*half));
    const Triple<Lanes> normal = inverse_distance * apart;
    set(at.normal, half, normal);
    Lanes beyond = -gap, rest{};
    if constexpr (rests) {
      Lanes& before = contacts_.rest_of(group.begin).*half;
      before = rest = maximum(minimum(before, beyond), Lanes{});
      beyond -= rest;
    }
    const bool all_touch = all_above(beyond, broadcast(tiny));
    at.overlap.*half = maximum(beyond, broadcast(tiny));
    Lanes deep = 0.5 * (at.overlap.*half);
    if constexpr (rests) deep += 0.5 * rest;
    const Lanes first_arm = group.first_arm.*half = radius - deep, second_arm = group.second_arm.*half = radius2 - deep;
    const Triple<Lanes> turning = cross(add_product(second_arm, other, first_arm * one), normal);
    if constexpr (rolls) {
      const Lanes reduced = (at.radius.product.*half) / (at.radius.sum.*half);
      const Triple<Lanes> turns = other - one;
      set(at.rolling, half, reduced * cross(turns, normal));
      at.twisting.*half = reduced * dot(turns, normal);
    }
    set(at.velocity, half, velocity - turning);
    if (!all_touch) leave_alone(group, half, offset, beyond > tiny, gap);
  }

  /// The law.
  [[gnu::flatten, gnu::noinline]] void press(Group& group) {
    const std::size_t begin = group.begin;
    if (!is_one_material_) look_up(group);
    laws::ContactMotion<TwinLanes>& at = group.at;
    at.step = step_;
    laws::ContactMemory<TwinLanes> memory;
    memory.sliding = contacts_.sliding_of(begin);
    if constexpr (rolls) {
      memory.rolling = contacts_.rolling_of(begin);
      memory.twisting = contacts_.twisting_of(begin);
    }
    auto force = laws::contact_force<model, rolls>(constants_, at, memory);
    contacts_.sliding_of(begin) = memory.sliding;
    if constexpr (rolls) {
      contacts_.rolling_of(begin) = memory.rolling;
      contacts_.twisting_of(begin) = memory.twisting;
    }
    if (!group.all_touch) take_off(force, group.touches);
    group.force = add_product(force.normal, at.normal, force.friction);
    group.moment_by_arm = cross(force.friction, at.normal);
    if constexpr (rolls)
      group.turning = at.radius.value() * add_product(force.twisting, at.normal, cross(at.normal, force.rolling));
    book(force, group);
  }

  /// What a law gives where nothing touches.
  static void take_off(laws::ContactForce<TwinLanes>& force, const TwinMask& touches) {
    for (TwinLanes* number : {&force.normal, &force.twisting, &force.elastic_energy, &force.sliding_energy, &force.dashpot_power,
                              &force.sliding_power})
      *number = select(touches, *number, 0);
    for (auto* part : {&force.friction, &force.rolling}) *part = select(touches, *part, Triple<TwinLanes>{});
  }

  static LongLanes lane_numbers() {
    LongLanes numbers;
    for (int lane = 0; lane < lane_count; ++lane) numbers[lane] = lane;
    return numbers;
  }

  /// Tells the lanes that push. Pairs that do not sleep, where there is a gap, for as long as it lasts. Called, like `look_up`,
  /// where the kernel has nothing in registers: as a part of it the seldom one would cost the others theirs.
  [[gnu::noinline]] void leave_alone(Group& group, Lanes TwinLanes::*half, int offset, const LaneMask& touches,
                                     const Lanes& gap) {
    if (group.all_touch) group.touches = {mask_of(all_lanes), mask_of(all_lanes)};
    group.all_touch = false;
    (half == &TwinLanes::first ? group.touches.first : group.touches.second) &= touches;
    for (int lane = 0; lane < std::min(group.count - offset, lane_count); ++lane) {
      if (touches[lane] || gap[lane] < 0) continue;
      const std::size_t contact = group.begin + static_cast<std::size_t>(offset + lane);
      pairs_.sleep_on(contacts_[contact].pair, approach_ + gap[lane]);
      parted_.push_back(contact);
    }
  }

  /// The constants of contacts of several materials.
  [[gnu::noinline]] void look_up(const Group& group) {
    look_up(group, &TwinLanes::first, 0);
    look_up(group, &TwinLanes::second, lane_count);
  }
  void look_up(const Group& group, Lanes TwinLanes::*half, int offset) {
    Padded padded;
    const Contact* const contacts = contacts_of(group, offset, padded);
    std::array<const Real*, lane_count> from;
    const auto material = [&](Index sphere) {
      return static_cast<Index>(spheres_.spin[static_cast<std::size_t>(sphere)].material);
    };
    for (std::size_t n = 0; n < lane_count; ++n)
      from[n] = pairs_.table_.numbers(material(contacts[n].first) * pairs_.table_.materials + material(contacts[n].second));
    const auto numbers = load_quads([&](std::size_t lane) { return from[lane]; }),
               more = load_quads([&](std::size_t lane) { return from[lane] + 4; });
    constants_.normal.*half = numbers[0];
    constants_.tangential.*half = numbers[1];
    constants_.normal_damping.*half = numbers[2];
    constants_.tangential_damping.*half = numbers[3];
    constants_.friction.*half = more[0];
    constants_.rolling.*half = more[1];
    constants_.twisting.*half = more[2];
  }

  /// Equal and opposite forces; moments about both centres, whose arms together are the distance.
  [[gnu::flatten, gnu::noinline]] void deliver(std::span<const Group> groups) {
    for (const Group& group : groups) {
      deliver(group, &TwinLanes::first, 0);
      deliver(group, &TwinLanes::second, lane_count);
    }
  }
  void deliver(const Group& group, Lanes TwinLanes::*half, int offset) {
    // Their own copies: for all that the compiler knows, a load that is written to might be one of the members.
    state::SphereLoad* const own = own_ - block_begin_;
    const LoadTable::Slots slots = slots_;
    const Contact* const contacts = &contacts_[group.begin] + offset;
    const auto count = static_cast<std::size_t>(std::clamp(group.count - offset, 0, lane_count));
    const LoadRows pushes(lanes_of(group.force, half), lanes_of(group.moment_by_arm, half));
    const auto* const first_arm = reinterpret_cast<const Real*>(&(group.first_arm.*half));
    const auto* const second_arm = reinterpret_cast<const Real*>(&(group.second_arm.*half));
    const auto add = [&](state::SphereLoad* to, const Octet& share, std::size_t lane) {
      add_product(share, pushes[lane], Octet::load(&to->fx)).store(&to->fx);
    };
    for (std::size_t lane = 0; lane < lane_count && lane < count; ++lane) {
      add(own + contacts[lane].first, Octet::halves(-1, first_arm[lane]), lane);
      add(slots[contacts[lane].slot], Octet::halves(1, second_arm[lane]), lane);
    }
    if constexpr (rolls) {
      const LoadRows turnings({}, lanes_of(group.turning, half));
      for (std::size_t lane = 0; lane < count; ++lane) {
        state::SphereLoad &one = own[contacts[lane].first], &other = *slots[contacts[lane].slot];
        add_product(Octet::halves(-1, -1), turnings[lane], Octet::load(&one.fx)).store(&one.fx);
        turnings.add(lane, &other);
      }
    }
  }

  static Triple<Lanes> lanes_of(const Triple<TwinLanes>& numbers, Lanes TwinLanes::*half) {
    return {numbers.x.*half, numbers.y.*half, numbers.z.*half};
  }

  void book(const laws::ContactForce<TwinLanes>& force, const Group& group) {
    if (group.all_touch)
      touching_ += TwinLanes::count;
    else
      for (int lane = 0; lane < TwinLanes::count; ++lane) touching_ += group.touches[lane] ? 1 : 0;
    dashpot_power_ += force.dashpot_power;
    sliding_power_ += force.sliding_power;
    if (!tells_energies_) return;
    elastic_ += force.elastic_energy;
    sliding_ += force.sliding_energy;
  }

  PairContacts& pairs_;
  BlockContacts& contacts_;
  const state::Spheres& spheres_;
  state::SphereLoad* own_;
  LoadTable::Slots slots_;
  Index block_begin_;
  Real approach_;
  TwinLanes step_;
  BoxLanes<Lanes> box_;
  bool tells_energies_;
  bool is_one_material_;
  laws::ContactConstants<TwinLanes> constants_;
  std::vector<std::size_t> parted_;
  TwinLanes elastic_, sliding_, dashpot_power_, sliding_power_;
  std::int64_t touching_ = 0;
  std::array<Group, groups_at_once> groups_;
};

}  // namespace sazare::methods::spheres
