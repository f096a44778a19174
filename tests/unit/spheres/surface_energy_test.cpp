/// An elastic ball without friction keeps its energy on any surface, and a rolling one feels no edges of a fine one.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "surfaces.hpp"

namespace sazare::methods::spheres {
namespace {

using geometry::Triangle;

constexpr Real radius = 0.01;  // of the ball [m]
const Vector3 gravity(0, 0, -9.81);

/// Kinetic energy and that of gravity and springs of the ball [J].
Real energy_of(const SphereStepper& stepper) {
  const auto& place = stepper.spheres().place[0];
  return 0.5 * place.mass * velocity_of(stepper, 0).squaredNorm() - place.mass * gravity.dot(centre_of(stepper, 0)) +
         stepper.energies().elastic;
}

/// A little above a surface.
Vector3 above(const Wall& wall, Real x, Real y) {
  const auto is_free = [&](const Vector3& centre) {
    return std::ranges::all_of(wall.triangles, [&](const Triangle& triangle) {
      return (geometry::nearest_point(triangle, centre) - centre).norm() > 1.01 * radius;
    });
  };
  Vector3 centre(x, y, 0.15);
  for (Real step = 0.5 * radius; step > 1e-4 * radius; step *= 0.5)
    while (is_free(centre - Vector3(0, 0, step))) centre.z() -= step;
  return centre;
}

/// The change of the energy over the kinetic one at the start, when a ball that was thrown down at a place has bounced.
Real change_of_energy(const Wall& wall, Real x, Real y, Real step = 5e-7) {
  const Vector3 velocity(-0.1, 0.07, -0.6);
  auto stepper = make_stepper({{.centre = above(wall, x, y), .velocity = velocity}}, {.step = step, .gravity = gravity}, {wall});
  stepper.start();
  stepper.evaluate_now();
  const Real before = energy_of(stepper), kinetic = 0.5 * stepper.spheres().place[0].mass * velocity.squaredNorm();
  const auto has_bounced = [&] { return stepper.contacts() == 0 && (velocity_of(stepper, 0) - velocity).norm() > 0.25; };
  for (int n = 0; n < 40 && !has_bounced(); ++n) advance(stepper, static_cast<int>(5e-4 / step));
  EXPECT_TRUE(has_bounced());
  return std::abs(energy_of(stepper) - before) / kinetic;
}

int cells_for(Real facet) { return std::clamp(static_cast<int>(2 * radius / facet) + 2, 3, 60); }

/// On concave and on convex edges, and on facets, of a surface that is made for an angle and the size of facets.
void expect_kept(const std::function<Wall(Real angle, Real facet)>& make, std::initializer_list<Real> angles) {
  for (const Real angle : angles)
    for (const Real size : {0.1, 1.0, 10.0}) {
      const Real facet = size * radius;
      const Wall wall = make(angle * degree, facet);
      for (const Real x : {0.01 * radius, facet * std::cos(0.5 * angle * degree) + 0.01 * radius})
        EXPECT_LT(change_of_energy(wall, x, 0.2 * radius), 1e-6) << angle << " degrees, " << size << " radii, x = " << x;
    }
}

TEST(surface_energy, is_kept_over_creases_and_ridges_of_any_angle_and_facets_of_any_size) {
  expect_kept([](Real angle, Real facet) { return surface(zigzag(angle, facet), cells_for(facet)); },
              {0.1, 1.0, 5.0, 20.0, 50.0, 90.0});
}

TEST(surface_energy, is_kept_in_troughs_and_on_ridges) {
  for (const Real sign : {1.0, -1.0})
    expect_kept([=](Real angle, Real facet) { return surface(trough(sign * angle, facet), cells_for(facet)); },
                {0.1, 1.0, 5.0, 20.0, 45.0, 90.0});
}

TEST(surface_energy, is_kept_on_saddles_and_in_bowls) {
  for (const Real other : {1.0, -1.0, 0.3})
    expect_kept([=](Real angle, Real facet) { return surface(bent(angle, facet, other), cells_for(facet)); },
                {0.1, 1.0, 5.0, 20.0});
}

TEST(surface_energy, is_kept_on_a_floor_in_two_walls) {
  Wall left = surface([](int i, int j) -> Vector3 { return 0.01 * Vector3(i - 4, j, 0); }, 4),
       right = surface([](int i, int j) -> Vector3 { return 0.008 * Vector3(i + 4, j, 0); }, 4);
  left.joined = right.joined = 0;
  for (const Real x : {-0.001, 0.0, 0.0005}) {
    auto on_walls = make_stepper({{.centre = {x, 0.003, 0.0099}}}, {}, {left, right}),
         on_plane = make_stepper({{.centre = {x, 0.003, 0.0099}}}, {}, {Wall{}});
    on_walls.start();
    on_plane.start();
    EXPECT_EQ(on_walls.load(0).fz, on_plane.load(0).fz) << x;
    EXPECT_NEAR(on_walls.load(0).fx, 0, 1e-15);
  }
}

TEST(surface_energy, a_plane_that_is_there_twice_counts_once_and_so_does_a_mesh_in_it) {
  Wall plane, again, mesh = surface([](int i, int j) -> Vector3 { return 0.01 * Vector3(i, j, 0); }, 4);
  again.point = Vector3(0.3, 0.1, 0);
  plane.joined = again.joined = mesh.joined = 3;
  auto on_all = make_stepper({{.centre = {0.001, 0, 0.0099}}}, {}, {mesh, again, plane}),
       on_one = make_stepper({{.centre = {0.001, 0, 0.0099}}}, {}, {Wall{}});
  on_all.start();
  on_one.start();
  EXPECT_EQ(on_all.load(0).fz, on_one.load(0).fz);
  mesh.joined = -1;
  auto on_others = make_stepper({{.centre = {0.001, 0, 0.0099}}}, {}, {mesh, plane});
  on_others.start();
  EXPECT_EQ(on_others.load(0).fz, 2 * on_one.load(0).fz) << "of another material or motion";
}

TEST(surface_energy, a_rolling_ball_feels_no_edge_of_a_fine_flat_mesh) {
  const Rules rules{.restitution = 0.5, .friction = 0.4, .rolling = 0.01, .step = 2e-6, .gravity = gravity};
  const auto roll = [&](const Wall& wall) {
    const Grain ball{.centre = {-0.02, 0.001, 0.01}, .velocity = {0.4, 0.05, 0}, .spin = {-5, 40, 0}};
    auto stepper = make_stepper({ball}, rules, {wall});
    stepper.start();
    advance(stepper, 40000);
    return stepper;
  };
  const auto on_plane = roll(Wall{});
  for (const Real size : {0.1, 0.5, 3.0}) {
    const auto on_mesh = roll(surface(
        [=](int i, int j) -> Vector3 { return size * radius * Vector3(i + 0.2 * j, j, 0); }, static_cast<int>(4 / size)));
    EXPECT_LT((velocity_of(on_mesh, 0) - velocity_of(on_plane, 0)).norm(), 1e-10) << size;
    EXPECT_LT((centre_of(on_mesh, 0) - centre_of(on_plane, 0)).norm(), 1e-12) << size;
  }
}

TEST(surface_energy, a_ball_that_rolls_down_a_fine_trough_is_as_fast_as_in_a_round_one) {
  // Its facets are that fine that the ball overlaps them by more than they deviate from the circle. Without slip
  // v^2 = 10/7 g (r - R)(1 - cos a), and the time down is that of a pendulum.
  const Real facet = 0.02 * radius, angle = 0.004, start = 0.3, round = facet / (2 * std::tan(0.5 * angle)), arm = round - radius;
  const Shape fine = trough(angle, facet);
  const Wall wall = surface([&](int i, int j) -> Vector3 { return fine(i, 100 * j); }, 90);
  auto stepper = make_stepper({{.centre = {arm * std::sin(start), 0.0002, round - arm * std::cos(start)}}},
                              {.friction = 0.5, .step = 1e-5, .gravity = gravity}, {wall});
  stepper.start();
  const Real period = 2 * std::numbers::pi * std::sqrt(7.0 / 5 * arm / 9.81) * (1 + start * start / 16);
  advance(stepper, static_cast<int>(0.25 * period / 1e-5));
  const Real fastest = std::sqrt(10.0 / 7 * 9.81 * arm * (1 - std::cos(start)));
  EXPECT_NEAR(velocity_of(stepper, 0).norm(), fastest, 2e-3 * fastest);
  EXPECT_NEAR(centre_of(stepper, 0).x(), 0, 5e-3 * arm * std::sin(start));
}

TEST(surface_energy, a_ball_rests_in_a_groove_on_both_sides_and_on_the_rim_of_a_hole) {
  const Rules rules{.restitution = 0.3, .friction = 0.3, .step = 5e-6, .gravity = gravity};
  const auto rest = [&](const Wall& wall, const Vector3& from) {
    auto stepper = make_stepper({{.centre = from}}, rules, {wall});
    stepper.start();
    advance(stepper, 60000);
    EXPECT_LT(velocity_of(stepper, 0).norm(), 1e-7);
    return centre_of(stepper, 0);
  };
  const Vector3 in_groove = rest(surface(zigzag(90 * degree, 0.05), 3), {0, 0.001, 0.0145});
  EXPECT_NEAR(in_groove.x(), 0, 1e-6);
  EXPECT_NEAR(in_groove.z(), 0.01 * std::numbers::sqrt2, 2e-5);
  constexpr int pieces = 64;
  Wall plate;
  const auto node = [](int n, Real away) -> Vector3 {
    return Vector3(away * std::cos(2 * std::numbers::pi * n / pieces), away * std::sin(2 * std::numbers::pi * n / pieces), 0);
  };
  for (int n = 0; n < pieces; ++n) {
    plate.triangles.push_back({node(n, 0.006), node(n, 0.03), node(n + 1, 0.03)});
    plate.triangles.push_back({node(n, 0.006), node(n + 1, 0.03), node(n + 1, 0.006)});
  }
  const Vector3 on_rim = rest(plate, {0.0001, 0.0002, 0.0081});
  EXPECT_NEAR(std::hypot(on_rim.x(), on_rim.y()), 0, 1e-5);
  EXPECT_NEAR(on_rim.z(), 0.008, 3e-5);
}

}  // namespace
}  // namespace sazare::methods::spheres
