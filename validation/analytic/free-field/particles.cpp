#include "validation/analytic/free-field/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sazare/cases/case_format.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/methods/mps/run/model.hpp"
#include "sazare/methods/mps/run/settle.hpp"
#include "sazare/runs/run_options.hpp"
#include "validation/common/rows.hpp"

namespace sazare::validation {

namespace {

using Settings = std::vector<std::string>;

constexpr Real width = 20, height = 10, soil_height = 5, end = 0.5, wave_peak = 0.1;

cases::CaseFile ground(const Settings& settings) {
  static const std::array formats{cases::mps_format()};
  return cases::read_case(formats, "validation/analytic/free-field/level-ground.toml", settings);
}

const Settings undamped{"materials.0.damping_ratio=0", "materials.1.damping_ratio=0"};
const Settings rock_alone{"materials.0.damping_ratio=0", "materials.1.damping_ratio=0", "materials.1.density=2200",
                          "materials.1.s_wave_velocity=200", "materials.1.p_wave_velocity=400"};

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// Largest distance of a particle from its row of the column, over the largest displacement.
template <int D>
Real beside_column(const Settings& settings) {
  const cases::CaseFile file = ground(settings);
  const runs::MpsModel<D> model = runs::build_mps<D>(file);
  const auto &particles = model.stepper->particles(), &column = model.free_field->column(0).particles();
  model.stepper->start();
  Real worst = 0, most = 0;
  while (model.stepper->time() < end) {
    model.stepper->advance();
    for (std::size_t i = 0; i < particles.size(); ++i)
      for (std::size_t axis = 0; axis < D; ++axis) {
        const Real right = column.displacement[axis][static_cast<std::size_t>(model.filling.sites[i][D - 1])];
        most = std::max(most, std::abs(right));
        worst = std::max(worst, std::abs(particles.displacement[axis][i] - right));
      }
  }
  return worst / most;
}

/// The exact velocity of the surface of soil on rock: waves that go up and down in the soil. The base lies in the centres of the
/// lowest particles.
Real exact(const laws::GroundMotion& wave, Real spacing, Real time) {
  const Real above = 1800 * 100, below = 2200 * 200, back = (above - below) / (above + below);
  Real sum = 0, factor = 4 * below / (below + above);
  for (Real delay = (height - soil_height - 0.5 * spacing) / 200 + soil_height / 100; delay < time + 1;
       delay += 2 * soil_height / 100, factor *= back)
    sum += factor * wave.at(time - delay).velocity;
  return sum;
}

/// Largest error of the velocity of any particle of the surface, over the peak of the incoming wave.
Real surface_error(const Settings& settings) {
  const cases::CaseFile file = ground(with(undamped, settings));
  const runs::MpsModel<2> model = runs::build_mps<2>(file);
  const Real spacing = model.filling.spacing;
  model.stepper->start();
  Real worst = 0;
  while (model.stepper->time() < end) {
    model.stepper->advance();
    const auto velocity = model.stepper->velocity();
    // A surface lies half a spacing above its particles, whose motion differs by the square of the spacing.
    const Real right = exact(model.stepper->supports().motions[0], spacing, model.stepper->time());
    for (std::size_t i = 0; i < model.filling.sites.size(); ++i)
      if (model.filling.place(i).y() > height - spacing) worst = std::max(worst, std::abs(velocity[0][i] - right));
  }
  return worst / wave_peak;
}

const std::string slope =
    "regions=[{name=\"soil\",shape=\"polygon\",points=[[0,0],[20,0],[20,10],[13,10],[7,5],[0,5],[0,0]]},"
    "{name=\"rock\",lower=[0,0,0],upper=[20,3,0]}]";
const Settings of_slope{slope, "gauges.0.point=[0.25,4.75,0]"};

/// Energy that is found nowhere, over what waves and sides do.
Real residual() {
  const cases::CaseFile file = ground(with(with(undamped, of_slope), {"motions.0.amplitude=1e-6"}));
  const runs::MpsModel<2> model = runs::build_mps<2>(file);
  model.stepper->start();
  Real worst = 0, most = 0;
  while (model.stepper->time() < end) {
    model.stepper->advance();
    const Real work = model.stepper->work().sum() + model.free_field->work();
    const Real carried = model.stepper->kinetic_energy_of_kick() + model.stepper->elastic_energy();
    most = std::max(most, carried);
    worst = std::max(worst, std::abs(work - carried));
  }
  return worst / most;
}

/// Largest acceleration of ground that has settled, over gravity.
Real unrest() {
  const cases::CaseFile file =
      ground(with(of_slope, {"gravity.acceleration=[0,-9.81,0]", "gravity.settle=true", "motions.0.amplitude=0"}));
  runs::MpsModel<2> model = runs::build_mps<2>(file);
  runs::RunOptions options;
  options.quiet = true;
  runs::settle<2>(file.as<cases::MpsCase>(), model, options);
  model.stepper->start();
  Real worst = 0;
  while (model.stepper->time() < 0.1) {
    model.stepper->advance();
    for (std::size_t axis = 0; axis < 2; ++axis)
      for (const Real one : model.stepper->acceleration()[axis]) worst = std::max(worst, std::abs(one) / 9.81);
  }
  return worst;
}

/// A plane wave that leaves through the sides: what comes back to its source over what left it.
Real plane_wave_returned(std::size_t axis) {
  const cases::CaseFile file =
      ground(with(rock_alone, {"particles.periodic=[\"y\"]",
                               "boundaries=[{side=\"left\",kind=\"free_field\"},{side=\"right\",kind=\"free_field\"}]",
                               "regions.0.upper=[60,2,0]", "regions.1.lower=[0,1,0]", "regions.1.upper=[60,2,0]", "gauges=[]"}));
  const runs::MpsModel<2> model = runs::build_mps<2>(file);
  const auto& sites = model.filling.sites;
  const laws::GroundMotion wave = model.stepper->supports().motions[0];
  const auto middle =
      static_cast<std::size_t>(std::ranges::find_if(sites, [](const auto& site) { return site[0] == 60; }) - sites.begin());
  const Real velocity = axis == 0 ? 400 : 200, passed = 0.2 + 4 / velocity;
  std::vector<Vector3> push(sites.size(), Vector3::Zero());
  model.stepper->start();
  Real left = 0, returned = 0;
  while (model.stepper->time() < 0.2 + 70 / velocity) {
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (sites[i][0] == 60) push[i][static_cast<Eigen::Index>(axis)] = 1e6 * wave.at(model.stepper->time()).velocity;
    model.stepper->apply(push);
    model.stepper->advance();
    const Real speed = std::abs(model.stepper->velocity()[axis][middle]);
    Real& part = model.stepper->time() < passed ? left : returned;
    part = std::max(part, speed);
  }
  return returned / left;
}

/// Velocities of the particle in the middle of a load that grows on 5 m of the surface and stays.
std::vector<Vector<2>> under_load(Real reach) {
  const cases::CaseFile file =
      ground(with(rock_alone, {fmt::format("regions.0.upper=[{},10,0]", reach), fmt::format("regions.1.upper=[{},10,0]", reach),
                               "motions.0.amplitude=0", "time.step=5e-4"}));
  const runs::MpsModel<2> model = runs::build_mps<2>(file);
  const Real spacing = model.filling.spacing;
  std::vector<Vector3> push(model.filling.sites.size(), Vector3::Zero());
  std::size_t middle = 0;
  std::vector<Vector<2>> found;
  model.stepper->start();
  while (model.stepper->time() < 0.3) {
    const Real share = std::min(model.stepper->time() / 0.05, 1.0);
    for (std::size_t i = 0; i < push.size(); ++i) {
      const Vector<2> place = model.filling.place(i);
      if (place.y() < height - spacing || std::abs(place.x() - 0.5 * reach) > 2.5) continue;
      push[i] = share * 1e4 * spacing * Vector3(0.5, -1, 0);
      if (std::abs(place.x() - 0.5 * reach - 0.5 * spacing) < 0.1 * spacing) middle = i;
    }
    model.stepper->apply(push);
    model.stepper->advance();
    const auto velocity = model.stepper->velocity();
    found.emplace_back(velocity[0][middle], velocity[1][middle]);
  }
  return found;
}

Real load_returned() {
  const auto near = under_load(width), far = under_load(5 * width);
  Real largest = 0, returned = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    largest = std::max(largest, far[i].cwiseAbs().maxCoeff());
    returned = std::max(returned, (near[i] - far[i]).cwiseAbs().maxCoeff());
  }
  return returned / largest;
}

}  // namespace

