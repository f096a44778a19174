#include <gtest/gtest.h>

#include "tests/unit/runs/sphere_cases.hpp"

namespace sazare::runs {
namespace {

using namespace sphere_cases;
using test::TemporaryFolder;
using test::words_of;

std::string sphere(const std::string& name, const std::string& rest) {
  return "[[spheres]]\nname = \"" + name + "\"\nmaterial = \"glass\"\n" + rest;
}

/// What is said of a case where it is read and built.
std::string refused(const TemporaryFolder& folder, const std::string& rest, const std::vector<std::string>& settings = {}) {
  return words_of<UserError>([&] { check_case(case_of(folder, rest, settings)); });
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

TEST(sphere_refusals, a_box_of_random_places_thinner_than_a_sphere) {
  const TemporaryFolder folder;
  const std::string words = refused(folder, sphere("grains",
                                                   "source = \"random\"\nradius = 0.01\ncount = 3\nlower = [0.0, 0.0, 0.0]\n"
                                                   "upper = [0.08, 0.08, 0.012]\n"));
  EXPECT_SAYS(words, "error: the box of the group \"grains\" is 0.012 m along z, and its largest sphere 0.02 m wide");
}

TEST(sphere_refusals, a_row_that_begins_with_a_letter_below_the_titles) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& rows) {
    return refused(folder, sphere("a", "source = \"file\"\nfile = \"" + folder.write("a.csv", rows).string() + "\"\n"));
  };
  EXPECT_SAYS(with("radius,x,y,z\n0.005,0,0,0.01\nO.005,0.03,0,0.01\n"), "a.csv:3: four numbers were expected");
  EXPECT_SAYS(with("# spheres\n0.005 0 0 0.01\nnan 0 0 5\n"), "a.csv:3: four numbers were expected");
}

TEST(sphere_refusals, a_body_that_would_meet_itself_through_a_periodic_side) {
  const TemporaryFolder folder;
  const std::string bar =
      "[[shapes]]\nname = \"bar\"\nsource = \"file\"\nfile = \"" +
      folder.write("bar.csv", "0.01 0 0 0\n0.01 0.015 0 0\n0.01 0.03 0 0\n0.01 0.045 0 0\n0.01 0.06 0 0\n").string() + "\"\n";
  const std::string words = refused(folder, bar + sphere("a", "shape = \"bar\"\ncentre = [0.04, 0.04, 0.2]\n"));
  EXPECT_SAYS(words, "a body of the shape \"bar\" may be 0.08");
}

TEST(sphere_refusals, walls_that_do_not_repeat_themselves_in_a_periodic_room) {
  const TemporaryFolder folder;
  const std::string one = sphere("a", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\n");
  EXPECT_SAYS(refused(folder, one, {"walls.0.normal=[1.0, 0.0, 1.0]"}),
              "the normal has a part along x, and the room repeats itself");
  EXPECT_SAYS(refused(folder, one + "[[walls]]\nname = \"box\"\nmaterial = \"glass\"\nshape = \"box\"\nlower = [0.0, 0.0, 0.0]\n"
                                    "upper = [0.08, 0.08, 0.2]\n"),
              "a box has walls across the periodic axis x");
}

TEST(sphere_refusals, spheres_that_begin_within_a_wall_are_named) {
  const TemporaryFolder folder;
  const std::string one = sphere("a", "radius = 0.005\ncentre = [0.04, 0.04, 0.002]\n");
  EXPECT_SAYS(refused(folder, one),
              "1 spheres begin within the wall \"floor\", by 0.6 of their radius or less: sphere 1 of \"a\" at");
  const std::string mesh = "[[walls]]\nname = \"chute\"\nmaterial = \"glass\"\nshape = \"mesh\"\nfile = \"" +
                           folder
                               .write("chute.stl",
                                      "solid s\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0.05\nvertex 1 -1 0.05\n"
                                      "vertex 0 1 0.05\nendloop\nendfacet\nendsolid s\n")
                               .string() +
                           "\"\n";
  const std::string within = refused(folder, mesh + sphere("b", "radius = 0.005\ncentre = [0.04, 0.04, 0.0515]\n"));
  EXPECT_SAYS(within, "1 spheres begin within the wall \"chute\", by 0.7 of their radius or less: sphere 1 of \"b\" at");
}

TEST(sphere_refusals, a_bond_between_spheres_at_one_place) {
  const TemporaryFolder folder;
  const std::string two = sphere("a", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\n") +
                          sphere("b", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\n") +
                          "[[bonds]]\nname = \"cement\"\nbetween = [\"a\", \"b\"]\nyoungs_modulus = 1e7\npoisson_ratio = 0.2\n"
                          "reach = 2.0\n";
  EXPECT_SAYS(refused(folder, two), "two spheres stand at one place, (0.04, 0.04, 0.02)");
}

TEST(sphere_refusals, rain_without_ground_ends_soon) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, sphere("a", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\nrain = true\n"),
                            {"walls.0.normal=[0.0, 0.0, -1.0]", "walls.0.point=[0.0, 0.0, 1.0]"});
  const std::string words = words_of<PhysicsError>([&] { carry_out(file, folder / "run"); });
  EXPECT_SAYS(words, "what rains does not come to rest");
}

}  // namespace
}  // namespace sazare::runs
