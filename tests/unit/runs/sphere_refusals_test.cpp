#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sazare/methods/spheres/run/placing/file.hpp"
#include "sazare/registry/registry.hpp"
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
  return words_of<UserError>([&] { registry::check_case(case_of(folder, rest, settings)); });
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

TEST(sphere_refusals, a_box_of_random_places_thinner_than_a_sphere) {
  const TemporaryFolder folder;
  const std::string words = refused(folder, sphere("grains",
                                                   "source = \"random\"\nradius = 0.01\ncount = 3\nlower = [0.0, 0.0, 0.0]\n"
                                                   "upper = [0.08, 0.08, 0.012]\n"));
  EXPECT_SAYS(words, "error: the box of the group \"grains\" is 0.012 m along z, and its largest sphere 0.02 m wide");
}

/// Contacts without friction are asked for, not had by leaving a key out.
TEST(sphere_refusals, contacts_of_which_nobody_said_how_they_rub) {
  const TemporaryFolder folder;
  std::string text = head;
  const std::string friction = "friction_coefficient = 0.4\n";
  text.erase(text.find(friction), friction.size());
  EXPECT_SAYS(words_of<UserError>([&] { registry::read_case_text(text, folder / "case.toml"); }),
              "error: [contact] has neither friction_coefficient nor friction_angle\n");
}

TEST(sphere_refusals, a_row_that_begins_with_a_letter_below_the_titles) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& rows) {
    return refused(folder, sphere("a", "source = \"file\"\nfile = \"" + folder.write("a.csv", rows).string() + "\"\n"));
  };
  EXPECT_SAYS(with("radius,x,y,z\n0.005,0,0,0.01\nO.005,0.03,0,0.01\n"), "a.csv:3:1: radius: a number was expected");
  EXPECT_SAYS(with("# spheres\n0.005 0 0 0.01\nnan 0 0 5\n"), "a.csv:3:1: radius must be a finite number");
}

/// A field is one number and nothing else, whatever separates the fields, and titles are those of the columns.
TEST(sphere_refusals, files_of_spheres_that_could_be_misread) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& rows) {
    return refused(folder, sphere("a", "source = \"file\"\nfile = \"" + folder.write("a.csv", rows).string() + "\"\n"));
  };
  const std::string good = "0.005 0.01 0.01 0.01\n";
  for (const char* row : {"0,005 0 0 0.01", "0,5 1,2", "0.005 0 0 0.01 m", "0.005 0 0", "0.005\t0\t0\t0,01"})
    EXPECT_SAYS(with(good + row + "\n"), "a.csv:2: four numbers were expected") << row;
  for (const auto& [row, place] :
       {std::pair("1 234,0,0,0", "1: radius"), {"0.005,,0,0.01", "7: x"}, {"0.005;0,1;0;0.01", "7: x"}})
    EXPECT_SAYS(with(good + row + "\n"), fmt::format("a.csv:2:{}: a number was expected", place)) << row;
  EXPECT_SAYS(with("x y z radius\n" + good), "a.csv:1: four numbers were expected");
  EXPECT_SAYS(with("diameter,x,y,z\n" + good), "the titles of their columns are radius, x, y, z");
  EXPECT_SAYS(with("radius [mm],x [mm],y [mm],z [mm]\n" + good), "a.csv:1: the file says [mm], but lengths are read in m");
  EXPECT_SAYS(with("# radius, x, y, z (mm)\n" + good), "a.csv:1: the file says [mm]");
  EXPECT_SAYS(with(std::string("r\0a\0", 4)), "is not plain text");
}

TEST(sphere_refusals, files_of_spheres_of_any_system_are_read) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& rows) { return read_balls(folder.write("a.csv", rows)).size(); };
  EXPECT_EQ(read("\xef\xbb\xbfradius [m],x [m],y [m],z [m]\r\n0.005,0,0,0.01\r\n0.005,0.03,0,0.01\r\n"), 2);
  EXPECT_EQ(read("Radius;X;Y;Z\r0.005;0;0;0.01\r0.005;0.03;0;0.01"), 2);
  EXPECT_EQ(read("# radius x y z [m]\n\n 0.005\t0 0  0.01\n+5e-3 0.03 0 .01\n"), 2);
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
              "the normal has a component along x, and the domain is periodic along x");
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
  EXPECT_SAYS(words, "the falling spheres (rain = true) do not come to rest");
}

TEST(sphere_refusals, rows_of_a_file_that_are_no_spheres) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& rows) {
    return refused(folder, sphere("a", "source = \"file\"\nfile = \"" + folder.write("a.csv", rows).string() + "\"\n"));
  };
  EXPECT_SAYS(with("radius,x,y,z\n\n0.005,0,0,0.01\n-0.005,0.03,0,0.01\n"),
              "a.csv:4: a radius greater than 0 and a finite centre were expected, found -0.005 at (0.03, 0, 0.01)");
}

