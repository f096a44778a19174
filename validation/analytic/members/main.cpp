#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/methods/fem/stepper.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using namespace sazare::methods::fem;

constexpr Real modulus = 2e11, area = 1e-2, second_moment = 2e-5, density = 7850;

MemberSet steel(MemberKind kind, std::vector<std::array<Index, 2>> lines) {
  MemberSet set;
  set.name = "steel";
  set.kind = kind;
  set.youngs_modulus = modulus;
  set.area = area;
  set.second_moment = second_moment;
  set.density = density;
  set.lines = std::move(lines);
  return set;
}

/// Nodes from the origin along a direction.
BodyDescription line_of(int dimension, const Vector3& end, int pieces, MemberKind kind) {
  BodyDescription body;
  body.mesh.dimension = dimension;
  std::vector<std::array<Index, 2>> lines;
  for (Index i = 0; i <= pieces; ++i) {
    body.mesh.nodes.push_back(end * i / pieces);
    body.mesh.node_tags.push_back(i + 1);
    if (i > 0) lines.push_back({i - 1, i});
  }
  body.members = {steel(kind, lines)};
  return body;
}

template <int D>
Supports<D> clamped(std::initializer_list<Index> nodes) {
  Supports<D> supports;
  supports.clamped = nodes;
  for (const Index node : nodes)
    for (int axis = 0; axis < D; ++axis) supports.held.push_back({node, axis, Support::no_motion, 0});
  return supports;
}

FemRules rules_of(Real step, bool statics) {
  FemRules rules;
  rules.step = step;
  rules.statics = statics;
  rules.tolerance = 1e-9;
  return rules;
}

template <int D>
FemStepper<D> at_rest(BodyDescription body, Supports<D> supports, NodalColumn force) {
  supports.loads = {{"load", std::move(force), 0}};
  FemStepper<D> stepper(std::make_unique<Body<D>>(std::move(body)), std::move(supports), rules_of(1, true));
  stepper.start();
  stepper.advance();
  return stepper;
}

/// Deflection of a cantilever in space under a force across its end.
Real cantilever() {
  const Vector3 end(1, 2, 3);
  const Vector3 across = end.unitOrthogonal();
  NodalColumn force(15, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) force[12 + axis] = 1000 * across[static_cast<int>(axis)];
  const auto stepper = at_rest<3>(line_of(3, end, 4, MemberKind::beam), clamped<3>({0}), force);
  Real moved = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) moved += across[static_cast<int>(axis)] * stepper.state().displacement[12 + axis];
  return moved / (1000 * std::pow(end.norm(), 3) / (3 * modulus * second_moment));
}

/// Moment at the foot of a clamped portal frame with equal members over half of force times height.
Real frame() {
  BodyDescription body;
  body.mesh.dimension = 2;
  body.mesh.nodes = {{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}};
  body.mesh.node_tags = {1, 2, 3, 4};
  body.members = {steel(MemberKind::beam, {{0, 1}, {3, 2}, {1, 2}})};
  body.members[0].area = 10;
  NodalColumn force(8, 0);
  force[2] = force[4] = 500;
  const auto stepper = at_rest<2>(std::move(body), clamped<2>({0, 3}), force);
  return stepper.body()
             .members()
             .forces(0, stepper.state().displacement, stepper.state().velocity, stepper.state().memory.members)
             .moment /
         (1000 * 4.0 / 2);
}

/// A long pile on springs, pushed at its head: deflection and moment over those of Hetenyi's beam.
std::array<Real, 2> pile_on_springs() {
  constexpr int pieces = 400;
  constexpr Real long_pile = 20, bedding = 4e6, push = 1e4;
  BodyDescription body = line_of(2, {0, -long_pile, 0}, pieces, MemberKind::beam);
  MemberSet springs;
  springs.name = "springs";
  springs.kind = MemberKind::spring;
  springs.stiffness = bedding * long_pile / pieces;
  MemberSet half = springs;
  half.stiffness /= 2;
  Supports<2> supports;
  for (Index i = 0; i <= pieces; ++i) {
    const auto beside = static_cast<Index>(body.mesh.nodes.size());
    body.mesh.nodes.push_back(body.mesh.nodes[static_cast<std::size_t>(i)] + Vector3(1, 0, 0));
    body.mesh.node_tags.push_back(beside + 1);
    (i == 0 || i == pieces ? half : springs).lines.push_back({i, beside});
    for (int axis = 0; axis < 2; ++axis) supports.held.push_back({beside, axis, Support::no_motion, 0});
  }
  supports.held.push_back({pieces, 1, Support::no_motion, 0});
  body.members.insert(body.members.end(), {springs, half});
  NodalColumn force(body.mesh.nodes.size() * 2, 0);
  force[0] = push;
  const auto stepper = at_rest<2>(std::move(body), supports, force);
  const Real beta = std::pow(bedding / (4 * modulus * second_moment), 0.25);
  const Real moment = stepper.body()
                          .members()
                          .forces(0, stepper.state().displacement, stepper.state().velocity, stepper.state().memory.members)
                          .moment;
  return {stepper.state().displacement[0] / (2 * push * beta / bedding),
          moment / (push / beta * std::exp(-std::numbers::pi / 4) * std::sin(std::numbers::pi / 4))};
}

