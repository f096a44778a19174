#pragma once

/// Uniform acceleration of all bodies.

#include <numeric>
#include <vector>

#include "sazare/levels/terms/term.hpp"

namespace sazare::terms {

template <int D>
class Gravity final : public Term<D> {
public:
  Gravity(const Vector<D>& acceleration, const state::Bodies<D>& bodies)
      : acceleration_(acceleration), start_(bodies.start), given_(static_cast<std::size_t>(bodies.size())) {
    for (Index body = 0; body < bodies.size(); ++body) {
      links_.push_back({body, Link::outside});
      const auto at = static_cast<std::size_t>(body);
      mass_.push_back(bodies.inertia[at].mass);
    }
  }

  std::string_view name() const override { return "gravity"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override {
    std::vector<Index> all(links_.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<D>&) override {
    for (const Due& at : due) given_[static_cast<std::size_t>(at.link)] = {now.tick, at.acting, at.ahead};
  }

  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<D>& bodies, std::span<Impulse<D>> sum,
              CauseImpulses<D>&) const override {
    for (std::size_t i = 0; i < which.size(); ++i) {
      const auto at = static_cast<std::size_t>(which[i]);
      const Vector<D> weight = mass_[at] * acceleration_;
      const Angular<D> about_pole = moment(state::pose_at(bodies.motion[at], now).position - bodies.pole, weight);
      const Real open = sum[i].until_next - given_[at].ahead + now.seconds_since(given_[at].tick);
      if (given_[at].tick > bodies.motion[at].last_kick) {
        sum[i].linear += given_[at].acting * weight;
        sum[i].angular += given_[at].acting * about_pole;
      }
      sum[i].linear_lead += open * weight;
      sum[i].angular_lead += open * about_pole;
    }
  }

  Rates rates(Index) const override { return {}; }

  /// The work of gravity is known from the places alone.
  void add_energies(const Synchronized<D>& at, EnergySums& energies) const override {
    for (std::size_t body = 0; body < mass_.size(); ++body)
      if (at.counts(links_[body]))
        energies[EnergyKind::work] += mass_[body] * acceleration_.dot(at.pose[body].position - start_[body]);
  }

  void carry(Index link, Parcel& parcel) override { parcel(given_[static_cast<std::size_t>(link)]); }
  void columns(Archive& archive) override { archive("given", given_); }

private:
  struct Given {
    Tick tick = -1;
    Real acting = 0;
    Real ahead = 0;
  };

  Vector<D> acceleration_;
  std::vector<Real> mass_;
  std::vector<Vector<D>> start_;
  std::vector<Given> given_;
  std::vector<Link> links_;
};

}  // namespace sazare::terms
