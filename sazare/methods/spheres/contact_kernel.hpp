#pragma once

/// Forces of as many touching pairs as there are lanes.

#include <algorithm>
#include <bit>
#include <limits>

#include "sazare/core/lane_math.hpp"
#include "sazare/core/lane_records.hpp"
#include "sazare/methods/spheres/load_rows.hpp"
#include "sazare/methods/spheres/pair_contacts.hpp"

namespace sazare::methods::spheres {

template <laws::ContactModel model, bool rolls>
class ContactKernel {
public:
  ContactKernel(PairContacts& contacts, const state::Spheres& spheres, const PairContacts::Task& task)
      : contacts_(contacts),
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

  /// The first `lanes` of the pairs; the rest repeats one of them and does not count.
  void evaluate(PairContacts::AwakePair* pairs, int lanes) {
    for (int lane = lanes; lane < lane_count; ++lane) pairs[lane] = pairs[0];
    for (std::size_t lane = 0; lane < lane_count; ++lane) point(lane, pairs[lane]);
    const auto first = load_records<8>(first_place_), second = load_records<8>(second_place_);
    const auto first_spin = load_quads(first_spin_), second_spin = load_quads(second_spin_);
    const Triple<Lanes> apart = box_.nearest({second[0] - first[0], second[1] - first[1], second[2] - first[2]});
    const Lanes distance = square_root(dot(apart, apart)), reach = first[3] + second[3];
    laws::ContactMotion<Lanes> at;
    at.normal = (1.0 / distance) * apart;
    const Lanes gap = distance - reach;
    const LaneMask touches = gap < 0.0;
    at.overlap = touches ? -gap : Lanes{} + tiny;
    at.reduced_radius = first[3] * second[3] / reach;
    at.reduced_mass = first[7] * second[7] / (first[7] + second[7]);
    at.step = step_;
    const Lanes half = 0.5 * at.overlap, first_arm = first[3] - half, second_arm = second[3] - half;
    const Triple<Lanes> one{first_spin[0], first_spin[1], first_spin[2]}, other{second_spin[0], second_spin[1], second_spin[2]};
    const Triple<Lanes> velocity{second[4] - first[4], second[5] - first[5], second[6] - first[6]};
    at.velocity = velocity - cross(first_arm * one + second_arm * other, at.normal);
    if constexpr (rolls) at.rolling = at.reduced_radius * cross(other - one, at.normal);
    if (!is_one_material_) look_up(first_spin[3], second_spin[3]);
    auto memory = recall();
    auto force = laws::contact_force<model, rolls>(constants_, at, memory);
    if (any(~touches)) part(touches, force, memory);
    sleep(pairs, touches, gap, lanes);
    remember(memory, lanes);
    deliver(force, at, first_arm, second_arm, pairs, lanes);
    book(force, touches, lanes);
  }

  /// Asks for what a pair will read of its second sphere.
  void fetch(const PairContacts::AwakePair& pair) const {
    const auto j = static_cast<std::size_t>(pair.second);
    __builtin_prefetch(&spheres_.place[j]);
    __builtin_prefetch(&spheres_.spin[j]);
    __builtin_prefetch(loads_.second(pair.pair, own_), 1);
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
  static constexpr float least_ = std::numeric_limits<float>::min();  // 0 says that a pair touches
  static constexpr Real tiny = 1e-30;                                 // an overlap at which nothing of the law fails

  void point(std::size_t lane, const PairContacts::AwakePair& pair) {
    const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    first_place_[lane] = &spheres_.place[i];
    second_place_[lane] = &spheres_.place[j];
    first_spin_[lane] = &spheres_.spin[i].x;
    second_spin_[lane] = &spheres_.spin[j].x;
    sliding_memory_[lane] = &contacts_.sliding_[pair.pair].x;
    if constexpr (rolls) rolling_memory_[lane] = &contacts_.rolling_[pair.pair].x;
  }

  /// Pairs that do not touch: no force, and no memory.
  static void part(LaneMask touches, laws::ContactForce<Lanes>& force, laws::ContactMemory<Lanes>& memory) {
    const Triple<Lanes> none;
    force.normal = select(touches, force.normal, Lanes{});
    for (auto* part : {&force.friction, &force.rolling, &memory.sliding, &memory.rolling}) *part = select(touches, *part, none);
  }

  void sleep(const PairContacts::AwakePair* pairs, LaneMask touches, const Lanes& gap, int lanes) {
    constexpr float rounded_down = 1 - 1e-6F;
    if (!any(~touches)) {
      for (int lane = 0; lane < lanes; ++lane) contacts_.sleeps_until_[pairs[lane].pair] = 0;
      return;
    }
    for (int lane = 0; lane < lanes; ++lane)
      contacts_.sleeps_until_[pairs[lane].pair] =
          touches[lane] != 0 ? 0 : std::max(rounded_down * static_cast<float>(approach_ + gap[lane]), least_);
  }

  void look_up(const Lanes& one, const Lanes& other) {
    std::array<const Real*, lane_count> from, further;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      from[lane] =
          contacts_.table_.numbers(static_cast<Index>(one[lane]) * contacts_.table_.materials + static_cast<Index>(other[lane]));
      further[lane] = from[lane] + 4;
    }
    const auto numbers = load_quads(from), more = load_quads(further);
    constants_ = {numbers[0], numbers[1], numbers[2], numbers[3], more[0], more[1]};
  }

