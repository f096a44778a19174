#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "sazare/methods/fem/inclined_waves/inclined_field.hpp"
#include "sazare/methods/fem/soil_column.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

constexpr Real degree = std::numbers::pi / 180;
constexpr Complex i_unit{0, 1};

ElasticLayer layer(Real thickness, Real density, Real s_velocity, Real p_velocity) {
  const Real shear = density * s_velocity * s_velocity;
  return {thickness, density, density * p_velocity * p_velocity - 2 * shear, shear, 0, 0};
}

std::vector<ElasticLayer> three_layers() {
  return {layer(30, 2200, 700, 1500), layer(8, 1900, 300, 800), layer(5, 1700, 150, 500)};
}

constexpr std::array all_kinds{WaveKind::p, WaveKind::sv, WaveKind::sh};

struct Wave {
  LayeredGround ground;
  Complex frequency;
  std::vector<LayeredGround::Amplitudes> amplitudes;

  Wave(std::vector<ElasticLayer> layers, WaveKind kind, Real angle, Complex w)
      : ground(std::move(layers), kind, angle), frequency(w), amplitudes(ground.amplitudes(w)) {}
  WaveField at(Real height) const { return ground.field(amplitudes, frequency, height); }
};

TEST(LayeredGround, LeavesTheSurfaceFree) {
  for (const WaveKind kind : all_kinds) {
    const Wave wave(three_layers(), kind, 17 * degree, {40, -1});
    const WaveField top = wave.at(43);
    EXPECT_LT(top.stress.col(2).norm(), 1e-9 * 2200 * 700 * top.velocity.norm());
  }
}

TEST(LayeredGround, IsContinuousBetweenLayers) {
  for (const WaveKind kind : all_kinds) {
    const Wave wave(three_layers(), kind, -12 * degree, {60, 0});
    for (const Real height : {30.0, 38.0}) {
      const WaveField below = wave.at(height - 1e-9), above = wave.at(height + 1e-9);
      EXPECT_LT((below.velocity - above.velocity).norm(), 1e-8 * below.velocity.norm());
      EXPECT_LT((below.stress - above.stress).col(2).norm(), 1e-6 * below.stress.norm());
    }
  }
}

/// Newton's law and Hooke's, from differences over height, with the damping of the layer.
TEST(LayeredGround, ObeysTheLawsOfMotion) {
  auto layers = three_layers();
  layers[1].mass_rate = 3;
  layers[1].stiffness_time = 4e-3;
  for (const WaveKind kind : all_kinds) {
    const Complex w{25, -2};
    const Wave wave(layers, kind, 20 * degree, w);
    const Real z = 34, step = 1e-3;
    const WaveField low = wave.at(z - step), here = wave.at(z), high = wave.at(z + step);
    const Complex along = -i_unit * w * wave.ground.slowness();
    const ComplexVector force = along * here.stress.col(0) + (high.stress.col(2) - low.stress.col(2)) / (2 * step);
    const ComplexVector inertia = layers[1].density * (i_unit * w + layers[1].mass_rate) * here.velocity;
    EXPECT_LT((force - inertia).norm(), 1e-6 * inertia.norm());
    ComplexMatrix gradient = ComplexMatrix::Zero();  // of the displacement: by component and axis
    gradient.col(0) = along * here.velocity / (i_unit * w);
    gradient.col(2) = (high.velocity - low.velocity) / (2 * step) / (i_unit * w);
    const ComplexMatrix strain = 0.5 * (gradient + gradient.transpose());
    const ComplexMatrix stress =
        (Real{1} + i_unit * w * layers[1].stiffness_time) *
        (layers[1].lame * strain.trace() * ComplexMatrix::Identity() + 2 * layers[1].shear_modulus * strain);
    EXPECT_LT((stress - here.stress).norm(), 1e-6 * stress.norm());
  }
}

