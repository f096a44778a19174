#pragma once

/// Rectangles and boxes of particles for the tests.

#include "sazare/methods/mps/elastic_forces.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::methods::mps {

struct Soil {
  Real density = 1500;           ///< [kg/m3]
  Real s_wave_velocity = 100;     ///< [m/s]
  Real p_wave_velocity = 200;  ///< [m/s]
  Real damping_ratio = 0;
};

/// Sites of a box of particles; the last axis runs fastest.
template <int D>
std::vector<Site<D>> box_sites(const Site<D>& counts);

/// Particles at sites, at rest; the particle at the origin stands at half a spacing on every axis.
template <int D>
state::Particles<D> make_particles(const std::vector<Site<D>>& sites, Real spacing, const Soil& soil);

/// The column of [Yoshida2010], section 3: S waves, the two sides and the base held.
struct Column2 {
  Column2(int across, int high, Real spacing, const Soil& soil);

  std::vector<Site<2>> sites;
  state::Particles<2> particles;
  LinkTable<2> links;
  particles::ParticleSupports<2> supports;

  particles::UniformStepper<2> stepper(const particles::UniformRules& rules) const {
    return {particles, std::make_unique<ElasticForces<2>>(links, RotationRemoval::mean_rotation), supports, rules};
  }
};

/// Numbers between -1 and 1.
class Noise {
public:
  Real operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state_ >> 11) / 4503599627370496.0 - 1;
  }

private:
  std::uint64_t state_ = 42;
};

}  // namespace sazare::methods::mps
