#pragma once

/// Uniform acceleration of all bodies.

#include <numeric>
#include <vector>

#include "sazare/terms/term.hpp"

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

  void evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<D>&) override {
    for (const Due& at : due) given_[static_cast<std::size_t>(at.link)] = {now.tick, at.acting, at.ahead};
  }

  void gather(const Moment& now, std::span<const Index> which, const state::Bodies<D>&,
              std::span<Impulse<D>> sum) const override {
    for (std::size_t i = 0; i < which.size(); ++i) {
      const auto at = static_cast<std::size_t>(which[i]);
      if (given_[at].tick == now.tick) sum[i].linear += (mass_[at] * given_[at].acting) * acceleration_;
    }
  }

  void book(std::span<const Index>, std::span<const Tick>, std::span<const MeanMotion<D>>) override {}
  Rates rates(Index) const override { return {}; }

  void gather_ahead(Tick now, std::span<Impulse<D>> sum) const override {
    for (std::size_t body = 0; body < sum.size(); ++body)
      if (given_[body].tick == now) sum[body].linear += (mass_[body] * given_[body].ahead) * acceleration_;
  }

  /// The work of gravity is known from the places alone.
  void add_energies(const Synchronized<D>& at, Ledger& ledger) const override {
    for (std::size_t body = 0; body < mass_.size(); ++body)
      ledger[Account::work] +=
          mass_[body] * acceleration_.dot(at.pose[body].position - start_[body]);
  }

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