/// Without damping all energy that comes in goes out again: none flows through a level plane.
TEST(LayeredGround, KeepsEnergy) {
  for (const WaveKind kind : all_kinds) {
    const Wave wave(three_layers(), kind, 24 * degree, {80, 0});
    for (const Real height : {0.0, 20.0, 33.0, 41.0}) {
      const WaveField field = wave.at(height);
      EXPECT_LT(std::abs(std::real(field.velocity.dot(field.stress.col(2)))), 1e-9 * 2200 * 1500);
    }
  }
}

/// A layer on a half space under a wave across the plane: cos and sin of the phase in the layer, for any angle.
TEST(LayeredGround, AmplifiesShWavesAsTheTransferFunctionSays) {
  const auto rock = layer(10, 2200, 700, 1500), soil = layer(8, 1900, 300, 800);
  for (const Real angle : {0.0, 35.0}) {
    const Complex w{55, 0};
    const Wave wave({rock, soil}, WaveKind::sh, angle * degree, w);
    const Real p = wave.ground.slowness();
    const auto vertical = [&](Real speed) { return std::sqrt(1 / (speed * speed) - p * p); };
    const Real ratio = soil.shear_modulus * vertical(300) / (rock.shear_modulus * vertical(700));
    const Complex phase = w * vertical(300) * Real{8};
    const Complex at_interface = std::exp(-i_unit * w * vertical(700) * Real{10});  // of the wave that goes up
    const Complex surface = Real{2} * at_interface / (std::cos(phase) + i_unit * ratio * std::sin(phase));
    EXPECT_LT(std::abs(wave.at(18).velocity[1] - surface), 1e-10);
  }
}

/// At the base of a half space what goes up is the incident wave itself.
TEST(LayeredGround, BringsInTheWaveAlongItsDirection) {
  const Real angle = 20 * degree;
  const Wave p({layer(50, 2200, 700, 1500)}, WaveKind::p, angle, {30, -5}),
      sv({layer(50, 2200, 700, 1500)}, WaveKind::sv, angle, {30, -5});
  EXPECT_NEAR(std::abs(p.amplitudes[0].up[0] - Real{1}), 0, 1e-12);
  EXPECT_NEAR(std::abs(sv.amplitudes[0].up[1] - Real{1}), 0, 1e-12);
  EXPECT_NEAR(p.ground.slowness(), std::sin(angle) / 1500, 1e-15);
  EXPECT_NEAR(sv.ground.slowness(), std::sin(angle) / 700, 1e-15);
}