  laws::ContactMemory<Lanes> recall() const {
    laws::ContactMemory<Lanes> memory;
    const auto slid = load_quads(as_source(sliding_memory_));
    memory.sliding = {slid[0], slid[1], slid[2]};
    if constexpr (rolls) {
      const auto rolled = load_quads(as_source(rolling_memory_));
      memory.rolling = {rolled[0], rolled[1], rolled[2]};
    }
    return memory;
  }

  void remember(const laws::ContactMemory<Lanes>& memory, int lanes) const {
    store_quads({memory.sliding.x, memory.sliding.y, memory.sliding.z, Lanes{}}, sliding_memory_, lanes);
    if constexpr (rolls) store_quads({memory.rolling.x, memory.rolling.y, memory.rolling.z, Lanes{}}, rolling_memory_, lanes);
  }

  /// Equal and opposite forces; moments about both centres, whose arms together are the distance.
  void deliver(const laws::ContactForce<Lanes>& force, const laws::ContactMotion<Lanes>& at, const Lanes& first_arm,
               const Lanes& second_arm, const PairContacts::AwakePair* pairs, int lanes) {
    const LoadRows rows(force.normal * at.normal + force.friction, cross(force.friction, at.normal));
    std::array<Real, lane_count> first, second;
    store_lanes(first.data(), first_arm);
    store_lanes(second.data(), second_arm);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(lanes); ++lane) {
      rows.add(lane, -1, first[lane], &own_[static_cast<std::size_t>(pairs[lane].first) - begin_]);
      rows.add(lane, 1, second[lane], loads_.second(pairs[lane].pair, own_));
    }
    if constexpr (rolls) {
      const LoadRows rolling(Triple<Lanes>{}, at.reduced_radius * cross(at.normal, force.rolling));
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(lanes); ++lane) {
        rolling.add(lane, 0, -1, &own_[static_cast<std::size_t>(pairs[lane].first) - begin_]);
        rolling.add(lane, 0, 1, loads_.second(pairs[lane].pair, own_));
      }
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

  static std::array<const Real*, lane_count> as_source(const std::array<Real*, lane_count>& pointers) {
    return std::bit_cast<std::array<const Real*, lane_count>>(pointers);
  }

  PairContacts& contacts_;
  const state::Spheres& spheres_;
  LoadTable& loads_;
  state::SphereLoad* own_;
  std::size_t begin_;
  Real approach_;
  Lanes step_;
  BoxLanes box_;
  bool is_one_material_;
  laws::ContactConstants<Lanes> constants_;
  LanePointers<const state::SpherePlace> first_place_, second_place_;
  std::array<const Real*, lane_count> first_spin_, second_spin_;
  std::array<Real*, lane_count> sliding_memory_, rolling_memory_;
  Lanes elastic_{}, sliding_{}, dashpot_work_{}, sliding_work_{}, touching_{};
};

}  // namespace sazare::methods::spheres
