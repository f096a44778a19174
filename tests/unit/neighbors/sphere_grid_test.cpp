#include "sazare/neighbors/sphere_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace sazare::neighbors {
namespace {

struct Ball {
  Vector3 centre;
  Real radius;
};

class RandomBalls {
public:
  explicit RandomBalls(unsigned seed) : random_(seed) {}

  Vector3 place() { return {number(-3, 3), number(-3, 3), number(-3, 3)}; }
  Real radius() { return std::exp(number(std::log(0.01), std::log(1.0))); }  // two decades
  Index item(Index count) { return static_cast<Index>(random_() % static_cast<unsigned>(count)); }
  Real number(Real from, Real to) { return std::uniform_real_distribution<Real>(from, to)(random_); }

private:
  std::mt19937_64 random_;
};

std::vector<Index> visited(const SphereGrid& grid, const Ball& around) {
  std::vector<Index> items;
  grid.visit_near(around.centre, around.radius, [&](Index item) { items.push_back(item); });
  std::ranges::sort(items);
  return items;
}

/// All that are near must be visited, nothing twice; some that are not near may be.
void expect_complete(const SphereGrid& grid, const std::map<Index, Ball>& balls, const Ball& around) {
  const auto items = visited(grid, around);
  EXPECT_EQ(std::ranges::adjacent_find(items), items.end()) << "visited twice";
  for (const Index item : items) EXPECT_TRUE(balls.contains(item)) << item << " was removed";
  for (const auto& [item, ball] : balls) {
    const bool near = (ball.centre - around.centre).norm() <= ball.radius + around.radius;
    EXPECT_TRUE(!near || std::ranges::binary_search(items, item)) << "missed " << item;
  }
}

TEST(sphere_grid, finds_what_brute_force_finds_while_spheres_come_move_and_go) {
  RandomBalls random(5);
  SphereGrid grid;
  std::map<Index, Ball> balls;
  for (int round = 0; round < 4000; ++round) {
    const Index item = random.item(300);
    if (balls.contains(item) && random.number(0, 1) < 0.3) {
      grid.remove(item);
      balls.erase(item);
    } else {
      balls[item] = {random.place(), random.radius()};
      grid.place(item, balls[item].centre, balls[item].radius);
    }
    if (round % 10 == 0) expect_complete(grid, balls, {random.place(), random.radius()});
  }
}

TEST(sphere_grid, visits_few_that_are_far) {
  RandomBalls random(6);
  SphereGrid grid;
  for (Index item = 0; item < 2000; ++item) grid.place(item, random.place(), 0.05);
  std::size_t total = 0;
  for (int query = 0; query < 100; ++query) total += visited(grid, {random.place(), 0.05}).size();
  EXPECT_LT(total, 100u * 20u);  // of 2000 each; a cube of three cells a side holds seven
}

TEST(sphere_grid, one_that_is_huge_against_the_others_walks_over_what_is_there) {
  SphereGrid grid;
  for (Index item = 0; item < 100; ++item) grid.place(item, {0.1 * item, 0, 0}, 1e-6);
  EXPECT_EQ(visited(grid, {{0, 0, 0}, 1e3}).size(), 100);
  EXPECT_EQ(visited(grid, {{0, 0, 0}, 1.05}).size(), 11);
  grid.place(100, {1e308, 0, 0}, 1e-6);
  EXPECT_EQ(visited(grid, {{1e308, 0, 0}, 1}), std::vector<Index>{100});
}

TEST(sphere_grid, a_small_move_within_a_cell_changes_nothing) {
  SphereGrid grid;
  grid.place(0, {0.1, 0.1, 0.1}, 0.2);
  grid.place(0, {0.11, 0.1, 0.1}, 0.2);
  EXPECT_EQ(visited(grid, {{0.1, 0.1, 0.1}, 0.01}), std::vector<Index>{0});
  grid.place(0, {5, 0.1, 0.1}, 0.2);
  EXPECT_TRUE(visited(grid, {{0.1, 0.1, 0.1}, 0.01}).empty());
  grid.remove(0);
  grid.remove(0);  // twice does no harm
  EXPECT_TRUE(visited(grid, {{5, 0.1, 0.1}, 0.01}).empty());
}

}  // namespace
}  // namespace sazare::neighbors