TEST(CriticalAngle, IsThatOfTheFastestWaveItCanMake) {
  EXPECT_NEAR(critical_angle(three_layers(), WaveKind::sv), std::asin(700.0 / 1500), 1e-12);
  EXPECT_NEAR(critical_angle(three_layers(), WaveKind::p), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(critical_angle(three_layers(), WaveKind::sh), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(critical_angle({layer(1, 2000, 200, 400), layer(1, 2000, 300, 500)}, WaveKind::sh), std::asin(2.0 / 3), 1e-12);
}

laws::GroundMotion wavelet() {
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::velocity;
  motion.ricker_wave = {8, 0.2};
  return motion;
}

TEST(WaveHistories, AreThoseOfDAlembertWhereTheWaveIsVertical) {
  const LayeredGround ground({layer(40, 2000, 200, 500)}, WaveKind::sv, 0);
  using Histories = WaveHistories<2>;
  const Histories histories(ground, {WaveKind::sv, 0, 0, 0, 1}, wavelet(), 1e-3,
                            {{Histories::Quantity::velocity, 0, 25},
                             {Histories::Quantity::displacement, 0, 25},
                             {Histories::Quantity::traction, 1, 25}});
  const auto motion = wavelet();
  for (Real time = 0.05; time < 0.9; time += 0.0373) {
    const auto up = motion.at(time - 25.0 / 200), down = motion.at(time - 55.0 / 200);
    EXPECT_NEAR(histories.at(0, time).x(), up.velocity + down.velocity, 2e-5);
    EXPECT_NEAR(histories.at(1, time).x(), up.displacement + down.displacement, 2e-7);
    EXPECT_NEAR(histories.at(2, time).x(), 2000 * 200 * (down.velocity - up.velocity), 2e-5 * 2000 * 200);
    EXPECT_NEAR(histories.at(0, time).y(), 0, 1e-12);
  }
  EXPECT_EQ(histories.at(0, -0.1).x(), 0);
}

/// In space an SV wave that travels along y moves the ground along y, and an SH wave against x.
TEST(WaveHistories, TurnWithTheAzimuth) {
  using Histories = WaveHistories<3>;
  const auto speed = [&](WaveKind kind, Real azimuth) {
    const LayeredGround ground({layer(40, 2000, 200, 500)}, kind, 15 * degree);
    const Histories histories(ground, {kind, 15 * degree, azimuth * degree, 0, 1}, wavelet(), 1e-3,
                              {{Histories::Quantity::velocity, 0, 40}});
    return histories.at(0, 0.2 + 40 * std::cos(15 * degree) / 200);
  };
  const Vector3 along = speed(WaveKind::sv, 0), turned = speed(WaveKind::sv, 90), across = speed(WaveKind::sh, 90);
  EXPECT_LT((turned - Vector3(0, along.x(), along.z())).norm(), 1e-12);
  EXPECT_NEAR(across.x(), -2 * wavelet().at(0.2).velocity, 1e-3);
  EXPECT_NEAR(across.y(), 0, 1e-12);
}

constexpr Real width = 24, height = 12;

BodyDescription ground_of_two_layers(Real hill) {
  BodyDescription body;
  body.mesh = test::box(geometry::ElementShape::quadrilateral8, {{width, height, 1}, {12, 12, 1}, 0});
  for (const auto& [density, velocity, ratio] : {std::array{2100.0, 300.0, 0.01}, std::array{1800.0, 150.0, 0.03}}) {
    SolidMaterial material;
    material.density = density;
    material.damping_ratio = ratio;
    material.elastic = {density * velocity * velocity, 2 * density * velocity * velocity};
    body.materials.push_back(material);
  }
  for (const auto& element : body.mesh.elements) {
    Real lowest = height;
    for (const Index node : element.node_list()) lowest = std::min(lowest, body.mesh.nodes[at(node)].y());
    body.material.push_back(lowest > 5.9 ? 1 : 0);
  }
  for (Vector3& node : body.mesh.nodes) node.y() *= 1 + hill / height * std::clamp(2 * node.x() / width - 0.5, 0.0, 1.0);
  return body;
}

FemStepper<2> under_a_wave(Real hill, Real gravity = 0) {
  BodyDescription body = ground_of_two_layers(hill);
  Supports<2> supports;
  supports.motions = {wavelet()};
  supports.gravity = {0, -gravity};
  ViscousBoundary<2> base;
  base.motion.fill(Support::no_motion);
  std::set<Index> nodes;
  for (const auto& face : body.mesh.find_group("bottom")->elements) {
    base.surface.push_back(face);
    base.faces.push_back(viscous_face<2>(body, 0, face));
    nodes.insert(face.node_list().begin(), face.node_list().end());
  }
  base.nodes.assign(nodes.begin(), nodes.end());
  supports.viscous.push_back(base);
  for (const std::string name : {"left", "right"})
    for (auto& side : free_field_sides<2>(body, *body.mesh.find_group(name), 1)) {
      stand_on_base(side, supports);
      std::erase_if(side.nodes, [&](Index node) { return nodes.contains(node); });
      supports.sides.push_back(std::move(side));
    }
  supports.wave = IncidentWave{WaveKind::sv, 20 * degree, 0, 0, 0.6};
  FemRules rules;
  rules.step = 1e-3;
  rules.tolerance = 1e-11;
  rules.damping = laws::RayleighDamping::make(2, 20);
  return FemStepper<2>(std::make_unique<Body<2>>(std::move(body)), std::move(supports), rules);
}

/// A water table within an element parts its layer, and the ground below is as heavy as it is with its water.
TEST(ElasticLayers, HaveTheDensityOfSaturatedGround) {
  BodyDescription body = ground_of_two_layers(0);
  body.materials[1].saturation = Saturation{2000, {9810, 1, 8.4}};
  const auto sides = free_field_sides<2>(body, *body.mesh.find_group("left"), 0);
  const auto layers = elastic_layers(sides[0], {});
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].density, 2100);
  EXPECT_EQ(layers[1].density, 2000);
  EXPECT_NEAR(layers[1].thickness, 2.4, 1e-12);
  EXPECT_EQ(layers[2].density, 1800);
  EXPECT_NEAR(layers[2].thickness, 3.6, 1e-12);
}

