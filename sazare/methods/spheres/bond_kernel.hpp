#pragma once

/// Forces of as many bonds as there are lanes.

#include "sazare/methods/spheres/bonds.hpp"
#include "sazare/methods/spheres/load_rows.hpp"

namespace sazare::methods::spheres {

template <bool breaks, bool damped>
class BondKernel {
public:
  BondKernel(BondLinks& bonds, const std::vector<laws::BondStrength<Real>>& kinds, const state::Spheres& spheres,
             const Bonds::Task& task)
      : bonds_(bonds),
        kinds_(kinds),
        spheres_(spheres),
        task_(task),
        begin_(task.loads.begin_of(task.tile)),
        box_(spheres.box),
        step_(broadcast(task.step)) {}

  /// Evaluates as many links as there are lanes, beginning with `link`.
  void evaluate(std::size_t link) {
    std::array<const Real*, lane_count> place, other_place, turn, other_turn;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const auto i = static_cast<std::size_t>(bonds_.first[link + lane]),
                 j = static_cast<std::size_t>(bonds_.ends.second[link + lane]);
      place[lane] = &spheres_.place[i].x;
      other_place[lane] = &spheres_.place[j].x;
      turn[lane] = &spheres_.turn[i].w;
      other_turn[lane] = &spheres_.turn[j].w;
    }
    const auto first = load_quads(place), second = load_quads(other_place), turned = load_quads(turn),
               other_turned = load_quads(other_turn);
    const laws::BondStiffness<Lanes> stiffness{column(bonds_.length, link), column(bonds_.stretch, link),
                                               column(bonds_.shear, link), column(bonds_.bend, link), column(bonds_.twist, link)};
    laws::BondPose<Lanes> pose;
    pose.apart = box_.nearest({second[0] - first[0], second[1] - first[1], second[2] - first[2]});
    pose.first = {turned[0], turned[1], turned[2], turned[3]};
    pose.second = {other_turned[0], other_turned[1], other_turned[2], other_turned[3]};
    pose.direction = {column(bonds_.direction_x, link), column(bonds_.direction_y, link), column(bonds_.direction_z, link)};
    auto force = laws::bond_force<Lanes>(stiffness, pose, Lanes{} + 1);
    if constexpr (breaks) {
      weaken(link, force, pose, first[3], second[3]);
    } else {
      energy_ += force.energy + force.compression;
    }
    if constexpr (damped) drag(link, force, pose.apart, place, other_place);
    deliver(link, force);
  }

  ContactSums sums() const {
    ContactSums total;
    for (int lane = 0; lane < lane_count; ++lane) {
      total.bonds += energy_[lane];
      total.bond_drag += drag_work_[lane];
      total.fracture += fracture_[lane];
    }
    total.fracture -= contact_energy_;
    total.broken = broken_;
    return total;
  }

private:
  static Lanes column(const std::vector<Real>& values, std::size_t link) { return load_lanes(&values[link]); }

  /// Damage by the use of the strength, from the force of the sound bond; what it takes is added up over the step as by the
  /// trapezoidal rule, as the kicks do.
  void weaken(std::size_t link, laws::BondForce<Lanes>& force, const laws::BondPose<Lanes>& pose, const Lanes& radius,
              const Lanes& other_radius) {
    laws::BondStrength<Lanes> strength;
    const Real* const table = &kinds_.front().tensile;
    std::array<const Real*, lane_count> from;
    for (std::size_t lane = 0; lane < lane_count; ++lane) from[lane] = table + std::ptrdiff_t{4} * bonds_.kind[link + lane];
    const auto numbers = load_quads(from);
    strength = {numbers[0], numbers[1], numbers[2], numbers[3]};
    const Lanes before = column(bonds_.largest_use, link), energy_before = column(bonds_.energy_before, link);
    const Lanes use = laws::bond_use<Lanes>(strength, force, column(bonds_.radius, link)), largest = maximum(before, use);
    const Lanes kept_before = laws::kept_stiffness<Lanes>(before, strength.ultimate),
                kept = laws::kept_stiffness<Lanes>(largest, strength.ultimate);
    // A broken bond carries no compression either: from then on the contact does.
    const LaneMask breaks_now = (before < strength.ultimate) & (largest >= strength.ultimate);
    const Lanes holds = select(largest < strength.ultimate, Lanes{} + 1, Lanes{});
    Lanes lost = 0.5 * (kept_before - kept) * (energy_before + force.energy);
    if (any(breaks_now)) {
      lost += select(breaks_now, force.compression, Lanes{});
      note_broken(link, breaks_now, pose.apart, {radius, other_radius, force.compression});
    }
    energy_ += kept * force.energy + holds * force.compression;
    fracture_ += lost;
    store_lanes(&bonds_.largest_use[link], largest);
    store_lanes(&bonds_.energy_before[link], force.energy);
    if (!any(largest > 1.0)) return;
    const Lanes tension = Lanes{} - dot(force.force, force.direction),
                pull = select(tension > 0.0, Lanes(kept * tension), Lanes(holds * tension));
    force.force = kept * (force.force + tension * force.direction) - pull * force.direction;
    force.first_moment = kept * force.first_moment;
    force.second_moment = kept * force.second_moment;
  }

