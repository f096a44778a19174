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
        tells_energies_(task.tells_energies),
        is_one_material_(contacts.table_.materials == 1) {
    if (is_one_material_) {
      const auto& one = contacts.table_.of(0, 0);
      constants_ = {one.normal,   one.tangential, one.normal_damping, one.tangential_damping,
                    one.friction, one.rolling,    one.twisting};
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
    if (!is_one_material_) look_up(some);
    // Each number is read where it is used first: registers are few, and what is set aside in memory costs as much as a product.
    const auto [x, y, z, radius] = read(some, &Contact::first, [&](std::size_t i) { return &spheres_.place[i].x; });
    const auto [x2, y2, z2, radius2] = read(some, &Contact::second, [&](std::size_t i) { return &spheres_.place[i].x; });
    Triple<TwinLanes> apart{x2 - x, y2 - y, z2 - z};
    laws::ContactMotion<TwinLanes> at;
    at.radius = laws::Reduced<TwinLanes>::of(radius, radius2);
    const TwinLanes square = box_.square_of_nearest(apart), inverse_distance = inverse_square_root(square),
                    gap = add_product(square, inverse_distance, -at.radius.sum);
    at.normal = inverse_distance * apart;
    TwinLanes beyond = -gap, rest;
    if constexpr (rests) {
      rest = maximum(minimum(contacts_.rest_of(begin), beyond), 0);
      contacts_.rest_of(begin) = rest;
      beyond -= rest;
    }
    const TwinMask touches = beyond > 0.0;
    at.overlap = select(touches, beyond, tiny);
    TwinLanes half = 0.5 * at.overlap;
    if constexpr (rests) half += 0.5 * rest;
    const TwinLanes first_arm = radius - half, second_arm = radius2 - half;
    const auto [wx, wy, wz, material] = read(some, &Contact::first, [&](std::size_t i) { return &spheres_.spin[i].x; });
    const auto [wx2, wy2, wz2, material2] = read(some, &Contact::second, [&](std::size_t i) { return &spheres_.spin[i].x; });
    const Triple<TwinLanes> one{wx, wy, wz}, other{wx2, wy2, wz2};
    const Triple<TwinLanes> turning = cross(add_product(second_arm, other, first_arm * one), at.normal);
    if constexpr (rolls) {
      const TwinLanes reduced = at.radius.value();
      const Triple<TwinLanes> turns = other - one;
      at.rolling = reduced * cross(turns, at.normal);
      at.twisting = reduced * dot(turns, at.normal);
    }
    const auto [vx, vy, vz, mass] = read(some, &Contact::first, [&](std::size_t i) { return &spheres_.place[i].vx; });
    const auto [vx2, vy2, vz2, mass2] = read(some, &Contact::second, [&](std::size_t i) { return &spheres_.place[i].vx; });
    at.velocity = Triple<TwinLanes>{vx2 - vx, vy2 - vy, vz2 - vz} - turning;
    at.mass = laws::Reduced<TwinLanes>::of(mass, mass2);
    at.step = step_;
    laws::ContactMemory<TwinLanes> memory;
    memory.sliding = contacts_.sliding_of(begin);
    if constexpr (rolls) {
      memory.rolling = contacts_.rolling_of(begin);
      memory.twisting = contacts_.twisting_of(begin);
    }
    auto force = laws::contact_force<model, rolls>(constants_, at, memory);
    force.normal = select(touches, force.normal, 0);
    force.twisting = select(touches, force.twisting, 0);
    for (auto* part : {&force.friction, &force.rolling}) *part = select(touches, *part, Triple<TwinLanes>{});
    contacts_.sliding_of(begin) = memory.sliding;
    if constexpr (rolls) {
      contacts_.rolling_of(begin) = memory.rolling;
      contacts_.twisting_of(begin) = memory.twisting;
    }
    deliver(force, at, first_arm, second_arm, begin, lanes);
    book(force, touches, lanes);
    if (any(~touches)) leave_alone(begin, lanes, touches, gap);
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
      total.contacts += static_cast<std::int64_t>(touching_[lane]);
    }
    return total;
  }

