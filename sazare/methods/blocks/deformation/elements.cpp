#include "sazare/methods/blocks/deformation/elements.hpp"

#include <Eigen/Eigenvalues>

#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 1024;  // an element takes some 50 ns, waking a thread some microseconds

terms::Rates rates_of(const DeformableElement& element, const state::Strain& strain) {
  const Eigen::Matrix<Real, 6, 6> stiffness = element.stiffness;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Real, 6, 6>> solver(stiffness, Eigen::EigenvaluesOnly);
  const Real rate = element.volume * solver.eigenvalues().maxCoeff() * strain.inverse_inertia;
  return {rate, element.relaxation_time * rate};
}

}  // namespace

Elements::Elements(std::vector<DeformableElement> elements, const state::Bodies<3>& bodies)
    : elements_(std::move(elements)), link_of_(at(bodies.size()), -1), slots_(elements_.size()) {
  for (const DeformableElement& element : elements_) {
    link_of_[at(element.body)] = static_cast<Index>(links_.size());
    links_.push_back({element.body, Link::outside});
    rates_.push_back(rates_of(element, bodies.strain[at(element.body)]));
  }
}

std::vector<Index> Elements::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void Elements::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (const Due& of : due.subspan(begin, end - begin)) {
      const DeformableElement& element = elements_[at(of.link)];
      const state::Strain& strain = bodies.strain[at(element.body)];
      const Vector6 dashpot = (-element.volume * element.relaxation_time) * (element.stiffness * strain.predicted_rate);
      const Vector6 total = dashpot - element.volume * element.stress(strain.strain);
      Slot& slot = slots_[at(of.link)];
      slot.force.write(slot.evaluated < 0, total, {dashpot});
      slot.acting = of.acting;
      slot.ahead = of.ahead;
      slot.evaluated = static_cast<Real>(now.tick);
    }
  });
}

void Elements::gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const {
  const Index link = link_of_[at(body)];
  if (link < 0) return;
  const Slot& slot = slots_[at(link)];
  terms::add_strain_force(now, slot, slot.force, 0, std::array{terms::Cause::joint_dashpot}, sum);
}

terms::Rates Elements::rates(Index body) const {
  const Index link = link_of_[at(body)];
  return link < 0 ? terms::Rates{} : rates_[at(link)];
}

void Elements::add_energies(const terms::Synchronized<3>& now, terms::EnergySums& energies) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (!now.counts(links_[i])) continue;
    const state::StrainNow& strain = now.strain[at(elements_[i].body)];
    energies[terms::EnergyKind::elastic] += elements_[i].energy(strain.strain);
    const Real after = slots_[i].ahead * slots_[i].force.part_on(0, 0).dot(strain.ahead);
    terms::add_work(terms::Cause::joint_dashpot, -after, energies);
  }
}

}  // namespace sazare::methods::blocks
