#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"
#include "tests/support/still_water.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;
using test::gravity, test::press, test::unit_weight, test::water_at, test::water_density;

TEST(energy_balance, counts_the_work_of_water_that_is_there_comes_and_has_settled) {
  for (const bool statics : {true, false})
    for (const Real ramp : {0.0, 0.3})
      for (const bool settles : {true, false}) {
        const auto mesh = test::box(ElementShape::quadrilateral8, {{1, 4, 1}, {2, 6, 1}, 0});
        Supports<2> supports;
        for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
        supports.gravity.y() = -gravity;
        StillWater<2> water;
        press<2>(mesh, "left", water_at(3.1, 2), water);
        water.pressure.ramp = ramp;
        for (const auto& face : mesh.find_group("left")->elements)
          water.moving.push_back({{face.node_list().begin(), face.node_list().end()},
                                  added_mass<2>(mesh, face, water_at(3.1, 2), water_density, 3.1, MassMatrix::consistent)});
        supports.waters = {water};
        supports.loads = {{"push", test::traction(mesh, "right", {-1e3, 0, 0}), 0.2}};
        FemRules rules;
        rules.step = 0.1;
        rules.statics = statics;
        rules.tolerance = 1e-12;
        FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(2e7, 0.2, 2000))),
                              supports, rules);
        if (settles) stepper.relax();
        stepper.start();
        const Real at_start = stepper.elastic_energy();
        EXPECT_NEAR(at_start, 0, 1e-9);
        Real most = 0;
        for (int step = 0; step < 6; ++step) {
          stepper.advance();
          most = std::max(most, std::abs(stepper.elastic_energy()) + stepper.kinetic_energy());
          EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * most) << statics << ramp << settles << step;
        }
        EXPECT_NE(stepper.work().water, 0);
      }
}

/// The force that a wall feels is that of the pressure, and the inertia of the water that moves with it.
TEST(energy_balance, water_gives_a_moved_wall_the_force_of_its_inertia) {
  const auto mesh = test::box(ElementShape::quadrilateral4, {{1, 2, 1}, {1, 4, 1}, 0});
  Supports<2> supports;
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::acceleration;
  motion.ricker_wave = {2, 0.5};
  supports.motions = {motion};
  StillWater<2> water;
  press<2>(mesh, "left", water_at(2, 2), water);
  for (const auto& face : mesh.find_group("left")->elements)
    water.moving.push_back({{face.node_list().begin(), face.node_list().end()},
                            added_mass<2>(mesh, face, water_at(2, 2), water_density, 2, MassMatrix::lumped)});
  supports.waters = {water};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    supports.held.push_back({static_cast<Index>(node), 0, 0, 0});
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  }
  supports.held.pop_back();  // one freedom is left to find
  FemRules rules;
  rules.step = 1e-2;
  FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(1e9, 0, 2000))), supports,
                        rules);
  stepper.start();
  while (stepper.time() < 0.5) stepper.advance();
  const Real acceleration = motion.at(stepper.time()).acceleration, moving = supports.waters[0].moving_mass();
  EXPECT_GT(std::abs(acceleration), 0.5);
  EXPECT_NEAR(moving, 7.0 / 12 * water_density * 4, 2e-3 * water_density * 4);
  const Real still = unit_weight * 2;
  EXPECT_NEAR(stepper.water_force(0).x(), still - moving * acceleration, 1e-9 * still);
  Real reaction = 0;
  for (const Support& support : stepper.supports().held)
    if (support.axis == 0) reaction += stepper.reactions()[number<2>(support.node, 0)];
  EXPECT_NEAR(reaction, (2000 * 2 + moving) * acceleration - still, 1e-9 * still);
}

}  // namespace
}  // namespace sazare::methods::fem