private:
  static constexpr Real tiny = 1e-30;  // an overlap at which nothing of the law fails

  /// Four doubles of one of the two spheres of `at_once` contacts.
  template <class Of>
  static std::array<TwinLanes, 4> read(const Contact* contacts, Index Contact::*sphere, const Of& of) {
    return load_twins([&](std::size_t lane) { return of(static_cast<std::size_t>(contacts[lane].*sphere)); });
  }

  /// Four doubles of as many records, see `load_quads`.
  template <class From>
  static std::array<TwinLanes, 4> load_twins(const From& from) {
    const auto one = load_quads(from), other = load_quads([&](std::size_t lane) { return from(lane + lane_count); });
    return {TwinLanes{one[0], other[0]}, {one[1], other[1]}, {one[2], other[2]}, {one[3], other[3]}};
  }

  /// Pairs that do not push sleep, where there is a gap, for as long as it lasts. Called, like `look_up`, where the kernel has
  /// nothing in registers: as a part of it the seldom one would cost the others theirs.
  [[gnu::noinline]] void leave_alone(std::size_t begin, int lanes, const TwinMask& touches, const TwinLanes& gap) {
    for (int lane = 0; lane < lanes; ++lane) {
      if (touches[lane] || gap[lane] < 0) continue;
      const std::size_t contact = begin + static_cast<std::size_t>(lane);
      pairs_.sleep_on(contacts_[contact].pair, approach_ + gap[lane]);
      parted_.push_back(contact);
    }
  }

  /// The constants of contacts of several materials.
  [[gnu::noinline]] void look_up(const Contact* contacts) {
    std::array<const Real*, BlockContacts::at_once> from;
    const auto material = [&](Index sphere) {
      return static_cast<Index>(spheres_.spin[static_cast<std::size_t>(sphere)].material);
    };
    for (std::size_t n = 0; n < BlockContacts::at_once; ++n)
      from[n] = pairs_.table_.numbers(material(contacts[n].first) * pairs_.table_.materials + material(contacts[n].second));
    const auto numbers = load_twins([&](std::size_t lane) { return from[lane]; }),
               more = load_twins([&](std::size_t lane) { return from[lane] + 4; });
    constants_ = {numbers[0], numbers[1], numbers[2], numbers[3], more[0], more[1], more[2]};
  }

  /// Equal and opposite forces; moments about both centres, whose arms together are the distance.
  void deliver(const laws::ContactForce<TwinLanes>& force, const laws::ContactMotion<TwinLanes>& at, const TwinLanes& first_arm,
               const TwinLanes& second_arm, std::size_t begin, int lanes) {
    const std::span contacts(&contacts_[begin], static_cast<std::size_t>(lanes));
    const std::size_t in_first = std::min<std::size_t>(lane_count, contacts.size());
    Push push{add_product(force.normal, at.normal, force.friction), cross(force.friction, at.normal), {}, first_arm, second_arm};
    if constexpr (rolls)
      push.turning = at.radius.value() * add_product(force.twisting, at.normal, cross(at.normal, force.rolling));
    add(push, &TwinLanes::first, contacts.first(in_first));
    add(push, &TwinLanes::second, contacts.subspan(in_first));
  }

  /// What contacts bring to their second spheres, and what its moments come from.
  struct Push {
    Triple<TwinLanes> force, moment_by_arm, turning;
    TwinLanes first_arm, second_arm;
  };

  /// One half of them.
  void add(const Push& push, Lanes TwinLanes::*half, std::span<const Contact> contacts) {
    // Their own copies: for all that the compiler knows, a load that is written to might be one of the members.
    state::SphereLoad* const own = own_;
    const LoadTable::Slots slots = slots_;
    const Index block_begin = block_begin_;
    const Triple<Lanes> force = lanes_of(push.force, half), by_arm = lanes_of(push.moment_by_arm, half);
    Triple<Lanes> first_moment = push.first_arm.*half * by_arm, second_moment = push.second_arm.*half * by_arm;
    if constexpr (rolls) {
      const Triple<Lanes> turning = lanes_of(push.turning, half);
      first_moment = first_moment - turning;
      second_moment = second_moment + turning;
    }
    const std::size_t count = std::min<std::size_t>(lane_count, contacts.size());
    const LoadRows first(Triple<Lanes>{} - force, first_moment);
    for (std::size_t lane = 0; lane < count; ++lane) first.add(lane, own + (contacts[lane].first - block_begin));
    const LoadRows second(force, second_moment);
    for (std::size_t lane = 0; lane < count; ++lane) second.add(lane, slots[contacts[lane].slot]);
  }

  static Triple<Lanes> lanes_of(const Triple<TwinLanes>& numbers, Lanes TwinLanes::*half) {
    return {numbers.x.*half, numbers.y.*half, numbers.z.*half};
  }

  void book(const laws::ContactForce<TwinLanes>& force, TwinMask touches, int lanes) {
    TwinLanes counts = select(touches, 1, 0);
    for (int lane = lanes; lane < TwinLanes::count; ++lane) counts.set(lane, 0);
    touching_ += counts;
    dashpot_power_ = add_product(counts, force.dashpot_power, dashpot_power_);
    sliding_power_ = add_product(counts, force.sliding_power, sliding_power_);
    if (!tells_energies_) return;
    elastic_ = add_product(counts, force.elastic_energy, elastic_);
    sliding_ = add_product(counts, force.sliding_energy, sliding_);
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
  bool tells_energies_;
  bool is_one_material_;
  laws::ContactConstants<TwinLanes> constants_;
  std::vector<std::size_t> parted_;
  TwinLanes elastic_, sliding_, dashpot_power_, sliding_power_, touching_;
};

}  // namespace sazare::methods::spheres
