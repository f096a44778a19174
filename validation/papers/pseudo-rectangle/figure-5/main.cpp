#include <cmath>
#include <numbers>

#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using laws::FaceFormula;
constexpr Real radius = 0.0125, mass = 0.0671, stiffness = 12e6, turned = 0.1 * std::numbers::pi / 180, step = 1e-6;

struct Recovery {
  Real along = 0, normal = 0, turn = 0;  ///< what is left at the end, over the beginning
  Real growth = 0;                       ///< displacement along the wall at the end over that half way
};

/// A square joined to a wall by a spring at both ends of its face, turned about the middle of the face, and let go.
Recovery recover(FaceFormula formula) {
  test::Scene scene;
  scene.density = mass / (4 * radius * radius);
  scene.contact = {1, 1, 0, 0, 1};
  laws::FaceSprings springs{
      0, radius, radius, stiffness, stiffness, 0, 0, 1e300, 1e300, 0, laws::spring_places(laws::SpringPlaces::ends, 2)};
  springs.normal_damping = springs.shear_damping = 2 * std::sqrt(2 * stiffness * mass) / 2;  // (19) with h_n = 1
  scene.kinds = {{springs, formula}};
  const Index square = scene.add(geometry::OutlineKind::rectangle, {0, radius}, radius, radius);
  const Index wall = scene.add_wall({-1, 0}, {1, 0});
  // The shear springs begin with what the formula makes of the turn: nothing, but r theta where it forgets the translation.
  scene.link(wall, square, 1, 0, formula == FaceFormula::older ? -radius * turned : 0);
  scene.make(step);
  auto& particles = scene.particles();
  const Real x = -radius * std::sin(turned), y = -radius * (1 - std::cos(turned));
  particles.displacement[0][0] = x;
  particles.displacement[1][0] = y;
  particles.angle[0] = turned;
  particles.rotation[0][0] = std::cos(turned);
  particles.rotation[1][0] = std::sin(turned);
  auto stepper = scene.make(step);
  stepper->start();
  Recovery found;
  while (stepper->time() < 0.05) stepper->advance();
  const Real half_way = stepper->particles().displacement[0][0];
  while (stepper->time() < 0.1) stepper->advance();
  found.growth = stepper->particles().displacement[0][0] / half_way;
  found.along = std::abs(stepper->particles().displacement[0][0] / x);
  found.normal = std::abs(stepper->particles().displacement[1][0] / y);
  found.turn = std::abs(stepper->particles().angle[0] / turned);
  return found;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  const Recovery exact = recover(FaceFormula::exact), small = recover(FaceFormula::small), older = recover(FaceFormula::older);
  validation::print_row("exact-along", exact.along);
  validation::print_row("exact-normal", exact.normal);
  validation::print_row("small-along", small.along);
  validation::print_row("small-normal", small.normal);
  validation::print_row("older-along", older.along);
  validation::print_row("older-growth", older.growth);
  validation::print_row("older-turn", older.turn);
}
