#include <cmath>
#include <numbers>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/run/model.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/temporary_folder.hpp"
#include "tests/support/element_boxes.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real unit_weight = 1000 * 9.81, caisson_mass = 2300 * 14, friction = std::numbers::inv_sqrt3;

runs::FemModel<2> caisson(std::vector<std::string> settings = {}) {
  const auto file = registry::read_case("validation/analytic/water-on-faces/case.toml", settings);
  const runs::TemporaryFolder folder;
  return runs::build_fem<2>(file, runs::load_fem_mesh(file, folder.path() / "mesh.msh", false));
}

/// Moment of the forces of a water about the seaward foot, clockwise: what turns the caisson landwards [N m/m].
Real moment(const runs::FemModel<2>& model, std::size_t number) {
  const auto& force = model.stepper->supports().waters[number].pressure.force;
  Real sum = 0;
  for (std::size_t node = 0; node < model.mesh().nodes.size(); ++node) {
    const Vector3 arm = model.mesh().nodes[node] - Vector3(4, 0, 0);
    sum += arm.y() * force[2 * node] - arm.x() * force[2 * node + 1];
  }
  return sum;
}

void compare_pressures() {
  const auto model = caisson();
  const auto& waters = model.stepper->supports().waters;
  const Real sea = 3.3, land = 1.3;
  validation::print_row("wall-force", waters[0].force.x(), unit_weight * sea * sea / 2);
  validation::print_row("wall-moment", moment(model, 0), unit_weight * sea * sea * sea / 6);
  // The landward side leans by 1 in 4: p acts on dy along x and, downwards, on dy/4 along y.
  validation::print_row("leaning-force", -waters[1].force.x(), unit_weight * land * land / 2);
  validation::print_row("leaning-weight", -waters[1].force.y(), 0.25 * unit_weight * land * land / 2);
  const Real first = land * land / 2, second = land * land * land / 6;  // of the depth, and of the depth times y
  validation::print_row("leaning-moment", moment(model, 1), unit_weight * (-second + 0.25 * (4 * first - 0.25 * second)));
  validation::print_row("uplift", waters[2].force.y(), unit_weight * 4 * (sea + land) / 2);
}

void compare_effective_weight() {
  auto model = caisson();
  model.stepper->relax();
  const auto& state = model.stepper->state();
  const auto found = model.stepper->body().joints().summary(0, state.displacement, state.memory.joints);
  const Real land = 0.25 * unit_weight * 1.3 * 1.3 / 2;
  validation::print_row("effective-weight", -found.force.y(), caisson_mass * 9.81 + land - unit_weight * 4 * 2.3);
}

constexpr Real light = 900;  ///< density of a caisson that slides before the sea reaches its top [kg/m3]

/// Whether the light caisson stands with the sea at a level, nothing landwards, and uplift that falls to 0 there.
bool stands(Real level, bool uplift) {
  const std::string text = std::to_string(level);
  auto model = caisson({"water_pressures.0.level=" + text, "water_pressures.1.level=0",
                        "water_pressures.2.level=" + (uplift ? text : "0"), "water_pressures.2.far_level=0", "solver.max_cuts=3",
                        "materials.1.density=" + std::to_string(light)});
  try {
    model.stepper->relax();
    return true;
  } catch (const PhysicsError&) {
    return false;
  }
}

/// The level h at which friction is used up: h^2/2 = tan(30 deg) (W - 2 h) over the unit weight of water.
void compare_sliding(bool uplift, const char* row) {
  const Real weight = light * 14 / 1000, half_base = uplift ? 2 * friction : 0;
  const Real exact = -half_base + std::sqrt(half_base * half_base + 2 * friction * weight);
  Real low = 1, high = 4;
  while (high - low > 2e-3) (stands(0.5 * (low + high), uplift) ? low : high) = 0.5 * (low + high);
  validation::print_row(row, 0.5 * (low + high), exact);
}

constexpr Real wall_density = 2400, layer_stiffness = 1e7, depth = 1.5;

/// A stiff wall, 1 m wide and 2 m high, on a layer without mass; it moves along x only, with water of this depth on one side.
methods::fem::FemStepper<2> wall(int cells, bool with_water) {
  namespace fem = methods::fem;
  auto mesh = test::box(geometry::ElementShape::quadrilateral4, {{1, 3, 0}, {1, cells, 1}, 0});
  auto description = test::of_one_material(mesh, fem::SolidMaterial::elastic_of(1e12, 0, wall_density));
  description.materials.push_back(fem::SolidMaterial::elastic_of(2 * layer_stiffness, 0, 1e-6));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.nodes[at(mesh.elements[e].nodes[0])].y() < 0.99) description.material[e] = 1;
  fem::Supports<2> supports;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), 1, fem::Support::no_motion, 0});
  test::hold<2>(mesh, "bottom", 0, supports);
  supports.gravity.x() = 1;
  const laws::WaterPressure pressure{unit_weight, 1, 1 + depth};
  fem::StillWater<2> water;
  water.pressure.force.resize(mesh.nodes.size() * 2, 0);
  for (const auto& face : mesh.find_group("left")->elements)
    if (mesh.nodes[at(face.nodes[0])].y() + mesh.nodes[at(face.nodes[1])].y() > 2)
      water.moving.push_back({{face.node_list().begin(), face.node_list().end()},
                              fem::added_mass<2>(mesh, face, pressure, 1000, depth, fem::MassMatrix::consistent)});
  if (with_water) supports.waters = {water};
  fem::FemRules rules;
  rules.step = 2.5e-4;
  return {std::make_unique<fem::Body<2>>(std::move(description)), std::move(supports), rules};
}

/// From the times at which the velocity of the top changes its sign [s].
Real period(int cells, bool with_water) {
  auto stepper = wall(cells, with_water);
  stepper.start();
  const auto top = static_cast<std::size_t>(test::node_at(stepper.body().mesh(), {0, 3, 0})) * 2;
  Real before = 0, first = 0, last = 0;
  int changes = 0;
  while (changes < 41) {
    stepper.advance();
    const Real now = stepper.state().velocity[top];
    if (before * now < 0) {
      last = stepper.time() - stepper.rules().step * now / (now - before);
      if (++changes == 1) first = last;
    }
    before = now;
  }
  return (last - first) / 20;
}

void compare_periods() {
  const auto exact = [](Real mass) { return 2 * std::numbers::pi * std::sqrt(mass / layer_stiffness); };
  const Real dry = 2 * wall_density, added = 7.0 / 12 * 1000 * depth * depth;
  validation::print_row("period-dry", period(24, false), exact(dry));
  validation::print_row("period-wet", period(24, true), exact(dry + added));
  const auto error = [&](int cells) { return std::abs(wall(cells, true).supports().waters[0].moving_mass() - added); };
  validation::print_row("added-mass-order", std::log2(error(24) / error(48)));
}

}  // namespace

int main() {
  compare_pressures();
  compare_effective_weight();
  compare_sliding(true, "sliding-with-uplift");
  compare_sliding(false, "sliding-without-uplift");
  compare_periods();
}
