#pragma once

/// Forces of as many touching pairs as there are lanes.

#include <algorithm>
#include <vector>

#include "sazare/core/lane_math.hpp"
#include "sazare/core/lane_records.hpp"
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
        loads_(task.loads),
        own_(task.own),
        begin_(task.loads.begin_of(task.block)),
        approach_(task.approach),
        step_(broadcast(task.step)),
        box_(spheres.box),
        is_one_material_(contacts.table_.materials == 1) {
    if (is_one_material_) {
      const auto& one = contacts.table_.of(0, 0);
      constants_ = {broadcast(one.normal),         broadcast(one.tangential),
                    broadcast(one.normal_damping), broadcast(one.tangential_damping),
                    broadcast(one.friction),       broadcast(one.rolling)};
    }
  }

  /// The contacts from a number on, as many as there are lanes or are left; what is too much repeats one of them and does not
  /// count. All that it calls becomes part of it, which the compiler by itself finds too much.
  [[gnu::flatten]] void evaluate(std::size_t begin) {
    const int lanes = static_cast<int>(std::min<std::size_t>(lane_count, contacts_.size() - begin));
    std::array<Contact, lane_count> padded;
    const Contact* some = &contacts_[begin];
    if (lanes < lane_count) {
      padded.fill(*some);
      std::copy_n(some, lanes, padded.begin());
      some = padded.data();
    }
    const auto [first, first_velocity, first_spin] = read(some, &Contact::first);
    const auto [second, second_velocity, second_spin] = read(some, &Contact::second);
    const Triple<Lanes> apart = box_.nearest({second[0] - first[0], second[1] - first[1], second[2] - first[2]});
    const Lanes distance = square_root(dot(apart, apart)), reach = first[3] + second[3],
                masses = first_velocity[3] + second_velocity[3];
    // One division instead of three: of 1, of the product of the radii and of that of the masses.
    const Lanes reach_and_masses = reach * masses, inverse = 1.0 / (distance * reach_and_masses);
    laws::ContactMotion<Lanes> at;
    at.normal = (inverse * reach_and_masses) * apart;
    const Lanes gap = distance - reach;
    Lanes beyond = -gap, rest{};
    if constexpr (rests) {
      rest = contacts_.rest_of(begin);
      rest = maximum(Lanes(rest < beyond ? rest : beyond), Lanes{});
      contacts_.rest_of(begin) = rest;
      beyond -= rest;
    }
    const LaneMask touches = beyond > 0.0;
    at.overlap = touches ? beyond : Lanes{} + tiny;
    at.reduced_radius = first[3] * second[3] * (inverse * distance * masses);
    at.reduced_mass = first_velocity[3] * second_velocity[3] * (inverse * distance * reach);
    at.step = step_;
    Lanes half = 0.5 * at.overlap;
    if constexpr (rests) half += 0.5 * rest;
    const Lanes first_arm = first[3] - half, second_arm = second[3] - half;
    const Triple<Lanes> one{first_spin[0], first_spin[1], first_spin[2]}, other{second_spin[0], second_spin[1], second_spin[2]};
    const Triple<Lanes> velocity{second_velocity[0] - first_velocity[0], second_velocity[1] - first_velocity[1],
                                 second_velocity[2] - first_velocity[2]};
    at.velocity = velocity - cross(first_arm * one + second_arm * other, at.normal);
    if constexpr (rolls) at.rolling = at.reduced_radius * cross(other - one, at.normal);
    if (!is_one_material_) look_up(first_spin[3], second_spin[3]);
    laws::ContactMemory<Lanes> memory;
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
    for (int lane = 0; lane < lane_count; ++lane) {
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
    std::array<Lanes, 4> place, velocity, spin;
  };

  /// One of the two spheres of `lane_count` contacts.
  SphereLanes read(const Contact* contacts, Index Contact::*sphere) const {
    const auto at = [&](std::size_t lane) { return static_cast<std::size_t>(contacts[lane].*sphere); };
    return {load_quads([&](std::size_t lane) { return &spheres_.place[at(lane)].x; }),
            load_quads([&](std::size_t lane) { return &spheres_.place[at(lane)].vx; }),
            load_quads([&](std::size_t lane) { return &spheres_.spin[at(lane)].x; })};
  }

  /// Pairs that do not push: no force, and where there is a gap sleep for as long as it lasts.
  void leave_alone(std::size_t begin, int lanes, LaneMask touches, const Lanes& gap, laws::ContactForce<Lanes>& force) {
    force.normal = select(touches, force.normal, Lanes{});
    for (auto* part : {&force.friction, &force.rolling}) *part = select(touches, *part, Triple<Lanes>{});
    for (int lane = 0; lane < lanes; ++lane) {
      if (touches[lane] != 0 || gap[lane] < 0) continue;
      const std::size_t contact = begin + static_cast<std::size_t>(lane);
      pairs_.sleep_on(contacts_[contact].pair, approach_ + gap[lane]);
      parted_.push_back(contact);
    }
  }

  void look_up(const Lanes& one, const Lanes& other) {
    std::array<const Real*, lane_count> from, further;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      from[lane] =
          pairs_.table_.numbers(static_cast<Index>(one[lane]) * pairs_.table_.materials + static_cast<Index>(other[lane]));
      further[lane] = from[lane] + 4;
    }
    const auto numbers = load_quads(from), more = load_quads(further);
    constants_ = {numbers[0], numbers[1], numbers[2], numbers[3], more[0], more[1]};
  }

  /// Equal and opposite forces; moments about both centres, whose arms together are the distance.
  void deliver(const laws::ContactForce<Lanes>& force, const laws::ContactMotion<Lanes>& at, const Lanes& first_arm,
               const Lanes& second_arm, std::size_t begin, int lanes) {
    const Triple<Lanes> push = force.normal * at.normal + force.friction, moment = cross(force.friction, at.normal), none;
    Triple<Lanes> first_moment = first_arm * moment, second_moment = second_arm * moment;
    if constexpr (rolls) {
      const Triple<Lanes> rolling = at.reduced_radius * cross(at.normal, force.rolling);
      first_moment = first_moment - rolling;
      second_moment = second_moment + rolling;
    }
    const LoadRows first(none - push, first_moment), second(push, second_moment);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(lanes); ++lane) {
      const Contact& contact = contacts_[begin + lane];
      first.add(lane, &own_[static_cast<std::size_t>(contact.first) - begin_]);
      second.add(lane, loads_.at(contact.slot, own_));
    }
  }

  void book(const laws::ContactForce<Lanes>& force, LaneMask touches, int lanes) {
    Lanes counts = touches ? Lanes{} + 1 : Lanes{};
    for (int lane = lanes; lane < lane_count; ++lane) counts[lane] = 0;
    elastic_ += counts * force.elastic_energy;
    sliding_ += counts * force.sliding_energy;
    dashpot_work_ += counts * step_ * force.dashpot_power;
    sliding_work_ += counts * step_ * force.sliding_power;
    touching_ += counts;
  }

  PairContacts& pairs_;
  BlockContacts& contacts_;
  const state::Spheres& spheres_;
  LoadTable& loads_;
  state::SphereLoad* own_;
  std::size_t begin_;
  Real approach_;
  Lanes step_;
  BoxLanes box_;
  bool is_one_material_;
  laws::ContactConstants<Lanes> constants_;
  std::vector<std::size_t> parted_;
  Lanes elastic_{}, sliding_{}, dashpot_work_{}, sliding_work_{}, touching_{};
};

}  // namespace sazare::methods::spheres
