#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/analytic/bar-wave-speed/bar.hpp"
#include "validation/analytic/bar-wave-speed/statics.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// A checkpoint in which the motion of the bodies is set.
class SetMotion final : public Archive {
public:
  explicit SetMotion(levels::Simulation<3>& simulation) : simulation_(simulation) { simulation.columns(*this); }

  void set(std::vector<state::Motion<3>> motion) {
    reading_ = true;
    const auto bytes = std::as_bytes(std::span(motion));
    columns_["motion"].assign(bytes.begin(), bytes.end());
    simulation_.columns(*this);
  }
  bool reading() const override { return reading_; }

protected:
  void write(const std::string& name, std::span<const std::byte> bytes) override {
    columns_[name].assign(bytes.begin(), bytes.end());
  }
  std::vector<std::byte> read(const std::string& name) override { return columns_.at(name); }

private:
  levels::Simulation<3>& simulation_;
  std::map<std::string, std::vector<std::byte>> columns_;
  bool reading_ = false;
};

/// Velocity and spin of a block in a mode of the bar.
using Mode = std::function<std::pair<Vector3, Vector3>(const Vector3& centre)>;

/// Gives all blocks the motion of a mode.
void set_motion(levels::Simulation<3>& simulation, const Mode& mode) {
  SetMotion start(simulation);
  auto motion = simulation.bodies().motion;
  for (std::size_t body = 0; body < motion.size(); ++body) {
    const auto [velocity, spin] = mode(motion[body].position);
    const Vector3 moments = simulation.bodies().inertia[body].inverse_moments.cwiseInverse();
    motion[body].velocity = 1e-3 * velocity;
    motion[body].spin = 1e-3 * spin;
    const Matrix3 rotation = motion[body].rotation;
    motion[body].angular_momentum = rotation * moments.asDiagonal() * rotation.transpose() * motion[body].spin;
  }
  start.set(motion);
}

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

constexpr std::size_t half_periods = 4;

/// The first free mode of the bar. Its period is read from the times at which the motion has no component left in the mode.
StandingWave standing_wave(const geometry::TetraMesh& mesh, validation::Sides sides, const Mode& mode) {
  auto model = runs::build_blocks(validation::bar_case(sides), mesh);
  auto& simulation = *model.simulation;
  set_motion(simulation, mode);
  const auto component = [&](const levels::Snapshot<3>& at) {
    Real sum = 0;
    for (std::size_t body = 0; body < at.velocity.size(); ++body)
      sum += simulation.bodies().inertia[body].mass * at.velocity[body].dot(mode(simulation.bodies().start[body]).first);
    return sum;
  };
  simulation.start();
  std::vector<Real> crossings;
  Real before = component(simulation.snapshot()), both = 0, along = 0;
  while (crossings.size() <= half_periods && simulation.now().seconds() < 0.1) {
    simulation.advance();
    const auto at = simulation.snapshot();
    const Real now = component(at);
    const Real since_crossing = simulation.levels().step(0) * now / (now - before);
    if (before * now < 0) crossings.push_back(simulation.now().seconds() - since_crossing);
    before = now;
    const Strains strains = fitted_strains(simulation, at);
    both += strains.along * strains.across;
    along += strains.along * strains.along;
  }
  const Real half_period = (crossings.at(half_periods) - crossings.at(0)) / half_periods;
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
