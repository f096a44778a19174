/// Free-field sides: ground between them moves as their columns.

#include <gtest/gtest.h>

#include "sazare/cases/case_format.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/methods/mps/run/model.hpp"

namespace sazare::runs {
namespace {

using Settings = std::vector<std::string>;

cases::CaseFile ground(Settings settings = {}) {
  static const std::array formats{cases::mps_format()};
  settings.insert(settings.begin(), "particles.spacing=1");
  return cases::read_case(formats, "validation/analytic/free-field/level-ground.toml", settings);
}

/// Largest distance of a particle from its row of the column, over the largest displacement.
template <int D>
Real distance_from_column(const Settings& settings, int steps, bool breaks = false) {
  const cases::CaseFile file = ground(settings);
  const MpsModel<D> model = build_mps<D>(file);
  const auto& column = model.free_field->column(0).particles();
  model.stepper->start();
  Real worst = 0, most = 0;
  for (int step = 0; step < steps; ++step) {
    model.stepper->advance();
    const auto& particles = model.stepper->particles();
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const auto row = static_cast<std::size_t>(model.filling.sites[i][D - 1]);
      for (std::size_t axis = 0; axis < D; ++axis) {
        most = std::max(most, std::abs(column.displacement[axis][row]));
        worst = std::max(worst, std::abs(particles.displacement[axis][i] - column.displacement[axis][row]));
      }
    }
  }
  EXPECT_GT(most, 1e-6);
  EXPECT_TRUE(model.failing == nullptr || model.failing->work().flow > 0);
  EXPECT_EQ(model.failing != nullptr && model.failing->broken_links() > 0, breaks);
  return worst / most;
}

const std::string p_wave = "boundaries.0={side=\"bottom\",kind=\"viscous\",motion_y=\"wave\"}",
                  shaken = "boundaries.0={side=\"bottom\",kind=\"prescribed\",motion_x=\"wave\"}";

TEST(mps_free_field, moves_level_ground_as_its_column) {
  for (const Settings& settings :
       {Settings{}, Settings{p_wave}, Settings{shaken}, Settings{"time.integrator=euler", "time.stability_fraction=0.2"},
        Settings{"time.integrator=leapfrog", "particles.influence=2.2"}, Settings{"particles.rotation=mean_angle"}})
    EXPECT_LT(distance_from_column<2>(settings, 500), 1e-11) << (settings.empty() ? "" : settings.front());
}

TEST(mps_free_field, moves_yielding_ground_as_its_column) {
  const Settings yields{"materials.1.cohesion=3e3", "materials.1.friction_angle=0"};
  EXPECT_LT(distance_from_column<2>(yields, 500), 1e-11);
}

TEST(mps_free_field, moves_broken_ground_as_its_column) {
  const Settings weak{"materials.1.cohesion=3e3", "materials.1.friction_angle=20", "materials.1.rupture_strain=1e-4",
                      "motions.0.amplitude=1"};
  EXPECT_LT(distance_from_column<2>(weak, 300, true), 1e-11);
}

TEST(mps_free_field, moves_a_body_in_space_as_its_columns) {
  const Settings in_space{"particles.dimension=3",    "regions.0.upper=[10,9,8]", "regions.1.lower=[0,0,4]",
                          "regions.1.upper=[10,9,8]", "gauges.0.point=[1,1,7.5]", "gauges.1.point=[5,5,7.5]"};
  Settings periodic = in_space, four = in_space;
  periodic.push_back("particles.periodic=[\"y\"]");
  four.push_back(
      "boundaries=[{side=\"bottom\",kind=\"viscous\",motion_x=\"wave\",motion_y=\"wave\"},{side=\"left\",kind=\"free_field\"},"
      "{side=\"right\",kind=\"free_field\"},{side=\"front\",kind=\"free_field\"},{side=\"back\",kind=\"free_field\"}]");
  EXPECT_LT(distance_from_column<3>(periodic, 200), 1e-11);
  EXPECT_LT(distance_from_column<3>(four, 200), 1e-11);
}

/// Energy that no cause accounts for, over the largest that was there, of ground with a slope.
Real residual(const Settings& more) {
  Settings settings{
      "regions=[{name=\"soil\",shape=\"polygon\",points=[[0,0],[20,0],[20,10],[13,10],[7,5],[0,5],[0,0]]},"
      "{name=\"rock\",lower=[0,0,0],upper=[20,3,0]}]",
      "gauges.0.point=[0.5,4.5,0]", "materials.0.damping_ratio=0", "materials.1.damping_ratio=0"};
  settings.insert(settings.end(), more.begin(), more.end());
  const cases::CaseFile file = ground(settings);
  const MpsModel<2> model = build_mps<2>(file);
  auto& stepper = *model.stepper;
  stepper.start();
  Real worst = 0, most = 0;
  while (stepper.time() < 0.3) {
    stepper.advance();
    const Real carried = stepper.kinetic_energy_of_kick() + stepper.elastic_energy();
    most = std::max(most, carried);
    worst = std::max(worst, std::abs(stepper.work().sum() + model.free_field->work() - carried));
  }
  EXPECT_GT(std::abs(model.free_field->work()), 1e-3 * most);
  return worst / most;
}

TEST(mps_free_field, accounts_for_the_work_of_the_sides) {
  const Settings small{"motions.0.amplitude=1e-6"}, damped{"motions.0.amplitude=1e-6", "materials.1.damping_ratio=0.05"};
  EXPECT_LT(residual(small), 1e-7);
  EXPECT_LT(residual(damped), 1e-7);
}

}  // namespace
}  // namespace sazare::runs