/// Period of the free vibration of a cantilever after a push in its first mode's manner, by the zeros of its end.
Real period() {
  constexpr Real length = 4;
  constexpr int pieces = 8;
  Supports<2> supports = clamped<2>({0});
  FemStepper<2> stepper(std::make_unique<Body<2>>(line_of(2, {length, 0, 0}, pieces, MemberKind::beam)), supports,
                        rules_of(2e-4, false));
  stepper.start();
  FemState<2> bent = stepper.state();
  for (std::size_t i = 1; i <= pieces; ++i) {  // velocities of the first mode
    const Real x = 1.87510407 * static_cast<Real>(i) / pieces, ratio = 0.734095514;
    bent.velocity[2 * i + 1] = std::cosh(x) - std::cos(x) - ratio * (std::sinh(x) - std::sin(x));
    bent.velocity[2 * (pieces + 1 + i)] = 1.87510407 / length * (std::sinh(x) + std::sin(x) - ratio * (std::cosh(x) - std::cos(x)));
  }
  stepper.restore(bent);
  std::vector<Real> zeros;
  Real before = 0;
  while (zeros.size() < 9) {
    stepper.advance();
    const Real now = stepper.state().displacement[2 * pieces + 1];
    if (before != 0 && (now > 0) != (before > 0)) zeros.push_back(stepper.time() - stepper.rules().step * now / (now - before));
    before = now;
  }
  const Real exact =
      2 * std::numbers::pi / (1.87510407 * 1.87510407) * std::sqrt(density * area / (modulus * second_moment)) * length * length;
  return (zeros.back() - zeros.front()) / 4 / exact;
}

/// A bar whose end is pulled at once: the velocity of the end before the wave comes back, and the residual of energy.
std::array<Real, 2> wave() {
  constexpr int pieces = 200;
  constexpr Real length = 10, pull = 1e4;
  const Real speed = std::sqrt(modulus / density);
  Supports<2> supports = clamped<2>({0});
  for (Index i = 1; i <= pieces; ++i) supports.held.push_back({i, 1, Support::no_motion, 0});
  NodalColumn force(2 * (pieces + 1), 0);
  force[2 * pieces] = pull;
  supports.loads = {{"pull", force, 0}};
  FemStepper<2> stepper(std::make_unique<Body<2>>(line_of(2, {length, 0, 0}, pieces, MemberKind::bar)), supports,
                        rules_of(length / pieces / speed, false));
  stepper.start();
  for (int step = 0; step < 2 * pieces; ++step) stepper.advance();
  const Real moved = stepper.state().displacement[2 * pieces];
  return {moved / (2 * length / speed * pull / (area * density * speed)),
          std::abs(stepper.energy_residual()) / stepper.work().loads};
}

constexpr Real plastic_moment = 1e5;

/// Moves a node along an axis, to and fro where there are cycles, else one way; steps of a static run.
FemStepper<2> moved(BodyDescription body, Supports<2> supports, const Support& support, Real way, Real cycles, int steps) {
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::displacement;
  motion.amplitude = way;
  motion.shape = cycles > 0 ? laws::GroundMotion::Shape::sine : laws::GroundMotion::Shape::record;
  motion.sine_wave = {cycles / steps, 0};
  motion.record = laws::Record::make(steps, {0, 1});
  supports.motions = {motion};
  supports.held.push_back({support.node, support.axis, 0, 0});
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(body)), std::move(supports), rules_of(1, true));
  stepper.start();
  for (int step = 0; step < steps; ++step) stepper.advance();
  return stepper;
}