void print_rows_of_particles() {
  const Settings in_space{"particles.dimension=3",
                          "particles.spacing=1",
                          "regions.0.upper=[10,10,8]",
                          "regions.1.lower=[0,0,4]",
                          "regions.1.upper=[10,10,8]",
                          "gauges=[]",
                          "boundaries=[{side=\"bottom\",kind=\"viscous\",motion_x=\"wave\",motion_y=\"wave\"},"
                          "{side=\"left\",kind=\"free_field\"},{side=\"right\",kind=\"free_field\"},"
                          "{side=\"front\",kind=\"free_field\"},{side=\"back\",kind=\"free_field\"}]"};
  print_row("mps-beside-column", beside_column<2>({}));
  print_row("mps-yielding", beside_column<2>({"materials.1.cohesion=3e3", "materials.1.friction_angle=0"}));
  print_row("mps-broken", beside_column<2>({"materials.1.cohesion=3e3", "materials.1.friction_angle=20",
                                            "materials.1.rupture_strain=1e-4", "motions.0.amplitude=1"}));
  print_row("mps-in-space", beside_column<3>(in_space));
  print_row("mps-soil-on-rock", surface_error({"particles.spacing=0.1", "motions.0.frequency=5", "motions.0.peak_time=0.2"}));
  print_row("mps-viscous-sides", surface_error({"boundaries.1.kind=viscous", "boundaries.2.kind=viscous"}));
  print_row("mps-energy-balance", residual());
  print_row("mps-at-rest", unrest());
  print_row("mps-s-wave-returned", plane_wave_returned(1));
  print_row("mps-p-wave-returned", plane_wave_returned(0));
  print_row("mps-load-returned", load_returned());
}

}  // namespace sazare::validation