/// Every node moves as its layers do without a body in them; the wave reaches the right side later.
TEST(InclinedField, LeavesLevelGroundToItself) {
  auto stepper = under_a_wave(0);
  const auto& nodes = stepper.body().mesh().nodes;
  const auto& sides = stepper.supports().sides;
  const LayeredGround ground(elastic_layers(sides[0], stepper.rules().damping), WaveKind::sv, 20 * degree);
  using Histories = WaveHistories<2>;
  const Histories surface(ground, *stepper.supports().wave, wavelet(), stepper.rules().step,
                          {{Histories::Quantity::velocity, 0, height}});
  stepper.start();
  Real worst = 0, largest = 0;
  while (stepper.time() < 0.55) {
    stepper.advance();
    for (std::size_t node = 0; node < nodes.size(); ++node)
      if (nodes[node].y() > height - 1e-6) {
        const Vector<2> exact = surface.at(0, stepper.time() - ground.slowness() * nodes[node].x());
        const Vector<2> own(stepper.state().velocity[2 * node], stepper.state().velocity[2 * node + 1]);
        worst = std::max(worst, (own - exact).norm());
        largest = std::max(largest, exact.norm());
      }
  }
  EXPECT_GT(largest, 2);
  EXPECT_LT(worst, 0.01 * largest);
}

TEST(InclinedField, BalancesItsEnergyBesideASlope) {
  auto stepper = under_a_wave(6);
  stepper.start();
  while (stepper.time() < 0.5) stepper.advance();
  const FemWork& work = stepper.work();
  EXPECT_LT(std::abs(stepper.energy_residual()), 1e-9 * (std::abs(work.waves) + std::abs(work.sides)));
  EXPECT_GT(work.radiation, 0);
}

TEST(InclinedField, LeavesGroundAtRestUntilTheWaveComes) {
  auto stepper = under_a_wave(6, 9.81);
  stepper.relax();
  stepper.start();
  for (int step = 0; step < 20; ++step) {
    stepper.advance();
    for (const Real acceleration : stepper.state().acceleration) EXPECT_LT(std::abs(acceleration), 1e-2);
  }
}

TEST(InclinedField, GoesThroughStepsAgainWithTheSameBits) {
  auto stepper = under_a_wave(6);
  stepper.start();
  for (int step = 0; step < 200; ++step) stepper.advance();
  const auto saved = stepper.state();
  for (int step = 0; step < 50; ++step) stepper.advance();
  const auto velocity = stepper.state().velocity;
  stepper.restore(saved);
  for (int step = 0; step < 50; ++step) stepper.advance();
  EXPECT_EQ(velocity, stepper.state().velocity);
}

/// The forces that a history reports on sides and base are those that the body feels: with its inertia they are in balance.
TEST(InclinedField, ReportsTheForcesThatItExerts) {
  auto stepper = under_a_wave(6);
  stepper.start();
  while (stepper.time() < 0.35) stepper.advance();
  Vector<2> outside = stepper.viscous_force(0) + stepper.side_force(0) + stepper.side_force(1);
  NodalColumn inertia(stepper.body().freedoms(), 0), friction = inertia;
  stepper.mass().multiply(stepper.state().acceleration, 1, inertia);
  BlockMatrix<2> damping = stepper.body().damping_matrix(stepper.rules().damping);
  damping.multiply(stepper.state().velocity, 1, friction);
  Vector<2> own = Vector<2>::Zero();
  for (std::size_t i = 0; i < inertia.size(); ++i) own[static_cast<int>(i % 2)] += inertia[i] + friction[i];
  EXPECT_GT(own.norm(), 1000);
  EXPECT_LT((outside - own).norm(), 1e-7 * own.norm());
}

}  // namespace
}  // namespace sazare::methods::fem