/// The force with which a node is moved far.
Real limit_load(BodyDescription body, Supports<2> supports, const Support& support, Real way) {
  body.members[0].yield_moment = plastic_moment;
  const auto stepper = moved(std::move(body), std::move(supports), support, way, 0, 40);
  return std::abs(stepper.reactions()[static_cast<std::size_t>(2 * support.node + support.axis)]);
}

Real cantilever_limit() {
  return limit_load(line_of(2, {4, 0, 0}, 5, MemberKind::beam), clamped<2>({0}), {5, 1}, 2) / (plastic_moment / 4);
}

Real propped_limit() {
  Supports<2> supports = clamped<2>({0});
  supports.held.push_back({6, 1, Support::no_motion, 0});
  return limit_load(line_of(2, {4, 0, 0}, 6, MemberKind::beam), supports, {3, 1}, -1) / (6 * plastic_moment / 4);
}

Real frame_limit() {
  BodyDescription body;
  body.mesh.dimension = 2;
  body.mesh.nodes = {{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}};
  body.mesh.node_tags = {1, 2, 3, 4};
  body.members = {steel(MemberKind::beam, {{0, 1}, {3, 2}, {1, 2}})};
  return limit_load(std::move(body), clamped<2>({0, 3}), {1, 0}, 1) / (4 * plastic_moment / 4);
}

/// A long pile in soil that resists with the same force at every depth, pushed at its head.
Real pile_limit() {
  constexpr int pieces = 200;
  constexpr Real long_pile = 12, resistance = 3e4;
  BodyDescription body = line_of(2, {0, -long_pile, 0}, pieces, MemberKind::beam);
  MemberSet soil;
  soil.name = "soil";
  soil.kind = MemberKind::spring;
  soil.stiffness = 5e7 * long_pile / pieces;
  soil.yield_force = resistance * long_pile / pieces;
  MemberSet half = soil;
  half.stiffness /= 2;
  half.yield_force /= 2;
  Supports<2> supports;
  for (Index i = 0; i <= pieces; ++i) {
    const auto beside = static_cast<Index>(body.mesh.nodes.size());
    body.mesh.nodes.push_back(body.mesh.nodes[static_cast<std::size_t>(i)] + Vector3(1, 0, 0));
    body.mesh.node_tags.push_back(beside + 1);
    (i == 0 || i == pieces ? half : soil).lines.push_back({i, beside});
    for (const int axis : {0, 1}) supports.held.push_back({beside, axis, Support::no_motion, 0});
  }
  supports.held.push_back({pieces, 1, Support::no_motion, 0});
  body.members.insert(body.members.end(), {soil, half});
  return limit_load(std::move(body), supports, {0, 0}, 1) / std::sqrt(2 * resistance * plastic_moment);
}

/// What a bar dissipates in a cycle beyond its yield force, over that of theory, and the residual of the balance of energy.
std::array<Real, 2> cycle() {
  constexpr Real yield = 1e5, way = 2e-3, stiffness = modulus * area / 10;
  constexpr int steps = 4000;
  BodyDescription body = line_of(2, {10, 0, 0}, 1, MemberKind::bar);
  body.members[0].yield_force = yield;
  Supports<2> supports = clamped<2>({0});
  supports.held.push_back({1, 1, Support::no_motion, 0});
  const auto once = moved(body, supports, {1, 0}, way, 1, steps), twice = moved(body, supports, {1, 0}, way, 2, 2 * steps);
  return {(twice.work().members - once.work().members) / (4 * yield * (way - yield / stiffness)),
          std::abs(twice.energy_residual()) / twice.work().members};
}

}  // namespace

int main() {
  validation::print_row("cantilever", cantilever());
  validation::print_row("frame", frame());
  const auto pile = pile_on_springs();
  validation::print_row("pile-deflection", pile[0]);
  validation::print_row("pile-moment", pile[1]);
  validation::print_row("period", period());
  const auto bar = wave();
  validation::print_row("bar-wave", bar[0]);
  validation::print_row("bar-energy", bar[1]);
  validation::print_row("cantilever-limit", cantilever_limit());
  validation::print_row("propped-limit", propped_limit());
  validation::print_row("frame-limit", frame_limit());
  validation::print_row("pile-limit", pile_limit());
  const auto loop = cycle();
  validation::print_row("cycle", loop[0]);
  validation::print_row("cycle-energy", loop[1]);
}