TEST(sphere_refusals, more_spheres_than_the_machine_can_hold) {
  const TemporaryFolder folder;
  const std::string box = "lower = [0.0, 0.0, 0.0]\nupper = [0.08, 0.08, 0.08]\n";
  const std::string fine = refused(folder, sphere("dust", "source = \"lattice\"\nradius = 1e-8\n" + box));
  EXPECT_SAYS(fine, "radius = 1e-8");
  EXPECT_SAYS(fine, "error: the group \"dust\" would have 64e18 spheres");
  EXPECT_SAYS(fine, "help: they need 22.4e12 GB, 350 bytes each, and this machine has");
  EXPECT_SAYS(fine, "a run has 536870911 at most: choose larger or fewer ones");
  const std::string shape = "[[shapes]]\nname = \"t\"\nheight = 1e-6\nleg_spheres = 2\n";
  EXPECT_SAYS(refused(folder, shape + sphere("dust", "shape = \"t\"\nsource = \"lattice\"\n" + box)),
              "the group \"dust\" would have");
  const std::string many = "[[shapes]]\nname = \"t\"\nheight = 1e-6\nleg_spheres = 11\n";
  EXPECT_SAYS(refused(folder, many + sphere("dust", "shape = \"t\"\nsource = \"random\"\ncount = 50000000\n" + box)),
              "the group \"dust\" would have 2.25e9 spheres");
}

TEST(sphere_refusals, a_rigid_shape_of_spheres_that_do_not_touch) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& rows) {
    return refused(folder, "[[shapes]]\nname = \"two\"\nsource = \"file\"\nfile = \"" + folder.write("two.csv", rows).string() +
                               "\"\n" + sphere("a", "shape = \"two\"\ncentre = [0.04, 0.04, 0.03]\n"));
  };
  const std::string words = with("radius,x,y,z\n0.005,0,0,0\n0.005,0.01,0,0\n0.005,0.03,0,0\n");
  EXPECT_SAYS(words, "error: the spheres of the rigid shape \"two\" do not all touch: that of two.csv:4 is not connected");
  EXPECT_SAYS(words, "spheres touch when their gap is at most 0.01 of the sum of their radii");
  EXPECT_EQ(with("0.005,0,0,0\n0.005,0.01005,0,0\n"), "");
}

/// Facets of four corners would be read as other triangles, and are refused where they stand.
TEST(sphere_refusals, a_surface_of_a_shape_that_is_no_solid) {
  const TemporaryFolder folder;
  const auto facet = [](const std::string& corners) {
    return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
  };
  const std::string a = "vertex 0 0 0\n", b = "vertex 0.02 0 0\n", c = "vertex 0 0.02 0\n", d = "vertex 0 0 0.02\n";
  const auto with = [&](const std::string& facets) {
    return refused(folder, "[[shapes]]\nname = \"stone\"\nsource = \"mesh\"\nfile = \"" +
                               folder.write("stone.stl", "solid s\n" + facets + "endsolid s\n").string() + "\"\n" +
                               sphere("a", "shape = \"stone\"\ncentre = [0.04, 0.04, 0.03]\n"));
  };
  EXPECT_EQ(with(facet(a + c + b) + facet(a + b + d) + facet(b + c + d) + facet(a + d + c)), "");
  EXPECT_SAYS(with(facet(a + c + b) + facet(a + b + d) + facet(b + c + d)),
              "the surface of the shape \"stone\" has holes: 3 edges do not belong to two triangles");
  EXPECT_SAYS(with(facet(a + c + b) + facet(a + b + d) + facet(b + c + d) + facet(a + c + d)),
              "the surface of the shape \"stone\" has triangles that are turned inside out, at 3 edges");
  EXPECT_SAYS(with(facet(a + b + c + d)), "stone.stl:7: a facet has four or more corners");
}

std::string facets(const std::vector<std::array<Vector3, 3>>& triangles) {
  std::string text = "solid s\n";
  for (const auto& triangle : triangles) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const Vector3& at : triangle) text += fmt::format("vertex {} {} {}\n", at.x(), at.y(), at.z());
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

/// A mesh wall across the domain of `sphere_cases`, between two places along x.
std::string plate(const TemporaryFolder& folder, Real from, Real to, Real height, const std::string& rest = "") {
  const Vector3 a(from, -1, height), b(to, -1, height), c(to, 1, height), d(from, 1, height);
  return "[[walls]]\nname = \"plate\"\nmaterial = \"glass\"\nshape = \"mesh\"\n" + rest + "file = \"" +
         folder.write("plate.stl", facets({{a, b, c}, {a, c, d}})).string() + "\"\n";
}

