#include <algorithm>
#include <cmath>
#include <set>

#include "sazare/geometry/interface_split.hpp"
#include "sazare/methods/fem/soil_column.hpp"
#include "tests/support/element_boxes.hpp"
#include "validation/analytic/free-field/particles.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using namespace sazare::methods::fem;
using geometry::ElementMesh;
using Shape = geometry::ElementShape;

constexpr Real width = 20, height = 10, end = 0.5, wave_frequency = 10, wave_peak = 0.1;
constexpr Real rock_density = 2200, rock_velocity = 200, soil_density = 1800, soil_velocity = 100, soil_height = 5;

SolidMaterial ground(Real density, Real velocity) {
  SolidMaterial material;
  material.density = density;
  material.elastic = {density * velocity * velocity, 2 * density * velocity * velocity};
  return material;
}

laws::GroundMotion wave() {
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::velocity;
  motion.ricker_wave = {wave_frequency, wave_peak};
  return motion;
}

enum class Base { viscous, rigid };

struct Scene {
  bool layered = false;  ///< soil on rock; otherwise rock
  Base base = Base::viscous;
  int axis = 0;        ///< along which the wave moves; none where below 0
  Real gravity = 0;    ///< [m/s2]
  Real hill = 0;       ///< of the right side above the left one [m]
  Real blow = 0;       ///< on the surface [Pa]
  bool columns = true; ///< otherwise viscous sides
  Real reach = width;  ///< [m]
};

template <int D>
BodyDescription body_of(const Scene& scene) {
  BodyDescription body;
  const int across = static_cast<int>(scene.reach / 2.5), up = static_cast<int>(height / 0.25);
  if constexpr (D == 2)
    body.mesh = test::box(Shape::quadrilateral8, {{scene.reach, height, 1}, {across, up, 1}, 0});
  else
    body.mesh = test::box(Shape::hexahedron20, {{10, 5, height}, {2, 1, up}, 0});
  body.materials = {ground(rock_density, rock_velocity), ground(soil_density, soil_velocity)};
  for (const auto& element : body.mesh.elements) {
    Real lowest = height;
    for (const Index node : element.node_list()) lowest = std::min(lowest, body.mesh.nodes[at(node)][D - 1]);
    body.material.push_back(scene.layered && lowest > height - soil_height - 1e-6 ? 1 : 0);
  }
  for (Vector3& node : body.mesh.nodes)
    node[D - 1] *= 1 + scene.hill / height * std::clamp(2 * node.x() / scene.reach - 0.5, 0.0, 1.0);
  return body;
}

template <int D>
ViscousBoundary<D> viscous(const BodyDescription& body, const std::string& name) {
  ViscousBoundary<D> made;
  made.motion.fill(Support::no_motion);
  const auto& group = *body.mesh.find_group(name);
  const auto beside = geometry::elements_beside(body.mesh, group);
  std::set<Index> nodes;
  for (std::size_t i = 0; i < group.elements.size(); ++i) {
    made.faces.push_back(viscous_face<D>(body, beside[i], group.elements[i]));
    nodes.insert(made.faces.back().nodes.begin(), made.faces.back().nodes.end());
  }
  made.nodes.assign(nodes.begin(), nodes.end());
  return made;
}

/// Loads the middle tenth of the surface.
NodalColumn blow(const ElementMesh& mesh, const Scene& scene) {
  ElementMesh part = mesh;
  for (auto& group : part.groups)
    if (group.name == "top")
      std::erase_if(group.elements, [&](const auto& face) {
        Real middle = 0;
        for (const Index node : face.node_list()) middle += mesh.nodes[at(node)].x() / static_cast<Real>(face.node_list().size());
        return std::abs(middle - scene.reach / 2) > 2.6;
      });
  return test::traction(part, "top", {0.5 * scene.blow, -scene.blow, 0});
}

template <int D>
FemStepper<D> make(const Scene& scene) {
  BodyDescription body = body_of<D>(scene);
  Supports<D> supports;
  supports.gravity[D - 1] = -scene.gravity;
  supports.motions = {wave()};
  if (scene.base == Base::viscous) {
    supports.viscous = {viscous<D>(body, "bottom")};
    if (scene.axis >= 0) supports.viscous[0].motion[static_cast<std::size_t>(scene.axis)] = 0;
  } else {
    for (int axis = 0; axis < D; ++axis)
      test::hold<D>(body.mesh, "bottom", axis, supports, axis == scene.axis ? 0 : Support::no_motion);
  }
  std::vector<std::string> names{"left", "right"};
  if constexpr (D == 3) names.insert(names.end(), {"front", "back"});
  for (const std::string& name : names) {
    if (!scene.columns) supports.viscous.push_back(viscous<D>(body, name));
    if (!scene.columns) continue;
    for (auto& side : free_field_sides<D>(body, *body.mesh.find_group(name), 0)) {
      stand_on_base(side, supports);
      if (scene.base == Base::viscous)
        std::erase_if(side.nodes, [&](Index node) { return std::ranges::count(supports.viscous[0].nodes, node) > 0; });
      supports.sides.push_back(std::move(side));
    }
  }
  if constexpr (D == 2)
    if (scene.blow > 0) supports.loads = {{"blow", blow(body.mesh, scene), 0.05}};
  FemRules rules;
  rules.step = 5e-4;
  rules.tolerance = 1e-11;
  return FemStepper<D>(std::make_unique<Body<D>>(std::move(body)), std::move(supports), rules);
}

