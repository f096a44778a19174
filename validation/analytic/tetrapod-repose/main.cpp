#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

struct Heap {
  Real restlessness = 0;  ///< kinetic energy over potential energy
  std::vector<state::Clump> bodies;
};

Heap heap(int threads) {
  parallel::set_threads(threads);
  const cases::CaseFile file = registry::read_case("validation/analytic/tetrapod-repose/case.toml");
  runs::SpheresModel model = runs::build_spheres(file);
  methods::spheres::SphereStepper& stepper = *model.stepper;
  stepper.start();
  while (stepper.time() < file.as<cases::SpheresCase>().time.end) stepper.advance();
  stepper.evaluate_now();
  Heap heap;
  heap.bodies = stepper.clumps().clumps;
  const methods::spheres::SphereEnergies energies = stepper.energies();
  heap.restlessness = (energies.translation + energies.rotation) / energies.potential;
  return heap;
}

}  // namespace

int main() {
  const Heap one = heap(1), two = heap(2);
  validation::print_row("at-rest", one.restlessness);
  Real differences = 0;
  for (std::size_t n = 0; n < one.bodies.size(); ++n)
    differences += one.bodies[n].centre != two.bodies[n].centre || one.bodies[n].turn.w != two.bodies[n].turn.w ? 1 : 0;
  validation::print_row("same-bits", differences);
}
