#include <gtest/gtest.h>

#include <cmath>

#include "sazare/core/error.hpp"
#include "sazare/methods/hybrid/rectangle_side.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "tests/support/two_sides.hpp"
#include "tests/support/window_checks.hpp"

namespace sazare::methods::hybrid {
namespace {

/// A block, and a cylinder unless it rolls about too long, on the top of a box, as thick as it.
class BlocksOnTop {
public:
  BlocksOnTop(const test::CouplingScene& scene, Real window, bool can_return = true, bool with_cylinder = true)
      : width_(scene.rules.width), fem_(test::make_fem<2>(scene, window)) {
    squares_.thickness = width_;
    squares_.contact = {scene.stiffness, 0.5 * scene.stiffness, scene.restitution < 1 ? 0.2 : 0.0, scene.friction, width_};
    const Real top = scene.box.size.y();
    squares_.add(geometry::OutlineKind::rectangle, {0.22, top + 0.0505}, 0.06, 0.05, scene.friction > 0 ? 0.01 : 0);
    if (with_cylinder) squares_.add(geometry::OutlineKind::circle, {0.08, top + 0.0405}, 0.04, 0.04, 0, 1);
    squares_.supports.gravity = {scene.gravity.x(), scene.gravity.y()};
    stepper_ = squares_.make(window / static_cast<Real>(scene.steps));
    bodies_ =
        std::make_unique<RectangleSide>(*stepper_, *squares_.forces, static_cast<Index>(squares_.particles().size()), can_return);
    const auto& mesh = fem_->body().mesh();
    continuum_ = std::make_unique<ContinuumSide<2>>(*fem_, geometry::linear_surface(mesh, *mesh.find_group("top")), scene.rules);
  }

  void start() {
    fem_->start();
    DirectChannel channel(*bodies_);
    continuum_->start(channel.open(continuum_->shape()));
  }
  void advance(int windows) {
    DirectChannel channel(*bodies_);
    for (int window = 0; window < windows; ++window) continuum_->advance(channel);
  }
  void columns(Archive& archive) {
    archive.folder("fem", [&] { fem_->columns(archive); });
    archive.folder("continuum", [&] { continuum_->columns(archive); });
    if (archive.reading()) bodies_->attach(continuum_->shape());
    archive.folder("bodies", [&] { bodies_->columns(archive); });
    archive.folder("stepper", [&] { stepper_->columns(archive); });
  }

