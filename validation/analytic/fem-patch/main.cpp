#include <algorithm>
#include <string>

#include "tests/support/element_boxes.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using namespace sazare::methods::fem;

/// Largest error of the displacements of the inner nodes, over the largest displacement.
template <int D>
Real patch_error(geometry::ElementShape shape) {
  const Vector3 size(2, 1.5, 1);
  const auto mesh = test::box(shape, {size, {3, 3, 3}, 0.35});
  const Matrix3 field = (Matrix3() << 1e-3, 3e-4, -2e-4, -5e-4, -7e-4, 4e-4, 6e-4, 1e-4, 2e-4).finished();
  const auto exact = [&](std::size_t node, int axis) {
    Real sum = 0;
    for (int k = 0; k < D; ++k) sum += field(axis, k) * mesh.nodes[node][k];
    return sum;
  };
  Supports<D> supports;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    bool outside = false;
    for (int axis = 0; axis < D; ++axis)
      outside = outside || mesh.nodes[node][axis] < 1e-9 || mesh.nodes[node][axis] > size[axis] - 1e-9;
    for (int axis = 0; outside && axis < D; ++axis) {
      laws::GroundMotion motion;
      motion.shape = laws::GroundMotion::Shape::record;
      motion.quantity = laws::MotionQuantity::displacement;
      motion.record = laws::Record::make(1, {0, exact(node, axis)});
      supports.held.push_back({static_cast<Index>(node), axis, static_cast<Index>(supports.motions.size()), 0});
      supports.motions.push_back(motion);
    }
  }
  methods::fem::FemRules rules;
  rules.step = 1;
  rules.statics = true;
  methods::fem::FemStepper<D> stepper(std::make_unique<Body<D>>(test::of_one_material(mesh, SolidMaterial::elastic_of(1e7, 0.3, 2000))),
                                supports, rules);
  stepper.start();
  stepper.advance();
  Real error = 0, largest = 0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (int axis = 0; axis < D; ++axis) {
      const Real found = stepper.state().displacement[node * D + static_cast<std::size_t>(axis)];
      error = std::max(error, std::abs(found - exact(node, axis)));
      largest = std::max(largest, std::abs(found));
    }
  return error / largest;
}

}  // namespace

int main() {
  test::for_every_shape([]<int D>(geometry::ElementShape shape, std::integral_constant<int, D>) {
    std::string row = test::name_of(shape);
    std::replace(row.begin(), row.end(), ' ', '-');
    validation::print_row(row.c_str(), patch_error<D>(shape));
  });
}
