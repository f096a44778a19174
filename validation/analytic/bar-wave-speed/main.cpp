#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/analytic/bar-wave-speed/bar.hpp"
#include "validation/analytic/bar-wave-speed/statics.hpp"
#include "validation/common/body_modes.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Largest strains along and across a bar whose blocks moved as u_x = a cos(k x), u_y = b y sin(k x): by least squares.
struct Strains {
  Real along = 0;
  Real across = 0;
};

Strains fitted_strains(const levels::Simulation<3>& simulation, const levels::Snapshot<3>& at) {
  constexpr Real wave_number = std::numbers::pi / validation::bar_length;
  Real moved_along = 0, all_along = 0, moved_across = 0, all_across = 0;
  for (std::size_t body = 0; body < at.pose.size(); ++body) {
    const Vector3& start = simulation.bodies().start[body];
    const Vector3 moved = at.pose[body].position - start;
    const Real along = std::cos(wave_number * start.x()), across = start.y() * std::sin(wave_number * start.x());
    moved_along += moved.x() * along;
    all_along += along * along;
    moved_across += moved.y() * across;
    all_across += across * across;
  }
  return {-wave_number * moved_along / all_along, moved_across / all_across};
}

struct StandingWave {
  Real speed = 0;        ///< from the period: length / half a period [m/s]
  Real contraction = 0;  ///< strain across over strain along, fitted over all periods
};

/// The first free mode of the bar.
StandingWave standing_wave(const geometry::TetraMesh& mesh, validation::Sides sides, const validation::Mode& mode) {
  auto model = runs::build_blocks(validation::bar_case(sides), mesh);
  Real both = 0, along = 0;
  const Real half_period = validation::half_period(*model.simulation, mode, [&](const levels::Snapshot<3>& at) {
    const Strains strains = fitted_strains(*model.simulation, at);
    both += strains.along * strains.across;
    along += strains.along * strains.along;
  });
  return {validation::bar_length / half_period, -both / along};
}

Real shape(Real x) { return std::cos(std::numbers::pi * x / validation::bar_length); }

std::pair<Vector3, Vector3> along_the_bar(const Vector3& centre) { return {Vector3(shape(centre.x()), 0, 0), Vector3::Zero()}; }

std::pair<Vector3, Vector3> around_the_bar(const Vector3& centre) {
  return {shape(centre.x()) * Vector3::UnitX().cross(centre), Vector3(shape(centre.x()), 0, 0)};
}

}  // namespace

int main() {
  using validation::Sides;
  parallel::set_threads(1);
  const auto mesh = validation::bar_mesh();
  constexpr Real density = 2390, width = validation::bar_width;
  constexpr Real area = width * width, polar = width * width * width * width / 6;

  const auto free = validation::static_moduli(mesh, {450e9, 90e9}, Sides::free);
  const auto stretched = standing_wave(mesh, Sides::free, along_the_bar);
  const Real wave_number = std::numbers::pi / validation::bar_length;
  const Real slowed = 1 - std::pow(free.poisson * wave_number, 2) * polar / area / 2;  // Rayleigh
  validation::print_row("young", density * stretched.speed * stretched.speed / (slowed * slowed), free.axial / area);
  validation::print_row("poisson", stretched.contraction, free.poisson);
  validation::print_row("bar-wave", stretched.speed, slowed * std::sqrt(free.axial / area / density));

  const auto confined = validation::static_moduli(mesh, {450e9, 90e9}, Sides::confined);
  const auto squeezed = standing_wave(mesh, Sides::confined, along_the_bar);
  validation::print_row("p-wave", squeezed.speed, std::sqrt(confined.axial / area / density));

  const auto twisted = standing_wave(mesh, Sides::free, around_the_bar);
  validation::print_row("s-wave", twisted.speed, std::sqrt(free.torsion / (density * polar)));
}
