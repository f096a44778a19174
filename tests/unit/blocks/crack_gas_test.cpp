/// Gas that goes from a hole into open faces: three tetrahedra around an edge, of which one has the wall of the hole.

#include "sazare/methods/blocks/charges/crack_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/laws/explosives.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/methods/blocks/joints.hpp"

namespace sazare::methods::blocks {
namespace {

/// Nodes 0 and 1 are the edge; the elements stand around it like slices, each with one face to the next.
struct Slices {
  std::vector<Vector3> nodes = {{0, 0, 0}, {0, 0, 1}, {1, -0.2, 0.4}, {0.5, 0.9, 0.5}, {-0.5, 0.8, 0.6}, {-1, -0.1, 0.5}};
  std::vector<std::array<std::int32_t, 4>> elements = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}};
  std::vector<geometry::InteriorFace> between;
  std::array<std::int32_t, 3> wall{0, 1, 2};

  Slices() {
    for (std::int32_t i = 0; i < 2; ++i) {
      const auto& own = elements[static_cast<std::size_t>(i)];
      const auto& next = elements[static_cast<std::size_t>(i) + 1];
      // The face 0, 1, own[3], counter-clockwise seen from the next element.
      std::array<std::int32_t, 3> corners{0, 1, own[3]};
      const Vector3 area = normal(corners), across = nodes[static_cast<std::size_t>(next[3])] - nodes[0];
      if (area.dot(across) < 0) std::swap(corners[1], corners[2]);
      between.push_back({i, i + 1, 2, 3, corners});
    }
  }
  Vector3 normal(const std::array<std::int32_t, 3>& face) const {
    const auto& a = nodes[static_cast<std::size_t>(face[0])];
    return 0.5 * (nodes[static_cast<std::size_t>(face[1])] - a).cross(nodes[static_cast<std::size_t>(face[2])] - a);
  }
};

struct Blown {
  Slices slices;
  std::unique_ptr<levels::Simulation<3>> simulation;
  ChargeGas* gas = nullptr;
  CrackGas* cracks = nullptr;

  ChargeState state() const { return gas->states(simulation->now().seconds()).front(); }
  void run_until(
      Real time, const std::function<void()>& each = [] {}) {
    while (simulation->now().seconds() < time * (1 - 1e-12)) {
      simulation->advance();
      each();
    }
  }
};

struct Options {
  GasInCracks way = GasInCracks::flow;
  Real base_step = 2e-6;
  Real share = 1;
  Real density = 2600;
  bool free_edge = false;
  bool held = true;  // the piece with the wall; else gas does not press on it
  Real cut_distance = std::numeric_limits<Real>::infinity();
};

/// A hole of a litre with a gas of constant exponent, whose wall is held.
std::unique_ptr<Blown> blow(const Options& options) {
  auto made = std::make_unique<Blown>();
  const Slices& slices = made->slices;
  state::Bodies<3> bodies;
  for (const auto& element : slices.elements) {
    geometry::Tetrahedron corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = slices.nodes[static_cast<std::size_t>(element[k])];
    const Real volume = std::abs(geometry::volume(corners));
    state::add_body(bodies, options.density * volume, geometry::centroid(corners),
                    options.density * volume * Vector3(0.1, 0.1, 0.1), Quaternion::Identity(), 1);
  }
  if (options.held) bodies.locks[0] = {7, 7};
  bodies.pole = state::middle(bodies);
  Charge charge;
  charge.density = 1000;
  charge.velocity = 1e9;
  charge.area = charge.hole_area = 0.001;
  charge.gas.omega = 0.4;
  charge.energy = 4e9;
  charge.filled = {0, 1};
  charge.cut_distance = options.cut_distance;
  charge.cracks = {options.way, options.share, 1e-4, 0.6};
  ChargedFace wall;
  if (options.held)
    wall.area = -slices.normal(slices.wall);
  else
    wall.area.setZero();
  wall.start = (slices.nodes[0] + slices.nodes[1] + slices.nodes[2]) / 3;
  wall.centre = wall.start - bodies.start[0];
  wall.part = {0, 1};
  levels::TermList<3> terms;
  auto joints = std::make_unique<Joints>(std::vector<JointKind>{}, std::span<const JointFace>{}, bodies);
  auto gas = std::make_unique<ChargeGas>(std::vector{charge}, std::vector{wall}, bodies);
  made->gas = gas.get();
  GasFaces faces{slices.nodes, slices.between, {{slices.wall, 0}}};
  if (options.free_edge) faces.outer.push_back({{1, 4, 5}});
  auto cracks = std::make_unique<CrackGas>(*gas, *joints, faces, bodies);
  made->cracks = cracks.get();
  terms.push_back(std::move(joints));
  terms.push_back(std::move(gas));
  terms.push_back(std::move(cracks));
  levels::StepRules rules;
  rules.base_step = options.base_step;
  made->simulation = std::make_unique<levels::Simulation<3>>(std::move(bodies), std::move(terms), rules);
  made->simulation->start();
  return made;
}

