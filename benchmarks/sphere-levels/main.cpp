/// Processor time of method spheres with time levels and with the finest step for all: a bed of grains of 4 mm, one of so many
/// replaced by one of 0.5 mm, that settles on a floor, periodic sides, Hertz-Mindlin with history.
///
///     sphere-levels EVERY ACROSS STEPS
///
/// prints `spheres,fine_spheres,levels_seconds,uniform_seconds,evaluations,uniform_evaluations,kicks,height,uniform_height,
/// residual,uniform_residual` of STEPS base steps, on one thread: how high the centre of mass lies at the end, and what the
/// energy balance leaves as residual, over what was lost.

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"

namespace {

using namespace sazare;

constexpr int finest = 3;
constexpr Real large = 2e-3, small = large / (1 << finest), spacing = 2.001 * large, fraction = 0.2;
constexpr laws::GrainElasticity grain{1e8, 0.3};

struct Bed {
  state::Spheres spheres;
  std::vector<std::int8_t> level;
  int fine = 0;

  Bed(int across, int every) {
    std::uint64_t seed = 42;
    const auto random = [&] {
      seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
      return static_cast<Real>(seed >> 11) / 4503599627370496.0 - 1;
    };
    spheres.box.length = Vector3(spacing * across, spacing * across, 0);
    for (int n = 0; n < across * across * across; ++n) {
      const Vector3 place(n % across + 0.5, n / across % across + 0.5, n / across / across + 0.5);
      const bool is_fine = n % every == every / 2;
      fine += is_fine ? 1 : 0;
      spheres.add(spacing * place, is_fine ? small : large, 2500, 0);
      level.push_back(is_fine ? finest : 0);
      const Real vx = random(), vy = random(), vz = random();
      spheres.set_motion(spheres.size() - 1, 0.05 * Vector3(vx, vy, vz), Vector3::Zero());
    }
  }
};

struct Result {
  Real seconds = 0, height = 0, residual = 0;
  methods::spheres::SphereLevels::Counts counts;
};

Result walk(const Bed& bed, Real step, bool levels, int steps) {
  methods::spheres::ContactTable table(laws::ContactModel::hertz, 1);
  table.set(0, 0, laws::hertz_constants(grain, grain, 0.7, {0.5}));
  methods::spheres::SphereStepper stepper(
      bed.spheres, table, {{}},
      {step, Vector3(0, 0, -9.81), 0.5 * small, small, levels ? bed.level : std::vector<std::int8_t>{}});
  const double began = parallel::processor_seconds();
  stepper.start();
  stepper.evaluate_now();
  const Real before = stepper.energies().sum();
  for (int k = 0; k < steps; ++k) stepper.advance();
  Result result;
  result.seconds = parallel::processor_seconds() - began;
  stepper.evaluate_now();
  const auto now = stepper.energies();
  result.residual = (now.sum() - before) / (now.dashpot_work + now.sliding_work);
  Real mass = 0;
  for (const auto& place : stepper.spheres().place) {
    mass += place.mass;
    result.height += place.mass * place.z;
  }
  result.height /= mass;
  result.counts = stepper.levels().counts();
  return result;
}

}  // namespace

int main(int count, char** arguments) {
  const int every = count > 1 ? std::atoi(arguments[1]) : 0, across = count > 2 ? std::atoi(arguments[2]) : 0,
            steps = count > 3 ? std::atoi(arguments[3]) : 0;
  if (every < 1 || across < 2 || steps < 1) {
    std::fprintf(stderr, "usage: sphere-levels EVERY ACROSS STEPS\n");
    return 2;
  }
  parallel::set_threads(1);
  const Real shear_modulus = 0.5 * grain.youngs_modulus / (1 + grain.poisson_ratio);
  const Real limit = 3.14159265358979 * large * std::sqrt(2500 / shear_modulus) / (0.1631 * grain.poisson_ratio + 0.8766);
  const Bed bed(across, every);
  const Result leveled = walk(bed, fraction * limit, true, steps),
               uniform = walk(bed, fraction * limit / (1 << finest), false, steps << finest);
  std::printf("%zu,%d,%.4g,%.4g,%lld,%lld,%lld,%.10g,%.10g,%.4g,%.4g\n", bed.level.size(), bed.fine, leveled.seconds,
              uniform.seconds, static_cast<long long>(leveled.counts.evaluations),
              static_cast<long long>(leveled.counts.uniform_evaluations), static_cast<long long>(leveled.counts.kicks),
              leveled.height, uniform.height, leveled.residual, uniform.residual);
}
