#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sazare/geometry/element_order.hpp"
#include "sazare/geometry/gmsh/mesher.hpp"
#include "sazare/geometry/gmsh/reader.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/common/body_modes.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using std::numbers::pi;

constexpr Real young = 50e9, density = 2700;

geometry::TetraMesh box(const std::vector<std::pair<std::string, Real>>& parameters) {
  const auto made = std::filesystem::temp_directory_path() / "sazare-elastic-blocks.msh";
  geometry::mesh_geometry({"validation/analytic/elastic-blocks/box.geo", made, parameters});
  geometry::TetraMesh mesh = geometry::read_gmsh(made, 1);
  std::filesystem::remove(made);
  geometry::sort_along_curve(mesh);
  return mesh;
}

/// Rock of rigid elements, whose joints are elastic, or of deformable ones.
struct Rock {
  Real poisson = 0;
  bool deformable = false;

  /// Of a row.
  std::string name(const std::string& quantity) const {
    return (deformable ? "deformable-" : "") + quantity + "-" + fmt::format("{}", poisson);
  }
};

/// A case of rock that cannot break.
cases::BlocksCase rock(const Rock& rock, bool slides_on_its_sides) {
  cases::BlocksCase blocks;
  blocks.materials = {{"rock", {"body"}, density, young, rock.poisson, rock.deformable}};
  cases::Joint joint;
  joint.name = "rock";
  joint.between = {"rock", "rock"};
  joint.cohesion = joint.tensile_strength = 1e12;
  joint.fracture_energy = 1e15;
  blocks.joints = {joint};
  if (slides_on_its_sides) blocks.boundaries = {{"sides", cases::BoundaryKind::frictionless}};
  blocks.contact.normal_stiffness = 1e9;
  blocks.time.history_interval = 1e-6;
  return blocks;
}

struct Body {
  cases::BlocksCase blocks;
  const geometry::TetraMesh& mesh;

  Real half_period(const validation::Mode& mode) const {
    const auto model = runs::build_blocks(blocks, mesh);
    return validation::half_period(*model.simulation, mode);
  }
};

/// Prints the wave velocities of a cube of 1 m: those of plane waves between sides that slide, and that of Lame's mode, which is
/// pure shear and leaves all sides of a free cube without stress.
void print_speeds(const geometry::TetraMesh& mesh, const Rock& of) {
  const laws::ElasticModuli rock_moduli{young, of.poisson};
  const Real p = 1 / Body{rock(of, true), mesh}.half_period([](const Vector3& at) {
    return std::pair(Vector3(std::cos(pi * at.x()), 0, 0), Vector3(Vector3::Zero()));
  });
  const Real s = 1 / std::numbers::sqrt2 / Body{rock(of, false), mesh}.half_period([](const Vector3& at) {
    const Real x = pi * at.x(), y = pi * (at.y() + 0.5);
    return std::pair(Vector3(std::cos(x) * std::sin(y), -std::sin(x) * std::cos(y), 0),
                     Vector3(0, 0, -pi * std::cos(x) * std::cos(y)));
  });
  validation::print_row(of.name("p-wave").c_str(), p, std::sqrt(rock_moduli.confined() / density));
  validation::print_row(of.name("s-wave").c_str(), s, std::sqrt(rock_moduli.shear() / density));
}

/// Young's modulus from the first free mode along a bar, with Rayleigh's correction for its inertia across.
void print_bar(const geometry::TetraMesh& mesh, Real length, Real width, const Rock& of) {
  const Real poisson = of.poisson;
  const Real wave_number = pi / length;
  const Real half_period = Body{rock(of, false), mesh}.half_period([&](const Vector3& at) {
    const Real across = poisson * wave_number * std::sin(wave_number * at.x());
    return std::pair(Vector3(std::cos(wave_number * at.x()), across * at.y(), across * at.z()), Vector3(Vector3::Zero()));
  });
  const Real slowed = 1 - std::pow(poisson * wave_number, 2) * (width * width / 6) / 2;
  validation::print_row(of.name("young").c_str(), density * std::pow(length / half_period / slowed, 2), young);
}

/// Share of the energy of a pulse that is left in a box when it has had time to leave by absorbing ends.
void print_left_behind(const geometry::TetraMesh& mesh, Real length, bool deformable) {
  auto blocks = rock({0.25, deformable}, true);
  blocks.boundaries.push_back({"ends", cases::BoundaryKind::absorbing});
  const auto model = runs::build_blocks(blocks, mesh);
  auto& simulation = *model.simulation;
  validation::set_motion(simulation, [&](const Vector3& at) {
    const Real from_middle = at.x() / length - 0.5;
    const Real speed = std::abs(from_middle) < 0.25 ? 1 + std::cos(4 * pi * from_middle) : 0;
    return std::pair(Vector3(speed, 0, 0), Vector3(Vector3::Zero()));
  });
  const Real end = 1.5 * length / std::sqrt(laws::ElasticModuli{young, 0.25}.confined() / density);
  simulation.start();
  const Real before = simulation.energy_balance()[terms::EnergyKind::kinetic];  // of the motion that was set
  while (simulation.now().seconds() < end) simulation.advance();
  const auto balance = simulation.energy_balance();
  validation::print_row(deformable ? "deformable-left-behind" : "left-behind",
                        (balance[terms::EnergyKind::kinetic] + balance[terms::EnergyKind::elastic]) / before);
}

}  // namespace

int main() {
  parallel::set_threads(1);
  const auto cube = box({{"fine", 0.04}, {"ratio", 8.0}});
  const auto half = box({{"length", 2.0}, {"width", 0.5}, {"fine", 0.05}, {"ratio", 2.0}});
  const auto bar = box({{"length", 2.0}, {"width", 0.3}, {"fine", 0.06}, {"ratio", 1.0}});
  for (const bool deformable : {false, true}) {
    for (const Real poisson : {0.1, 0.25, 0.4}) print_speeds(cube, {poisson, deformable});
    print_left_behind(half, 2, deformable);
    for (const Real poisson : {0.1, 0.25, 0.4}) print_bar(bar, 2, 0.3, {poisson, deformable});
  }
}