Real kinetic(const Blown& blown) {
  return blown.simulation->energy_balance(blown.simulation->snapshot())[terms::EnergyKind::kinetic];
}

TEST(crack_paths, know_what_stands_around_every_edge) {
  const Slices slices;
  const std::vector<GasOuterFace> outer = {{slices.wall, 5}, {{1, 4, 5}}};
  const CrackPaths paths(slices.between, outer);
  const CrackPaths::Edge shared = paths.edge(paths.edges_of(0)[slices.between[0].nodes[1] == 1 ? 0 : 2]);
  EXPECT_EQ(std::vector<Index>(shared.faces.begin(), shared.faces.end()), (std::vector<Index>{0, 1}));
  EXPECT_EQ(std::vector<Index>(shared.walls.begin(), shared.walls.end()), (std::vector<Index>{5}));
  EXPECT_FALSE(shared.is_free);
  int alone = 0, free = 0;
  for (Index face = 0; face < 2; ++face)
    for (std::size_t k = 0; k < 3; ++k) {
      const CrackPaths::Edge edge = paths.edge(paths.edges_of(face)[k]);
      const auto& nodes = slices.between[static_cast<std::size_t>(face)].nodes;
      const std::array ends{nodes[k], nodes[(k + 1) % 3]};
      const bool has_both = std::ranges::count(ends, 0) + std::ranges::count(ends, 1) == 2;
      EXPECT_EQ(edge.faces.size(), has_both ? 2u : 1u);
      alone += !has_both;
      free += edge.is_free;
    }
  EXPECT_EQ(alone, 4);
  EXPECT_EQ(free, 1);  // from node 1 to node 4
}

/// The push is the derivative of the room, at any opening.
TEST(crack_gas, has_room_that_grows_as_it_pushes) {
  constexpr Real aperture = 1e-4, step = 1e-8;
  for (const Real opening : {-1e-2, -3e-4, -1e-4, -1e-5, 0.0, 1e-5, 1e-3}) {
    const CrackRoom room = crack_room(aperture, opening);
    const Real rate = (crack_room(aperture, opening + step).width - crack_room(aperture, opening - step).width) / (2 * step);
    EXPECT_NEAR(room.rate, rate, 1e-4);
    EXPECT_GE(room.width, 0.5 * aperture);
  }
  EXPECT_EQ(crack_room(aperture, 0).width, aperture);
}

TEST(crack_gas, fills_faces_that_are_open_beside_its_hole) {
  const auto blown = blow({.density = 1e12});
  EXPECT_TRUE(blown->cracks->network().cracks().empty());
  blown->run_until(2e-3);
  EXPECT_EQ(blown->cracks->network().cracks().size(), 2u);
  const Real pressure = blown->state().pressure;
  for (const GasCrack& crack : blown->cracks->network().cracks()) EXPECT_NEAR(crack.pressure, pressure, 0.02 * pressure);
  EXPECT_LT(blown->state().mass, 1);
}

