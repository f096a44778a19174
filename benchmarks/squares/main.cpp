/// Element-steps per second of method rectangles with a number of threads, scene by scene:
///
///     squares THREADS [SCENE]
///
/// prints `scene,elements,element_steps_per_second`, the fastest of three measurements. Nothing is written. The scenes
/// lattice-* are a free plate that vibrates, N springs on a face; bent-* is a plate in which every link has lost a spring;
/// packing-* is a free plate of irregular polygons.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "sazare/geometry/plane/voronoi.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"

namespace {

using namespace sazare;
constexpr Real radius = 0.05, step = 1e-5;

void set_in_motion(test::Scene& scene) {
  scene.make(step);
  auto& particles = scene.particles();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.velocity[0][i] = 1e-3 * particles.start[1][i];
    particles.velocity[2][i] = 1e-3 * particles.start[0][i];
  }
}

test::Scene plate(int columns, int rows, int springs, bool damaged) {
  test::Scene scene;
  const Real mass = 4 * radius * radius * scene.density;
  scene.kinds = {test::square_faces(radius, 1e8, 4e7, springs, laws::FaceFormula::small, 0.1, mass)};
  if (damaged) scene.kinds[0].springs.cohesion_limit = 1e-9;  // slips from the start
  scene.contact = {1e8, 4e7, 0.1, 0.5, 1};
  scene.add_lattice(columns, rows, radius, {0, 0}, 0);
  set_in_motion(scene);
  return scene;
}

test::Scene packing(int columns, int rows, int springs) {
  test::Scene scene;
  scene.kinds = {test::facets_of(1e8, 4e7, springs, 1e300, 0.1)};
  scene.contact = {1e8, 4e7, 0.1, 0.5, 1};
  const geometry::Vector2 upper = 2 * radius * geometry::Vector2(columns, rows);
  const std::vector<geometry::Vector2> outline = {{0, 0}, {upper.x(), 0}, upper, {0, upper.y()}};
  const auto nuclei = geometry::scatter_nuclei(outline, 2 * radius, 1);
  scene.add_packing(methods::rectangles::pack(nuclei, outline, scene.density), 0);
  set_in_motion(scene);
  return scene;
}

void measure(const char* name, Real elements, bool damaged, test::Scene scene) {
  auto stepper = scene.make(step);
  stepper->start();
  stepper->advance();
  const int steps = std::max(5, static_cast<int>((damaged ? 1e6 : 5e6) / elements));
  Real best = 0;
  for (int round = 0; round < 3; ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) stepper->advance();
    const Real seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - began).count();
    best = std::max(best, elements * steps / seconds);
  }
  std::printf("%s,%.0f,%.4g\n", name, elements, best);
  std::fflush(stdout);
}

const char* only = nullptr;  // scene to be measured; all where null

bool is_wanted(const char* name) { return only == nullptr || std::strcmp(name, only) == 0; }

void measure(const char* name, int columns, int rows, int springs, bool damaged = false) {
  if (is_wanted(name)) measure(name, static_cast<Real>(columns) * rows, damaged, plate(columns, rows, springs, damaged));
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2 || count > 3 || std::atoi(arguments[1]) < 1) {
    std::fprintf(stderr, "usage: squares THREADS [SCENE]\n");
    return 2;
  }
  if (count == 3) only = arguments[2];
  parallel::set_threads(std::atoi(arguments[1]));
  measure("lattice-1k-N1", 40, 25, 1);
  measure("lattice-1k-N5", 40, 25, 5);
  measure("lattice-10k-N1", 200, 50, 1);
  measure("lattice-10k-N5", 200, 50, 5);
  measure("lattice-10k-N10", 200, 50, 10);
  measure("lattice-100k-N5", 1000, 100, 5);
  measure("lattice-1m-N1", 2000, 500, 1);
  measure("lattice-1m-N5", 2000, 500, 5);
  if (is_wanted("packing-10k-N5")) measure("packing-10k-N5", 10000, false, packing(200, 50, 5));
  if (is_wanted("packing-100k-N5")) measure("packing-100k-N5", 100000, false, packing(1000, 100, 5));
  measure("bent-10k-N1", 200, 50, 1, true);
  measure("bent-10k-N5", 200, 50, 5, true);
}
