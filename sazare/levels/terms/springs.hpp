#pragma once

/// Linear springs with dashpots between points of bodies, of bodies and the outside, or only against approach: the
/// simplest pair force, for rods, anchors and checks of the step itself.
///
///     f = -(k e + c v) u      e  elongation [m], v its rate [m/s], u unit vector from the first point to the second
///
/// A `pushes_only` spring has no force while e > 0 (its dashpot neither): two bars that meet.

#include <numeric>
#include <vector>

#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::terms {

template <int D>
struct Spring {
  Index first = 0;
  Index second = Link::outside;
  Vector<D> first_arm = Vector<D>::Zero();   ///< in the body frame [m]
  Vector<D> second_arm = Vector<D>::Zero();  ///< in the body frame, or a point of the world for `outside` [m]
  Real length = 0;                           ///< at rest [m], > 0
  Real stiffness = 0;                        ///< [N/m]
  Real damping = 0;                          ///< [N s/m]
  int pushes_only = 0;
};

template <int D>
class Springs final : public Term<D> {
public:
  Springs(std::vector<Spring<D>> springs, const state::Bodies<D>& bodies) : springs_(std::move(springs)) {
    rates_.resize(static_cast<std::size_t>(bodies.size()));
    for (const auto& spring : springs_) {
      links_.push_back({spring.first, spring.second});
      add_rates(spring, spring.first, spring.first_arm, bodies);
      if (spring.second != Link::outside) add_rates(spring, spring.second, spring.second_arm, bodies);
    }
    table_.causes = {Cause::joint_dashpot};
    table_.slots.resize(springs_.size());
    table_.incidence = FixedIncidence(bodies.size(), links_);
  }

  std::string_view name() const override { return "springs"; }
  std::span<const Link> links() const override { return links_; }
  std::vector<Index> first_links() const override {
    std::vector<Index> all(links_.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<D>& bodies) override {
    parallel::parallel_for(due.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (const Due& at : due.subspan(begin, end - begin)) evaluate_one(now, at, bodies);
    });
  }

  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<D>&, std::span<Impulse<D>> sum,
              CauseImpulses<D>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  Rates rates(Index body) const override { return rates_[static_cast<std::size_t>(body)]; }

  void add_energies(const Synchronized<D>& at, EnergySums& energies) const override {
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      if (!at.counts(links_[i])) continue;
      const Real stretch = place(springs_[i], [&](Index body) { return at.pose_of(body); }).elongation;
      if (!springs_[i].pushes_only || stretch < 0)
        energies[EnergyKind::elastic] += 0.5 * springs_[i].stiffness * stretch * stretch;
      table_.take_back(static_cast<Index>(i), links_[i], at, energies);
    }
  }

  void carry(Index link, Parcel& parcel) override { parcel(table_[link]); }
  void columns(Archive& archive) override { archive("slots", table_.slots); }

private:
  struct Place {
    Vector<D> first_arm, second_arm, direction;  ///< the arms from the centres, but from the world's zero for `outside`
    Real elongation;
  };

  template <class PoseOf>
  static Place place(const Spring<D>& spring, PoseOf&& pose_of) {
    const state::Pose<D> first = pose_of(spring.first);
    Place at;
    at.first_arm = first.rotation * spring.first_arm;
    at.second_arm = spring.second_arm;
    Vector<D> apart = spring.second_arm - first.position - at.first_arm;
    if (spring.second != Link::outside) {
      const state::Pose<D> second = pose_of(spring.second);
      at.second_arm = second.rotation * spring.second_arm;
      apart = second.position + at.second_arm - first.position - at.first_arm;
    }
    const Real length = apart.norm();
    at.direction = apart / length;
    at.elongation = length - spring.length;
    return at;
  }

  void evaluate_one(const Instant& now, const Due& due, const state::Bodies<D>& bodies) {
    const Spring<D>& spring = springs_[static_cast<std::size_t>(due.link)];
    const auto body = [&](Index number) -> const state::Motion<D>& { return bodies.motion[static_cast<std::size_t>(number)]; };
    const Place at = place(spring, [&](Index number) { return state::Pose<D>{body(number).position, body(number).rotation}; });
    Vector<D> opening = -body(spring.first).velocity_at(at.first_arm);
    if (spring.second != Link::outside) opening += body(spring.second).velocity_at(at.second_arm);
    const Real on = spring.pushes_only && at.elongation > 0 ? 0 : 1;
    const Vector<D> dashpot = (-on * spring.damping * opening.dot(at.direction)) * at.direction;
    PairForce<D> total, dashpots;
    const Vector<D> point = body(spring.first).position - bodies.pole + at.first_arm;
    dashpots.add_at(point, dashpot);
    total.add_at(point, (-on * spring.stiffness * at.elongation) * at.direction + dashpot);
    write<D, 1>(table_[due.link], now, due, total, {dashpots});
  }

  void add_rates(const Spring<D>& spring, Index body, const Vector<D>& arm, const state::Bodies<D>& bodies) {
    const auto& inertia = bodies.inertia[static_cast<std::size_t>(body)];
    const Real softness = 1 / inertia.mass + arm.squaredNorm() * inertia.inverse_moments.maxCoeff();
    rates_[static_cast<std::size_t>(body)] += Rates{spring.stiffness * softness, spring.damping * softness};
  }

  std::vector<Spring<D>> springs_;
  std::vector<Link> links_;
  std::vector<Rates> rates_;
  SlotTable<D, 1, FixedIncidence> table_;
};

}  // namespace sazare::terms
