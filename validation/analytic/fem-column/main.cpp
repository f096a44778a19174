#include <algorithm>
#include <cmath>

#include "sazare/methods/fem/boundary_faces.hpp"
#include "tests/support/element_boxes.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using namespace sazare::methods::fem;

constexpr Real velocity = 100, density = 2000, height = 10, peak_time = 0.1;

struct Surface {
  Real error = 0;    ///< largest, of the velocity, over the wave's peak
  Real arrival = 0;  ///< of the peak [s]
  Real peak = 0;     ///< largest velocity over that of the wave
  Real residual = 0;   ///< energy that is found nowhere over the wave's
};

/// A column in shear on a viscous base through which a wavelet comes in.
Surface surface(geometry::ElementShape shape, int cells, Real step) {
  const auto mesh = test::box(shape, {{1, height, 1}, {1, cells, 1}, 0});
  SolidMaterial soil;
  soil.density = density;
  soil.elastic = {density * velocity * velocity, 2 * density * velocity * velocity};
  laws::GroundMotion wave;
  wave.quantity = laws::MotionQuantity::velocity;
  wave.ricker_wave = {10, peak_time};
  Supports<2> supports;
  supports.motions = {wave};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  ViscousBoundary<2> base;
  base.motion = {0, Support::no_motion};
  for (const auto& face : mesh.find_group("bottom")->elements)
    base.faces.push_back({{face.node_list().begin(), face.node_list().end()},
                          face_impedance<2>(mesh, face, density * soil.p_wave_velocity(), density * velocity)});
  supports.viscous = {base};
  methods::fem::FemRules rules;
  rules.step = step;
  methods::fem::FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, soil)), supports, rules);
  stepper.start();
  const auto top = static_cast<std::size_t>(test::node_at(mesh, {0, height, 0})) * 2;
  Surface result;
  while (stepper.time() < 0.4) {
    stepper.advance();
    const Real now = stepper.state().velocity[top];
    const Real exact = 2 * wave.at(stepper.time() - height / velocity).velocity;
    result.error = std::max(result.error, std::abs(now - exact));
    if (std::abs(now) <= std::abs(result.peak)) continue;
    result.peak = now;
    result.arrival = stepper.time();
  }
  result.peak = std::abs(result.peak);
  result.residual = std::abs(stepper.energy_residual()) / stepper.work().waves;
  return result;
}

}  // namespace

int main() {
  using Shape = geometry::ElementShape;
  const Surface fine = surface(Shape::quadrilateral8, 40, 2e-4);
  validation::print_row("arrival", fine.arrival - peak_time);
  validation::print_row("doubling", fine.peak);
  validation::print_row("wave-form", fine.error);
  validation::print_row("energy-balance", fine.residual);
  const Surface coarse = surface(Shape::quadrilateral4, 40, 1e-3), half = surface(Shape::quadrilateral4, 80, 5e-4);
  validation::print_row("order", std::log2(coarse.error / half.error));
}
