#include <gtest/gtest.h>

#include <cmath>

#include "sazare/core/error.hpp"
#include "sazare/methods/hybrid/body_side.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/two_sides.hpp"

namespace sazare::methods::hybrid {
namespace {

using geometry::ElementShape;

/// Balls that hit a body that nothing holds.
template <int D>
test::CouplingScene collision(ElementShape shape, CouplingScheme scheme) {
  test::CouplingScene scene;
  scene.shape = shape;
  scene.box = {{0.4, D == 2 ? 0.2 : 0.4, 0.2}, {3, D == 2 ? 2 : 3, 2}, 0};
  scene.youngs_modulus = 1e7;
  scene.held = scene.upright = scene.lumped = false;
  scene.friction = 0.3;
  scene.rolling = 0.05;
  scene.rules.width = 0.3;
  scene.rules.scheme = scheme;
  const Real top = 0.2 + scene.radius;
  for (const Real x : {0.11, 0.27}) {
    test::Ball ball{Vector3(x, 0.13, top + 0.01 * x), Vector3(0.4, 0.3, -1), Vector3(3, -8, 5)};
    if (D == 2) {
      std::swap(ball.centre.y(), ball.centre.z());
      std::swap(ball.velocity.y(), ball.velocity.z());
    }
    scene.balls.push_back(ball);
  }
  return scene;
}

template <int D>
void expect_momentum_kept(ElementShape shape, CouplingScheme scheme) {
  test::TwoSides<D> sides(collision<D>(shape, scheme), 1e-3);
  sides.start();
  const Vector3 balls_before = sides.balls().momentum(), body_before = sides.momentum();
  sides.advance(12);
  const auto& totals = sides.continuum().totals();
  Vector3 lost = balls_before - sides.balls().momentum();
  if (D == 2) lost.z() = 0;  // held by the plane strain
  const Vector3 gained = sides.momentum() - body_before;
  ASSERT_GT(totals.given.norm(), 0.5);
  EXPECT_LT((lost - totals.given).norm(), 1e-12 * lost.norm()) << test::name_of(shape);
  EXPECT_LT((gained - totals.taken).norm(), 1e-9 * gained.norm()) << test::name_of(shape);
}

TEST(surface, windows_are_whole_numbers_of_steps) {
  WindowCourse course;
  const auto words = [&](Real window) {
    coupling::SurfaceShape shape;
    shape.window = window;
    return test::words_of<UserError>([&] { course.open(shape, 1e-3, "spheres"); });
  };
  EXPECT_EQ(words(5e-3), "");
  EXPECT_EQ(course.steps(), 5);
  EXPECT_NE(words(5.5e-3).find("must be a whole number of them"), std::string::npos);
  EXPECT_NE(words(1e-4).find("must be a whole number of them"), std::string::npos);
  EXPECT_NE(words(1e20).find("must be a whole number of them"), std::string::npos) << "of steps that nobody can count";
}

TEST(surface, nodes_get_the_momentum_that_bodies_lose) {
  for (const CouplingScheme scheme :
       {CouplingScheme::automatic, CouplingScheme::lagged, CouplingScheme::impulse, CouplingScheme::iterative}) {
    expect_momentum_kept<2>(ElementShape::quadrilateral8, scheme);
    expect_momentum_kept<3>(ElementShape::hexahedron20, scheme);
    expect_momentum_kept<3>(ElementShape::tetrahedron4, scheme);
  }
}

TEST(surface, what_is_under_way_is_the_impulse_of_the_last_window) {
  test::TwoSides<2> sides(collision<2>(ElementShape::quadrilateral4, CouplingScheme::impulse), 1e-3);
  sides.start();
  for (int window = 0; window < 15; ++window) {
    sides.advance(1);
    const auto& side = sides.continuum();
    EXPECT_LT((side.totals().under_way() - 1e-3 * side.mean_force()).norm(), 1e-13 * (1 + side.totals().given.norm()));
  }
  EXPECT_EQ(sides.balls().contacts(), 0);
  EXPECT_LT(sides.continuum().totals().under_way().norm(), 1e-12);
}

TEST(surface, repeated_windows_keep_energy_and_leave_nothing_under_way) {
  test::CouplingScene scene = collision<2>(ElementShape::quadrilateral4, CouplingScheme::iterative);
  scene.friction = scene.rolling = 0;
  scene.rules.tolerance = 1e-10;
  test::TwoSides<2> sides(scene, 2e-4);
  sides.start();
  sides.advance(80);
  const auto& totals = sides.continuum().totals();
  EXPECT_EQ(sides.balls().contacts(), 0);
  EXPECT_GT(totals.energy_work_on_nodes, 0.01);
  EXPECT_LT(std::abs(totals.made()), 1e-9 * totals.energy_work_on_nodes);
  EXPECT_LT(totals.under_way().norm(), 1e-9 * totals.given.norm());
  EXPECT_NEAR(sides.fem().energy_residual() * sides.width(), 0, 1e-9);
  EXPECT_LT(static_cast<Real>(totals.passes), 8.0 * static_cast<Real>(totals.windows));
}

TEST(surface, the_energy_balance_of_the_finite_elements_closes_with_lagged_forces) {
  for (const Real alpha : {0.0, -0.1}) {
    test::CouplingScene scene = collision<2>(ElementShape::quadrilateral4, CouplingScheme::impulse);
    scene.alpha = alpha;
    test::TwoSides<2> sides(scene, 1e-3);
    sides.start();
    sides.advance(15);
    const Real work = sides.fem().work().loads;
    EXPECT_NEAR(work * sides.width(), sides.continuum().totals().energy_work_on_nodes, 1e-12);
    if (alpha == 0) {
      EXPECT_NEAR(sides.fem().energy_residual(), 0, 1e-10 * work);
    }
  }
}

/// Everything that both sides know after some windows.
template <int D>
test::MemoryArchive after(const test::CouplingScene& scene, int windows) {
  test::TwoSides<D> sides(scene, 1e-3);
  sides.start();
  sides.advance(windows);
  test::MemoryArchive archive;
  sides.columns(archive);
  return archive;
}

TEST(surface, gives_the_same_bits_on_any_number_of_threads) {
  const auto scene = collision<3>(ElementShape::hexahedron8, CouplingScheme::iterative);
  const auto alone = after<3>(scene, 12);
  parallel::set_threads(3);
  const auto shared = after<3>(scene, 12);
  parallel::set_threads(1);
  EXPECT_TRUE(alone == shared);
}

TEST(surface, goes_on_from_a_checkpoint_as_if_nothing_had_been) {
  for (const CouplingScheme scheme : {CouplingScheme::automatic, CouplingScheme::impulse, CouplingScheme::iterative}) {
    const auto scene = collision<2>(ElementShape::quadrilateral8, scheme);
    auto checkpoint = after<2>(scene, 7);
    checkpoint.turn_round();
    test::TwoSides<2> resumed(scene, 1e-3);
    resumed.resume(checkpoint);
    resumed.advance(6);
    test::MemoryArchive archive;
    resumed.columns(archive);
    EXPECT_TRUE(archive == after<2>(scene, 13));
  }
}

TEST(surface, refuses_windows_and_places_that_do_not_fit) {
  test::CouplingScene scene = collision<2>(ElementShape::quadrilateral4, CouplingScheme::impulse);
  test::TwoSides<2> sides(scene, 1e-3);
  SphereSide bodies(sides.balls(), 0);
  coupling::SurfaceShape shape = sides.continuum().shape();
  shape.window = 1.33e-3;
  EXPECT_THROW(bodies.attach(shape), UserError);
  shape.window = 1e-3;
  for (Real& place : shape.nodes) place += 10;
  EXPECT_THROW(bodies.attach(shape), UserError);
}

/// Where the passes do not suffice the automatic scheme takes the best of them, and no impulse is lost.
TEST(surface, the_automatic_scheme_goes_on_with_the_best_pass) {
  test::CouplingScene scene = collision<2>(ElementShape::quadrilateral4, CouplingScheme::automatic);
  scene.rules.most_passes = 1;
  test::TwoSides<2> sides(scene, 1e-3);
  sides.start();
  const Vector3 before = sides.balls().momentum();
  sides.advance(12);
  const auto& totals = sides.continuum().totals();
  EXPECT_GT(totals.unconverged, 0);
  EXPECT_EQ(totals.windows, 12);
  Vector3 lost = before - sides.balls().momentum();
  lost.z() = 0;  // held by the plane strain
  EXPECT_LT((lost - totals.given).norm(), 1e-12 * lost.norm());
}

TEST(surface, says_what_was_tried_where_force_and_motion_do_not_agree) {
  test::CouplingScene scene = collision<2>(ElementShape::quadrilateral4, CouplingScheme::iterative);
  scene.rules.most_passes = 2;
  scene.rules.tolerance = 1e-13;
  test::TwoSides<2> sides(scene, 1e-3);
  sides.start();
  try {
    sides.advance(12);
    FAIL();
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("2 passes through the window"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sazare::methods::hybrid