TEST(sphere_refusals, a_wall_that_turns_where_it_would_repeat_itself) {
  const TemporaryFolder folder;
  const std::string one = sphere("a", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\n");
  const std::string words = refused(folder, one + plate(folder, 0, 0.08, 0.06, "angular_velocity = [0.0, 0.0, 1.0]\n"));
  EXPECT_SAYS(words, "the wall \"plate\" turns across the periodic axis x, ends at its sides, and comes within 0.005 m of them");
  EXPECT_EQ(refused(folder, one + plate(folder, -0.01, 0.09, 0.06, "angular_velocity = [0.0, 0.0, 1.0]\n")), "");
}

TEST(sphere_refusals, check_tells_of_open_edges_and_of_walls_that_repeat_themselves) {
  const TemporaryFolder folder;
  const std::string one = sphere("a", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\n");
  const std::string words = registry::check_case(case_of(folder, one + plate(folder, 0, 0.078, 0.06)));
  EXPECT_SAYS(words, "\"plate\" has 4 open edges, of one triangle each: it ends there, or has holes");
  EXPECT_SAYS(words, "\"plate\" continues periodically along x, with a gap of 0.002 m");
  const std::string whole = registry::check_case(case_of(folder, one + plate(folder, 0, 0.08, 0.06)));
  EXPECT_SAYS(whole, "\"plate\" continues periodically along x\n");
}

TEST(sphere_refusals, a_sphere_that_goes_through_a_wall_ends_the_run) {
  const TemporaryFolder folder;
  const auto end_of = [&](const std::string& velocity, Real height) {
    const auto file =
        case_of(folder, sphere("shot", "radius = 0.005\ncentre = [0.04, 0.04, 0.1]\nvelocity = [0.0, 0.0, " + velocity + "]\n") +
                            plate(folder, -1, 1, height));
    return words_of<PhysicsError>([&] { carry_out(file, folder / ("run" + velocity)); });
  };
  EXPECT_EQ(end_of("-10.0", 0.06), "");
  const std::string soft = end_of("-40.0", 0.06);
  EXPECT_SAYS(soft, "sphere 1 of \"shot\" went through the wall \"plate\" at t = 0.00");
  EXPECT_SAYS(soft, "its centre is beyond the surface\n  its contact is too soft for its speed, or the step of");
  const std::string fast = end_of("-400.0", 50);
  EXPECT_SAYS(
      fast,
      "a sphere came 0.03361 m nearer to a wall in a step of 84.03e-6 s, so that it may have passed one of triangles unseen");
}

/// A dashpot that a step bears brakes a fast and soft impact less than is asked for.
TEST(sphere_refusals, a_restitution_that_the_step_cannot_give_is_told_of) {
  const TemporaryFolder folder;
  const auto check = [&](const std::string& speed, const std::vector<std::string>& settings = {}) {
    std::vector<std::string> all{"contact.restitution=0.1", "gravity.acceleration=[0.0, 0.0, 0.0]"};
    all.insert(all.end(), settings.begin(), settings.end());
    return registry::check_case(
        case_of(folder, sphere("ball", "radius = 0.005\ncentre = [0.04, 0.04, 0.02]\nvelocity = [0.0, 0.0, -" + speed + "]\n"), all));
  };
  const std::string fast = check("10.0");
  EXPECT_SAYS(fast, "the restitution between \"glass\" and \"glass\" will be 0.");
  EXPECT_SAYS(fast, "instead of 0.1 at 10 m/s (initial velocity 10 m/s), which this case may reach");
  const std::string proposed = "set time.stability_fraction = ";
  EXPECT_SAYS(fast, proposed);
  const std::string fraction = fast.substr(fast.find(proposed) + 4, fast.find(" for faster impacts") - fast.find(proposed) - 4);
  std::string setting = fraction;
  setting.erase(std::remove(setting.begin(), setting.end(), ' '), setting.end());
  EXPECT_EQ(check("10.0", {setting}).find("will be 0."), std::string::npos) << setting;
  EXPECT_EQ(words_of<UserError>([&] { check("10.0", {setting, "time.strict=true"}); }), "");
  EXPECT_SAYS(words_of<UserError>([&] { check("10.0", {"time.strict=true"}); }), "instead of 0.1");
}

TEST(sphere_refusals, energies_that_are_no_numbers_end_the_run) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, sphere("far", "radius = 0.005\ncentre = [0.04, 0.04, 1e308]\n"));
  const std::string words = words_of<PhysicsError>([&] { carry_out(file, folder / "run"); });
  EXPECT_SAYS(words, "a number of the case is too large or too small");
}

/// A pile that is pressed hard and walked with too long a step: its contacts do not bear it.
TEST(sphere_refusals, a_step_that_the_contacts_do_not_bear_is_told_of) {
  const TemporaryFolder folder;
  const std::string pile =
      sphere("pile", "source = \"lattice\"\nradius = 0.004\nlower = [0.0, 0.0, 0.0]\nupper = [0.08, 0.08, 0.06]\n"
                     "velocity = [0.0, 0.0, 0.0]\n");
  const auto words = [&](const std::string& fraction) {
    // With adhesion no restitution is asked for by which the case would be refused before.
    const auto file = case_of(folder, pile,
                              {"time.stability_fraction=" + fraction, "time.strict=true", "time.end=0.04",
                               "time.snapshot_interval=0.04", "contact.model=jkr", "contact.surface_energy=1e-6",
                               "gravity.acceleration=[0.0, 0.0, -500.0]"});
    return words_of<PhysicsError>([&] { carry_out(file, folder / ("run" + fraction)); });
  };
  EXPECT_EQ(words("0.2"), "");
  EXPECT_SAYS(words("0.9"), "times as much as is stable");
}

}  // namespace
}  // namespace sazare::runs
