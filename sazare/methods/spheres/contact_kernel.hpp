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

/// `has_initial_overlap`: contacts may have an initial overlap, beyond which alone they push. It shrinks with the overlap and
/// never grows, so that spheres which come apart meet as others do.
template <class Law, bool rolls, bool has_initial_overlap>
class ContactKernel {
  static constexpr std::size_t groups_at_once = 2, in_group = TileContacts::at_once;

public:
  static constexpr std::size_t at_once = groups_at_once * in_group;

  ContactKernel(PairContacts& contacts, const state::Spheres& spheres, const PairContacts::Task& task)
      : pairs_(contacts),
        contacts_(contacts.contacts_[task.tile]),
        spheres_(spheres),
        own_(task.own),
        slots_(task.loads.slots(task.own)),
        tile_begin_(static_cast<Index>(task.loads.begin_of(task.tile))),
        approach_(task.approach),
        step_(task.step),
        box_(spheres.box),
        tells_energies_(task.tells_energies),
        is_one_material_(contacts.table_.materials == 1) {
    if (is_one_material_) {
      const auto& one = contacts.table_.of(0, 0);
      constants_ = {one.normal,   one.tangential, one.normal_damping, one.tangential_damping,
                    one.friction, one.rolling,    one.twisting,       one.adhesion};
    }
  }

