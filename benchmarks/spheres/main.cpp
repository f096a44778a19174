/// Sphere-steps per second of method spheres: grains of 1 mm that settle under gravity on a floor, periodic sides, Hertz-Mindlin
/// with history.
///
///     spheres THREADS ACROSS [FILE [STEPS [MODEL]]]
///
/// prints `spheres,sphere_steps_per_second,contacts_per_sphere,bytes_per_sphere,resident,candidates,ghosts,searches` of STEPS
/// steps, 1000 where none are given, after half as many that make the contacts; bytes per sphere at the largest (while pairs are
/// sought) and at the end, and how many candidates and ghosts of tiles there are per sphere. Where FILE is given and not "-", it
/// gets the start as rows of radius, x, y, z, vx, vy, vz, from which other codes can begin. MODEL is that of contacts as in
/// cases, hertz where none is given, or mindlin_deresiewicz.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "benchmarks/memory.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"

namespace {

using namespace sazare;
using namespace sazare::benchmarks;

constexpr Real radius = 5e-4, spacing = 1.0005e-3, speed = 0.05, step = 2e-6;

state::Spheres bed(int across) {
  std::uint64_t seed = 42;
  const auto random = [&] {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return speed * (static_cast<Real>(seed >> 11) / 4503599627370496.0 - 1);
  };
  state::Spheres spheres;
  spheres.box.length = Vector3(spacing * across, spacing * across, 0);
  for (int k = 0; k < across; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        spheres.add(spacing * Vector3(i + 0.5, j + 0.5, k + 0.5), radius, 2500, 0);
        const Real vx = random(), vy = random(), vz = random();
        spheres.set_motion(spheres.size() - 1, {vx, vy, vz}, Vector3::Zero());
      }
  return spheres;
}

void write(const state::Spheres& spheres, const std::string& name) {
  std::FILE* const file = std::fopen(name.c_str(), "w");
  if (file == nullptr) return;
  for (const auto& at : spheres.place)
    std::fprintf(file, "%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", at.radius, at.x, at.y, at.z, at.vx, at.vy, at.vz);
  std::fclose(file);
}

}  // namespace

int main(int count, char** arguments) {
  const int steps = count > 4 ? std::atoi(arguments[4]) : 1000;
  const int threads = count > 1 ? std::atoi(arguments[1]) : 0, across = count > 2 ? std::atoi(arguments[2]) : 0;
  const std::string model = count > 5 ? arguments[5] : "hertz";
  if (threads < 1 || across < 2 || steps < 2 || (model != laws::Hertz::word && model != laws::MindlinDeresiewicz::word)) {
    std::fprintf(stderr, "usage: spheres THREADS ACROSS [FILE [STEPS [hertz|mindlin_deresiewicz]]]\n");
    return 2;
  }
  give_back_large_tables();
  parallel::set_threads(threads);
  const Real before = largest_resident_bytes();
  state::Spheres start = bed(across);
  if (count > 3 && std::string(arguments[3]) != "-") write(start, arguments[3]);
  const auto spheres = static_cast<Real>(start.size());
  methods::spheres::ContactTable table(model == laws::Hertz::word ? laws::model_of<laws::Hertz> : laws::model_of<laws::MindlinDeresiewicz>, 1);
  const laws::GrainElasticity grain{1e8, 0.3};
  table.set(0, 0, laws::hertz_constants(grain, grain, 0.7, {0.5}));
  methods::spheres::SphereStepper stepper(std::move(start), table, {{}}, {step, Vector3(0, 0, -9.81), 0.1 * 2 * radius, radius});
  stepper.start();
  for (int k = 0; k < steps / 2; ++k) stepper.advance();
  const auto began = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) stepper.advance();
  const Real seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - began).count();
  stepper.evaluate_now();
  const Real largest = largest_resident_bytes(), resident = resident_bytes();
  std::printf("%.0f,%.4g,%.3g,%.4g,%.4g,%.3g,%.3g,%lld\n", spheres, steps * spheres / seconds,
              static_cast<Real>(stepper.contacts()) / spheres, (largest - before) / spheres, (resident - before) / spheres,
              static_cast<Real>(stepper.levels().pairs(0).pairs().other.size()) / spheres,
              static_cast<Real>(stepper.levels().loads(0).ghosts()) / spheres, static_cast<long long>(stepper.searches()));
}