/// The exact velocity of the surface: waves that go up and down between the surface and what reflects them [-].
Real exact(const Scene& scene, Real time) {
  const bool p_wave = scene.axis == 1;
  const auto speed = [&](Real velocity) { return p_wave ? 2 * velocity : velocity; };
  if (scene.base == Base::viscous && !scene.layered) return 2 * wave().at(time - height / speed(rock_velocity)).velocity;
  Real sum = 0, factor = 2;
  Real delay = height / speed(rock_velocity), again = 2 * delay, back = -1;
  if (scene.layered) {
    const Real above = soil_density * speed(soil_velocity), below = rock_density * speed(rock_velocity);
    factor = 2 * 2 * below / (below + above);
    delay = (height - soil_height) / speed(rock_velocity) + soil_height / speed(soil_velocity);
    again = 2 * soil_height / speed(soil_velocity);
    back = (above - below) / (above + below);
  }
  for (; delay < time + 1; delay += again, factor *= back) sum += factor * wave().at(time - delay).velocity;
  return sum;
}

/// Largest error of the velocity of any node of the surface, over the peak of the incoming wave.
template <int D>
Real surface_error(const Scene& scene) {
  auto stepper = make<D>(scene);
  stepper.start();
  Real worst = 0;
  const auto& nodes = stepper.body().mesh().nodes;
  while (stepper.time() < end) {
    stepper.advance();
    const Real right = exact(scene, stepper.time());
    for (std::size_t node = 0; node < nodes.size(); ++node)
      if (nodes[node][D - 1] > height - 1e-6)
        for (int axis = 0; axis < D; ++axis) {
          const Real own = stepper.state().velocity[node * D + static_cast<std::size_t>(axis)];
          worst = std::max(worst, std::abs(own - (axis == scene.axis ? right : 0)));
        }
  }
  return worst;
}

/// Energy that is found nowhere, over what the columns and waves do.
Real residual() {
  auto stepper = make<2>({.layered = true, .hill = 5});
  stepper.start();
  while (stepper.time() < end) stepper.advance();
  return std::abs(stepper.energy_residual()) / (stepper.work().waves + std::abs(stepper.work().sides));
}

/// Largest acceleration of ground at rest, over gravity.
Real unrest() {
  auto stepper = make<2>({.layered = true, .axis = -1, .gravity = 9.81, .hill = 5});
  stepper.relax();
  stepper.start();
  Real worst = 0;
  for (int step = 0; step < 200; ++step) {
    stepper.advance();
    for (const Real one : stepper.state().acceleration) worst = std::max(worst, std::abs(one) / 9.81);
  }
  return worst;
}

struct Blow {
  Real difference = 0;  ///< between columns and viscous sides, largest velocity of any node over the largest
  Real returned = 0;    ///< by the sides: largest difference at the load to ground three times as wide, over the largest
};

Blow blow_on_surface() {
  const Scene scene{.axis = -1, .blow = 1e4}, plain{.axis = -1, .blow = 1e4, .columns = false},
      wide{.axis = -1, .blow = 1e4, .reach = 5 * width};
  auto one = make<2>(scene), other = make<2>(plain), far = make<2>(wide);
  for (auto* stepper : {&one, &other, &far}) stepper->start();
  const auto middle = static_cast<std::size_t>(test::node_at(one.body().mesh(), {width / 2, height, 0})) * 2;
  const auto far_middle = static_cast<std::size_t>(test::node_at(far.body().mesh(), {2.5 * width, height, 0})) * 2;
  Blow found;
  Real largest = 0, at_load = 0;
  while (one.time() < 0.3) {
    for (auto* stepper : {&one, &other, &far}) stepper->advance();
    for (std::size_t i = 0; i < one.state().velocity.size(); ++i) {
      largest = std::max(largest, std::abs(one.state().velocity[i]));
      found.difference = std::max(found.difference, std::abs(one.state().velocity[i] - other.state().velocity[i]));
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      at_load = std::max(at_load, std::abs(far.state().velocity[far_middle + axis]));
      found.returned = std::max(
          found.returned, std::abs(one.state().velocity[middle + axis] - far.state().velocity[far_middle + axis]));
    }
  }
  return {found.difference / largest, found.returned / at_load};
}

}  // namespace

int main() {
  validation::print_row("s-wave", surface_error<2>({}));
  validation::print_row("p-wave", surface_error<2>({.axis = 1}));
  validation::print_row("soil-on-rock", surface_error<2>({.layered = true}));
  validation::print_row("rigid-base", surface_error<2>({.base = Base::rigid}));
  validation::print_row("in-space", surface_error<3>({.layered = true}));
  validation::print_row("viscous-sides", surface_error<2>({.columns = false}));
  validation::print_row("energy-balance", residual());
  validation::print_row("at-rest", unrest());
  const Blow blow = blow_on_surface();
  validation::print_row("blow-beside-viscous", blow.difference);
  validation::print_row("blow-returned", blow.returned);
  validation::print_rows_of_particles();
}