  /// The contacts from a number on, `at_once` or as many as are left, in four passes: each holds few numbers at a time, for
  /// which there are registers, and its groups do not wait for one another. Asks for so many of the coming lines with each group.
  void evaluate(std::size_t begin, ComingLines& coming, std::size_t lines) {
    const std::span groups(groups_.data(), groups_from(begin));
    meet(groups);
    turn(groups);
    for (Group& group : groups) {
      if (tells_energies_)
        press<true>(group);
      else
        press<false>(group);
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
    if constexpr (Law::adheres) total.dashpot_work += parting_loss_;
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
    TwinLanes first_arm, second_arm, inverse_distance;
    VectorOf<TwinLanes> force, moment_by_arm, turning;  ///< what the second spheres get, and what moments come from
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

  /// The contacts of a group; what is too much repeats the first and does not count.
  const Contact* contacts_of(const Group& group) {
    return group.count == TwinLanes::count ? &contacts_[group.begin] : padded(group);
  }
  [[gnu::noinline]] const Contact* padded(const Group& group) {
    padded_.fill(contacts_[group.begin]);
    std::copy_n(&contacts_[group.begin], group.count, padded_.begin());
    return padded_.data();
  }

  static VectorOf<TwinLanes> twins(const LaneVector& first, const LaneVector& second) {
    const auto twin = [&](int axis) { return TwinLanes(first[axis], second[axis]); };
    return {twin(0), twin(1), twin(2)};
  }
  /// The spheres of contacts that stand one after the other, by lane.
  static auto firsts(const Contact* some) {
    return [=](std::size_t lane) { return some[lane].first; };
  }
  static auto seconds(const Contact* some) {
    return [=](std::size_t lane) { return some[lane].second; };
  }

  static laws::Reduced<TwinLanes> reduced(const TwinLanes& one, const TwinLanes& other) { return {one * other, one + other}; }

  /// Where spheres meet, and how fast their centres do.
  [[gnu::flatten, gnu::noinline]] void meet(std::span<Group> groups) {
    for (Group& group : groups) meet(group);
  }

  void meet(Group& group) {
    const Contact* const some = contacts_of(group);
    const state::SpherePlace* const places = spheres_.place.data();
    laws::ContactMotion<TwinLanes>& at = group.at;
    const Meeting one = meeting_of(places, firsts(some), seconds(some)),
                  two = meeting_of(places, firsts(some + lane_count), seconds(some + lane_count));
    VectorOf<TwinLanes> apart = twins(one.apart, two.apart);
    const TwinLanes radius(one.radius, two.radius), second_radius(one.second_radius, two.second_radius);
    at.radius = reduced(radius, second_radius);
    at.mass = reduced({one.mass, two.mass}, {one.second_mass, two.second_mass});
    const TwinLanes square = box_.square_of_nearest(apart), inverse_distance = inverse_square_root(square),
                    gap = add_product(square, inverse_distance, -at.radius.sum);
    group.inverse_distance = inverse_distance;
    at.normal = inverse_distance * apart;
    TwinLanes beyond = -gap, initial_overlap{};
    if constexpr (has_initial_overlap) {
      TwinLanes& before = contacts_.initial_overlap_of(group.begin);
      before = initial_overlap = maximum(minimum(before, beyond), TwinLanes{});
      beyond -= initial_overlap;
    }
    at.overlap = maximum(beyond, TwinLanes(tiny));
    TwinMask holds;
    if constexpr (Law::adheres) {
      if (!is_one_material_) look_up(group);
      holds = Law::holds(constants_, beyond, at.radius);
      at.overlap = select(holds, beyond, TwinLanes(tiny));
    }
    TwinLanes deep = 0.5 * at.overlap;
    if constexpr (has_initial_overlap) deep += 0.5 * initial_overlap;
    group.first_arm = radius - deep;
    group.second_arm = second_radius - deep;
    at.velocity = twins(one.velocity, two.velocity);
    if constexpr (Law::adheres) {
      if (any(~holds)) leave_alone(group, holds, gap);
    } else {
      if (!all_above(beyond, TwinLanes(tiny))) leave_alone(group, beyond > tiny, gap);
    }
  }

  /// What spins add to the velocity where spheres meet.
  [[gnu::flatten, gnu::noinline]] void turn(std::span<Group> groups) {
    for (Group& group : groups) turn(group);
  }

  void turn(Group& group) {
    const Contact* const some = contacts_of(group);
    const Contact* const more = some + lane_count;
    const state::SphereSpin* const spins = spheres_.spin.data();
    laws::ContactMotion<TwinLanes>& at = group.at;
    const auto turning = twins(sum_of_spins(spins, firsts(some), group.first_arm.first, seconds(some), group.second_arm.first),
                               sum_of_spins(spins, firsts(more), group.first_arm.second, seconds(more), group.second_arm.second));
    const TwinLanes step_by_distance = step_ * group.inverse_distance;  // both arms together are the distance
    at.tilt = step_by_distance * at.velocity;
    at.turn = step_by_distance * dot(turning, at.normal);
    at.velocity = at.velocity - cross(turning, at.normal);
    if constexpr (rolls) {
      const TwinLanes reduced_radius = at.radius.product / at.radius.sum;
      const VectorOf<TwinLanes> turns = twins(spins_of(spins, seconds(some)), spins_of(spins, seconds(more))) -
                                      twins(spins_of(spins, firsts(some)), spins_of(spins, firsts(more)));
      at.rolling = reduced_radius * cross(turns, at.normal);
      at.twisting = reduced_radius * dot(turns, at.normal);
    }
  }

  /// The law.
  template <bool tells_energies>
  [[gnu::flatten, gnu::noinline]] void press(Group& group) {
    const std::size_t begin = group.begin;
    if (!is_one_material_) look_up(group);
    laws::ContactMotion<TwinLanes>& at = group.at;
    at.step = step_;
    laws::ContactMemory<TwinLanes> memory;
    laws::SlipBands<TwinLanes>* bands = nullptr;
    if constexpr (Law::slips_in_part)
      bands = &contacts_.bands_of(begin);
    else
      memory.sliding = contacts_.sliding_of(begin);
    if constexpr (rolls) {
      memory.rolling = contacts_.rolling_of(begin);
      memory.twisting = contacts_.twisting_of(begin);
    }
    auto force = laws::contact_force<Law, rolls, tells_energies>(constants_, at, memory, bands);
    if constexpr (!Law::slips_in_part) contacts_.sliding_of(begin) = memory.sliding;
    if constexpr (rolls) {
      contacts_.rolling_of(begin) = memory.rolling;
      contacts_.twisting_of(begin) = memory.twisting;
    }
    if (!group.all_touch) take_off(force, group.touches);
    group.force = add_product(force.normal, at.normal, force.friction);
    group.moment_by_arm = cross(force.friction, at.normal);
    if constexpr (rolls)
      group.turning = at.radius.value() * add_product(force.twisting, at.normal, cross(at.normal, force.rolling));
    add_work(force, group);
  }

  /// What a law gives where nothing touches.
  static void take_off(laws::ContactForce<TwinLanes>& force, const TwinMask& touches) {
    for (TwinLanes* number : {&force.normal, &force.twisting, &force.elastic_energy, &force.sliding_energy, &force.dashpot_power,
                              &force.sliding_power})
      *number = select(touches, *number, 0);
    for (auto* part : {&force.friction, &force.rolling}) *part = select(touches, *part, VectorOf<TwinLanes>{});
  }

  /// Tells the lanes that push. Pairs across a gap become inactive for as long as it lasts. Called, like `look_up`,
  /// where the kernel has nothing in registers: as a part of it the seldom one would cost the others theirs.
  [[gnu::noinline]] void leave_alone(Group& group, const TwinMask& touches, const TwinLanes& gap) {
    if (group.all_touch) group.touches = {mask_of(all_lanes), mask_of(all_lanes)};
    group.all_touch = false;
    group.touches.first &= touches.first;
    group.touches.second &= touches.second;
    for (int lane = 0; lane < group.count; ++lane) {
      if (touches[lane] || gap[lane] < 0) continue;
      const std::size_t contact = group.begin + static_cast<std::size_t>(lane);
      pairs_.stay_inactive(contacts_[contact].pair, approach_ + gap[lane]);
      parted_.push_back(contact);
      if constexpr (Law::adheres)
        parting_loss_ += pairs_.table_.parting_loss(material_of(contacts_[contact].first), material_of(contacts_[contact].second),
                                                    group.at.radius.product[lane] / group.at.radius.sum[lane]);
    }
  }

  /// The constants of contacts of several materials.
  [[gnu::noinline]] void look_up(const Group& group) {
    const Contact* const contacts = contacts_of(group);
    look_up(contacts, &TwinLanes::first);
    look_up(contacts + lane_count, &TwinLanes::second);
  }
  void look_up(const Contact* contacts, Lanes TwinLanes::*half) {
    std::array<const Real*, lane_count> from;
    for (std::size_t n = 0; n < lane_count; ++n)
      from[n] = pairs_.table_.numbers(material_of(contacts[n].first) * pairs_.table_.materials + material_of(contacts[n].second));
    const auto numbers = load_quads([&](std::size_t lane) { return from[lane]; }),
               more = load_quads([&](std::size_t lane) { return from[lane] + 4; });
    constants_.normal.*half = numbers[0];
    constants_.tangential.*half = numbers[1];
    constants_.normal_damping.*half = numbers[2];
    constants_.tangential_damping.*half = numbers[3];
    constants_.friction.*half = more[0];
    constants_.rolling.*half = more[1];
    constants_.twisting.*half = more[2];
    if constexpr (Law::adheres) constants_.adhesion.*half = more[3];
  }
  Index material_of(const SphereAt& sphere) const { return static_cast<Index>(sphere.of(spheres_.spin.data())->material); }

  /// Equal and opposite forces; moments about both centres, whose arms together are the distance. What does not count is zero.
  [[gnu::flatten, gnu::noinline]] void deliver(std::span<const Group> groups) {
    for (const Group& group : groups) {
      const Contact* const contacts = contacts_of(group);
      deliver(group, contacts, &TwinLanes::first);
      deliver(group, contacts + lane_count, &TwinLanes::second);
    }
  }
  void deliver(const Group& group, const Contact* contacts, Lanes TwinLanes::*half) {
    // Local copies of members: the compiler must assume that a load to which is written might be one of the members.
    state::SphereLoad* const own = own_ - tile_begin_;
    const LoadTable::Slots slots = slots_;
    const LoadRows pushes(lanes_of(group.force, half), lanes_of(group.moment_by_arm, half));
    const auto* const first_arm = reinterpret_cast<const Real*>(&(group.first_arm.*half));
    const auto* const second_arm = reinterpret_cast<const Real*>(&(group.second_arm.*half));
    const auto add = [&](state::SphereLoad* to, const Octet& share, std::size_t lane) {
      add_product(share, pushes[lane], Octet::load(&to->fx)).store(&to->fx);
    };
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      add(contacts[lane].first.of(own), Octet::halves(-1, first_arm[lane]), lane);
      add(slots[contacts[lane].slot], Octet::halves(1, second_arm[lane]), lane);
    }
    if constexpr (rolls) {
      const LoadRows turnings({}, lanes_of(group.turning, half));
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        state::SphereLoad &one = *contacts[lane].first.of(own), &other = *slots[contacts[lane].slot];
        add_product(Octet::halves(-1, -1), turnings[lane], Octet::load(&one.fx)).store(&one.fx);
        turnings.add(lane, &other);
      }
    }
  }

