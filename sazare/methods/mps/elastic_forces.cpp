#include "sazare/methods/mps/elastic_forces.hpp"

#include <utility>

namespace sazare::methods::mps {

template <int D>
ElasticForces<D>::ElasticForces(LinkTable<D> links, RotationRemoval removal) : links_(std::move(links)), removal_(removal) {}

template <int D>
void ElasticForces<D>::evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) {
  evaluate_links(links_, removal_, particles, particles.rotation, pressure_, acceleration);
}

template <int D>
Real ElasticForces<D>::energy(const state::Particles<D>& particles) {
  return energy_of_links(links_, removal_, particles, particles.rotation);
}

template class ElasticForces<2>;
template class ElasticForces<3>;

}  // namespace sazare::methods::mps