/// The wall is held, so that only cracks do work, and what they give is the motion.
TEST(crack_gas, gives_the_energy_that_it_loses) {
  std::array<Real, 2> off;
  for (int fine = 0; fine < 2; ++fine) {
    const auto blown = blow({.base_step = fine == 0 ? 4e-6 : 2e-6});
    blown->run_until(1e-3);
    const ChargeState state = blown->state();
    EXPECT_GT(state.work, 0.01 * state.released);
    EXPECT_GT(state.in_cracks, 0);
    EXPECT_NEAR(state.released, state.energy() + state.work + state.in_cracks + state.lost, 1e-12 * state.released);
    off[static_cast<std::size_t>(fine)] = std::abs(kinetic(*blown) / state.work - 1);
  }
  EXPECT_LT(off[1], 2e-3);
  EXPECT_LT(off[1], 0.7 * off[0]);
}

TEST(crack_gas, pushes_both_sides_alike) {
  const auto blown = blow({.held = false});
  blown->run_until(1e-3);
  const auto now = blown->simulation->snapshot();
  const auto& bodies = blown->simulation->bodies();
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  Real all = 0;
  for (std::size_t body = 0; body < 3; ++body) {
    const Vector3 momentum = bodies.inertia[body].mass * now.velocity[body];
    linear += momentum;
    angular += now.pose[body].position.cross(momentum) + now.angular_momentum[body];
    all += momentum.norm();
  }
  EXPECT_GT(all, 0);
  EXPECT_LT(linear.norm(), 1e-13 * all);
  EXPECT_LT(angular.norm(), 1e-13 * all);
}

TEST(crack_gas, has_a_share_of_the_pressure_where_it_does_not_flow) {
  const auto blown = blow({.way = GasInCracks::share, .share = 0.25});
  blown->run_until(2e-4);
  const ChargeState state = blown->state();
  for (const GasCrack& crack : blown->cracks->network().cracks())
    EXPECT_NEAR(crack.pressure, 0.25 * state.pressure, 0.01 * state.pressure);
  EXPECT_EQ(state.in_cracks, 0);
  EXPECT_GT(state.work, 0);
  EXPECT_NEAR(kinetic(*blown), state.work, 5e-3 * state.work);
}

TEST(crack_gas, stays_in_its_hole_where_it_is_told_to) {
  const auto blown = blow({.way = GasInCracks::none});
  blown->run_until(1e-4);
  EXPECT_TRUE(blown->cracks->network().cracks().empty());
  EXPECT_EQ(kinetic(*blown), 0);
}

TEST(crack_gas, leaves_at_a_free_face) {
  const auto tight = blow({}), open = blow({.free_edge = true});
  tight->run_until(1e-3);
  open->run_until(1e-3);
  EXPECT_EQ(tight->state().lost, 0);
  EXPECT_GT(open->state().lost, 0);
  EXPECT_LT(open->state().work, tight->state().work);
}

/// Its room and its gas go to the hole; where it was open to the air, the gas is gone and the hole leaks.
TEST(crack_gas, of_a_crack_that_gapes_is_that_of_the_hole_or_gone) {
  for (const bool free_edge : {false, true}) {
    const auto blown = blow({.free_edge = free_edge, .cut_distance = 0.005});
    blown->run_until(3e-3);
    const ChargeState state = blown->state();
    for (const GasCrack& crack : blown->cracks->network().cracks()) EXPECT_FALSE(crack.has_gas());
    EXPECT_EQ(state.lost > 0, free_edge);
    EXPECT_EQ(state.in_cracks, 0);
    if (!free_edge) {
      EXPECT_GT(state.volume, 1.003e-3);  // of the hole a litre
      EXPECT_NEAR(state.mass, 1, 1e-12);
    }
    blown->run_until(4e-3);
    EXPECT_EQ(blown->state().work, state.work);
    EXPECT_EQ(blown->state().mass < state.mass, free_edge);
    EXPECT_NEAR(state.released, state.energy() + state.work + state.lost, 1e-12 * state.released);
  }
}

}  // namespace
}  // namespace sazare::methods::blocks