  static LaneVector lanes_of(const VectorOf<TwinLanes>& numbers, Lanes TwinLanes::*half) {
    return {numbers[0].*half, numbers[1].*half, numbers[2].*half};
  }

  void add_work(const laws::ContactForce<TwinLanes>& force, const Group& group) {
    if (group.all_touch)
      touching_ += TwinLanes::count;
    else
      for (int lane = 0; lane < TwinLanes::count; ++lane) touching_ += group.touches[lane] ? 1 : 0;
    dashpot_power_ += force.dashpot_power;
    sliding_power_ += force.sliding_power;
    elastic_ += force.elastic_energy;
    sliding_ += force.sliding_energy;
  }

  PairContacts& pairs_;
  TileContacts& contacts_;
  const state::Spheres& spheres_;
  state::SphereLoad* own_;
  LoadTable::Slots slots_;
  Index tile_begin_;
  Real approach_;
  TwinLanes step_;
  BoxLanes<TwinLanes> box_;
  bool tells_energies_;
  bool is_one_material_;
  laws::ContactConstants<TwinLanes> constants_;
  std::vector<std::size_t> parted_;
  TwinLanes elastic_, sliding_, dashpot_power_, sliding_power_;
  std::int64_t touching_ = 0;
  Real parting_loss_ = 0;  ///< [J]
  std::array<Group, groups_at_once> groups_;
  std::array<Contact, TwinLanes::count> padded_;
};

}  // namespace sazare::methods::spheres