  /// Momentum of all elements of the rectangles [kg m/s].
  Vector3 momentum() const {
    Vector3 sum = Vector3::Zero();
    const auto velocity = stepper_->velocity();
    for (std::size_t i = 0; i < stepper_->particles().size(); ++i)
      for (std::size_t axis = 0; axis < 2; ++axis)
        sum[static_cast<int>(axis)] += velocity[axis][i] / stepper_->particles().inverse_mass[i];
    return sum;
  }
  Real weight() const {
    Real sum = 0;
    for (std::size_t i = 0; i < stepper_->particles().size(); ++i) sum += 1 / stepper_->particles().inverse_mass[i];
    return sum * squares_.supports.gravity.norm();
  }
  /// Kinetic, elastic and lost, of the blocks [J].
  Real energy() {
    const auto energies = squares_.forces->energy_parts(stepper_->particles());
    return stepper_->kinetic_energy() + energies.elastic + energies.lost();
  }
  fem::FemStepper<2>& fem() { return *fem_; }
  ContinuumSide<2>& continuum() { return *continuum_; }
  RectangleSide& bodies() { return *bodies_; }
  Real width() const { return width_; }

private:
  Real width_;
  std::unique_ptr<fem::FemStepper<2>> fem_;
  test::Scene squares_;
  std::unique_ptr<particles::UniformStepper<2>> stepper_;
  std::unique_ptr<RectangleSide> bodies_;
  std::unique_ptr<ContinuumSide<2>> continuum_;
};

/// What falls 0.5 mm onto a body that nothing holds.
test::CouplingScene fall(CouplingScheme scheme) {
  test::CouplingScene scene;
  scene.box = {{0.4, 0.2, 0.2}, {5, 2, 2}, 0};
  scene.youngs_modulus = scene.stiffness = 1e7;
  scene.held = scene.upright = scene.lumped = false;
  scene.friction = 0.3;
  scene.restitution = 0.5;
  scene.gravity = {2, -40, 0};
  scene.rules.width = 0.3;
  scene.rules.scheme = scheme;
  return scene;
}

TEST(rectangle_side, nodes_get_the_momentum_that_blocks_lose) {
  for (const CouplingScheme scheme : {CouplingScheme::lagged, CouplingScheme::impulse, CouplingScheme::iterative}) {
    BlocksOnTop sides(fall(scheme), 1e-3);
    sides.start();
    const Vector3 before = sides.momentum();
    sides.advance(12);
    const Vector3 weight = sides.weight() * Vector3(2, -40, 0).normalized();
    const Vector3 lost = before + 12e-3 * weight - sides.momentum();
    ASSERT_GT(sides.continuum().totals().given.norm(), 0.5);
    EXPECT_LT((lost - sides.continuum().totals().given).norm(), 1e-11 * lost.norm());
  }
}

TEST(rectangle_side, the_reaction_of_what_lies_still_is_its_weight) {
  test::CouplingScene scene = fall(CouplingScheme::impulse);
  scene.held = scene.upright = true;
  scene.gravity = {0, -9.81, 0};
  scene.alpha = -0.3;
  scene.youngs_modulus = 1e6;
  scene.stiffness = 1e5;
  BlocksOnTop sides(scene, 1e-3, false, false);
  sides.start();
  sides.advance(6000);
  EXPECT_NEAR(-sides.continuum().mean_force().y(), sides.weight(), 1e-6 * sides.weight());
  EXPECT_NEAR(sides.continuum().mean_force().x(), 0, 1e-6 * sides.weight());
}

TEST(rectangle_side, repeated_windows_make_no_energy) {
  test::CouplingScene scene = fall(CouplingScheme::iterative);
  scene.rules.tolerance = 1e-9;
  scene.friction = 0;
  scene.restitution = 1;
  BlocksOnTop sides(scene, 2e-4);
  sides.start();
  sides.advance(60);
  const auto& totals = sides.continuum().totals();
  EXPECT_GT(totals.energy_work_on_nodes, 1e-3);
  EXPECT_LT(std::abs(totals.made()), 1e-7 * totals.energy_work_on_nodes);
  EXPECT_GT(totals.passes, totals.windows);
}

test::MemoryArchive after(const test::CouplingScene& scene, int windows) {
  BlocksOnTop sides(scene, 1e-3);
  sides.start();
  sides.advance(windows);
  test::MemoryArchive archive;
  sides.columns(archive);
  return archive;
}

TEST(rectangle_side, goes_on_from_a_checkpoint_and_with_more_threads_as_if_nothing_had_been) {
  for (const CouplingScheme scheme : {CouplingScheme::impulse, CouplingScheme::iterative}) {
    auto checkpoint = after(fall(scheme), 7);
    checkpoint.turn_round();
    BlocksOnTop resumed(fall(scheme), 1e-3);
    resumed.columns(checkpoint);
    resumed.advance(6);
    test::MemoryArchive archive;
    resumed.columns(archive);
    parallel::set_threads(2);
    const auto whole = after(fall(scheme), 13);
    parallel::set_threads(1);
    EXPECT_TRUE(archive == whole);
  }
}

TEST(rectangle_side, takes_a_window_back_and_refuses_what_it_cannot_do) {
  BlocksOnTop sides(fall(CouplingScheme::impulse), 1e-3), once(fall(CouplingScheme::impulse), 1e-3, false);
  test::expect_windows_can_be_taken_back(sides, once, 5);
  coupling::SurfaceShape shape = sides.continuum().shape();
  shape.dimension = 3;
  EXPECT_THROW(sides.bodies().attach(shape), UserError);
}

}  // namespace
}  // namespace sazare::methods::hybrid
