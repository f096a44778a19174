/// Particle-steps per second of method mps with a number of threads, scene by scene:
///
///     particles THREADS
///
/// prints `scene,particles,particle_steps_per_second`, the fastest of three measurements. Nothing is written.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "sazare/methods/mps/elastic_forces.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace {

using namespace sazare;
using methods::mps::Site;

template <int D>
particles::UniformStepper<D> body(int across, int high) {
  std::vector<Site<D>> sites;
  const int deep = D == 3 ? across : 1;
  for (int a = 0; a < across; ++a)
    for (int b = 0; b < deep; ++b)
      for (int c = 0; c < high; ++c) {
        Site<D> site{};
        site[0] = a;
        if constexpr (D == 3) site[1] = b;
        site[D - 1] = c;
        sites.push_back(site);
      }
  state::Particles<D> particles;
  particles.spacing = 1;
  particles.resize(static_cast<Index>(sites.size()));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t axis = 0; axis < D; ++axis) particles.start[axis][i] = sites[i][axis] + 0.5;
    particles.set_density(static_cast<Index>(i), 1500);
    particles.shear_modulus[i] = 15e6;
    particles.lame[i] = 30e6;
    particles.damping_ratio[i] = 0.02;
    particles.velocity[0][i] = 1e-3 * sites[i][D - 1];
  }
  auto forces = std::make_unique<methods::mps::ElasticForces<D>>(methods::mps::make_links<D>(sites, 1, 1.5),
                                                                 methods::mps::RotationRemoval::mean_rotation);
  return {std::move(particles), std::move(forces), particles::ParticleSupports<D>{},
          particles::UniformRules{1e-3, particles::Integrator::verlet, laws::RayleighDamping::make(1, 15)}};
}

template <int D>
void measure(const char* scene, int across, int high) {
  auto stepper = body<D>(across, high);
  stepper.start();
  const auto particles = static_cast<Real>(stepper.particles().count);
  const int steps = std::max(10, static_cast<int>(1e7 / particles));
  Real best = 0;
  for (int round = 0; round < 3; ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (int step = 0; step < steps; ++step) stepper.advance();
    const Real seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - began).count();
    best = std::max(best, particles * steps / seconds);
  }
  std::printf("%s,%.0f,%.4g\n", scene, particles, best);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 || std::atoi(arguments[1]) < 1) {
    std::fprintf(stderr, "usage: particles THREADS\n");
    return 2;
  }
  parallel::set_threads(std::atoi(arguments[1]));
  measure<2>("plane-4k", 20, 200);
  measure<2>("plane-100k", 100, 1000);
  measure<3>("solid-16k", 20, 40);
}