  /// What of broken bonds their contacts must know.
  struct Ends {
    Lanes radius, other_radius, compression;
  };

  /// The contact begins with the overlap at which it holds what the bond held in compression, and at most with what came since
  /// the start; it pushes beyond this initial overlap alone. What it holds is taken off what breaking has cost, which so is never
  /// below 0.
  void note_broken(std::size_t link, LaneMask breaks_now, const LaneVector& apart, const Ends& ends) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (breaks_now[lane] == 0) continue;
      const std::size_t at = link + static_cast<std::size_t>(lane);
      const auto i = static_cast<std::size_t>(bonds_.first[at]), j = static_cast<std::size_t>(bonds_.ends.second[at]);
      const Real distance =
          std::sqrt(apart[0][lane] * apart[0][lane] + apart[1][lane] * apart[1][lane] + apart[2][lane] * apart[2][lane]);
      const Real reach = ends.radius[lane] + ends.other_radius[lane], overlap = reach - distance;
      const auto& constants =
          task_.contacts.of(static_cast<Index>(spheres_.spin[i].material), static_cast<Index>(spheres_.spin[j].material));
      const laws::ContactModel model = task_.contacts.model;
      const Real reduced_radius = ends.radius[lane] * ends.other_radius[lane] / reach;
      const Real since_start = overlap - std::max(reach - bonds_.length[at], Real{0});
      const Real begins = std::min(std::max(since_start, Real{0}),
                                   laws::overlap_of_energy(model, constants, ends.compression[lane], reduced_radius));
      contact_energy_ += laws::normal_energy(model, constants, begins, reduced_radius);
      bonds_.broken[task_.tile].push_back({at, std::max(overlap - begins, Real{0})});
      ++broken_;
    }
  }

  void drag(std::size_t link, laws::BondForce<Lanes>& force, const LaneVector& apart,
            const std::array<const Real*, lane_count>& place, const std::array<const Real*, lane_count>& other_place) {
    std::array<const Real*, lane_count> velocity, other_velocity, spin, other_spin;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      velocity[lane] = place[lane] + 4;
      other_velocity[lane] = other_place[lane] + 4;
      spin[lane] = &spheres_.spin[static_cast<std::size_t>(bonds_.first[link + lane])].x;
      other_spin[lane] = &spheres_.spin[static_cast<std::size_t>(bonds_.ends.second[link + lane])].x;
    }
    const auto v = load_quads(velocity), u = load_quads(other_velocity), w = load_quads(spin), z = load_quads(other_spin);
    laws::BondDamping<Lanes> damping{column(bonds_.along, link), column(bonds_.across, link), column(bonds_.turning, link)};
    if constexpr (breaks) {
      const auto holds = column(bonds_.largest_use, link) < 1.0;  // dashpots go with the first damage
      for (Lanes* part : {&damping.along, &damping.across, &damping.turning}) *part = select(holds, *part, Lanes{});
    }
    const Lanes half = Lanes{} + 0.5;
    const auto drag = laws::bond_drag<Lanes>(damping, apart, force.direction, {u[0] - v[0], u[1] - v[1], u[2] - v[2]},
                                             {z[0] - w[0], z[1] - w[1], z[2] - w[2]},
                                             half * LaneVector{z[0] + w[0], z[1] + w[1], z[2] + w[2]});
    force.force = force.force + drag.force;
    force.first_moment = force.first_moment + drag.arm - drag.moment;
    force.second_moment = force.second_moment + drag.arm + drag.moment;
    drag_work_ += step_ * drag.power;
  }

  void deliver(std::size_t link, const laws::BondForce<Lanes>& force) {
    const LaneVector back = LaneVector{} - force.force;
    const LoadRows first(back, force.first_moment), second(force.force, force.second_moment);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      first.add(lane, &task_.own[static_cast<std::size_t>(bonds_.first[link + lane]) - begin_]);
      second.add(lane, task_.loads.bonded(link + lane, task_.own));
    }
  }

  BondLinks& bonds_;
  const std::vector<laws::BondStrength<Real>>& kinds_;
  const state::Spheres& spheres_;
  const Bonds::Task& task_;
  std::size_t begin_;
  BoxLanes<Lanes> box_;
  Lanes step_;
  Lanes energy_{}, drag_work_{}, fracture_{};
  Real contact_energy_ = 0;
  std::int64_t broken_ = 0;
};

}  // namespace sazare::methods::spheres
