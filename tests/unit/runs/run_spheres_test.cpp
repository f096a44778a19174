#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>

#include "sazare/core/error.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/methods/spheres/run/walls.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/sphere_cases.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using namespace sphere_cases;
using test::read_manifest, test::read_text, test::TemporaryFolder, test::words_of;

const char* scattered = R"([[spheres]]
name = "grains"
material = "glass"
source = "random"
radius = 0.003
largest_radius = 0.005
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.2]
count = 500
[[gauges]]
name = "all of them"
group = "grains"
)";

/// A block that falls and breaks.
const char* bonded = R"([[spheres]]
name = "block"
material = "glass"
source = "lattice"
radius = 0.004
lower = [0.01, 0.01, 0.001]
upper = [0.06, 0.06, 0.051]
velocity = [0.0, 0.5, -2.0]
angular_velocity = [0.0, 5.0, 0.0]
[[bonds]]
name = "cement"
between = ["block", "block"]
bond_normal_stiffness = 1e9
bond_shear_stiffness = 5e8
tensile_strength = 2e4
cohesion = 2e4
friction_angle = 30.0
fracture_energy = 0.5
damping_ratio = 0.05
[[gauges]]
name = "block"
group = "block"
)";

/// Grains and tetrapods that rest at the start, and a ball above that falls into them.
const char* rained = R"([[shapes]]
name = "tetrapod"
height = 0.02
leg_spheres = 2
[[spheres]]
name = "bed"
material = "glass"
source = "random"
radius = 0.005
lower = [0.0, 0.0, 0.0]
upper = [0.08, 0.08, 0.03]
count = 100
rain = true
[[spheres]]
name = "armour"
material = "glass"
source = "random"
shape = "tetrapod"
random_rotation = true
lower = [0.0, 0.0, 0.03]
upper = [0.08, 0.08, 0.06]
count = 5
rain = true
[[spheres]]
name = "ball"
material = "glass"
centre = [0.04, 0.04, 0.1]
radius = 0.008
velocity = [0.0, 0.0, -1.0]
[[gauges]]
name = "bed"
group = "bed"
[[gauges]]
name = "armour"
group = "armour"
[[gauges]]
name = "ball"
group = "ball"
)";

std::string refused(const std::string& rest, const std::vector<std::string>& settings = {}) {
  const TemporaryFolder folder;
  return words_of<UserError>([&] { registry::check_case(case_of(folder, rest, settings)); });
}

TEST(run_spheres, writes_its_folder_and_its_figures) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, scattered, {"time.stability_fraction=0.05"});
  carry_out(file, folder / "run");
  const nlohmann::json manifest = read_manifest(folder / "run");
  EXPECT_EQ(manifest["method"], "spheres");
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["results"]["particles"], 500);
  EXPECT_GT(manifest["results"]["contacts"], 500);
  EXPECT_LT(std::abs(manifest["results"]["energy_residual"].get<double>()),
            1e-3 * manifest["results"]["energy_lost"].get<double>());
  EXPECT_TRUE(fs::exists(folder / "run/snapshots/particles_00002.vtkhdf"));
  EXPECT_TRUE(read_text(folder / "run/gauges.csv").starts_with("time [s],all of them.position_x [m],"));
  EXPECT_TRUE(read_text(folder / "run/walls.csv").starts_with("time [s],floor.force_x [N],"));
  const cases::CaseFile again = registry::read_case(folder / "run/case.toml");
  carry_out(again, folder / "again");
  EXPECT_EQ(read_manifest(folder / "again")["state_hash"], manifest["state_hash"]);
}

void expect_the_same_in_parts(const TemporaryFolder& folder, const cases::CaseFile& file) {
  test::run_in_parts(file, folder / "parts", test::run_whole(file, folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  for (const char* table : {"gauges.csv", "walls.csv"})
    EXPECT_EQ(read_text(folder / "whole" / table), read_text(folder / "parts" / table));
}

class InParts : public testing::TestWithParam<const char*> {};

TEST_P(InParts, gives_the_bits_of_one_run) {
  const TemporaryFolder folder;
  expect_the_same_in_parts(folder, case_of(folder, GetParam()));
}

/// Bands of pairs, of planes and of spheres at several levels, which begin and end in any part.
TEST(run_spheres, gives_the_bits_of_one_run_with_contacts_that_slip_in_part) {
  for (const char* rest : {scattered, mixed}) {
    const TemporaryFolder folder;
    expect_the_same_in_parts(folder, case_of(folder, rest, {"contact.model=mindlin_deresiewicz"}));
  }
}

/// A floor of strips that ends at the sides of the room, which grains cross in any part.
TEST(run_spheres, gives_the_bits_of_one_run_on_a_wall_that_repeats_itself) {
  const TemporaryFolder folder;
  std::string strips = "solid strips\n";
  const auto add = [&](const std::string& a, const std::string& b, const std::string& c) {
    strips += "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  for (const char* x : {"0.00", "0.02", "0.04", "0.06"}) {
    const std::string from = x, to = fmt::format("{}", std::stod(x) + 0.02);
    add(from + " 0 0.01", to + " 0 0.01", to + " 0.08 0.01");
    add(from + " 0 0.01", to + " 0.08 0.01", from + " 0.08 0.01");
  }
  const std::string wall = "[[walls]]\nname = \"strips\"\nmaterial = \"glass\"\nshape = \"mesh\"\nfile = \"" +
                           folder.write("strips.stl", strips + "endsolid strips\n").string() + "\"\n";
  expect_the_same_in_parts(
      folder, case_of(folder, scattered + wall, {"spheres.0.lower=[0.0, 0.0, 0.011]", "spheres.0.velocity=[0.5, 0.3, 0.0]"}));
}

TEST(run_spheres, walls_of_one_material_and_one_motion_are_one_surface) {
  const TemporaryFolder folder;
  const auto wall = [](const std::string& name, const std::string& material, const std::string& more) {
    return "[[walls]]\nname = \"" + name + "\"\nmaterial = \"" + material +
           "\"\npoint = [0.0, 0.0, -0.1]\nnormal = [0.0, 0.0, 1.0]\n" + more;
  };
  const std::string steel = R"([[materials]]
name = "steel"
density = 7800.0
youngs_modulus = 2e11
poisson_ratio = 0.3
[[motions]]
name = "up"
type = "sine"
quantity = "displacement"
amplitude = 1e-3
frequency = 1.0
cycles = 1.0
)";
  const std::string walls = wall("again", "glass", "") + wall("of steel", "steel", "") +
                            wall("turning", "glass", "angular_velocity = [0.0, 0.0, 1.0]\n") +
                            wall("moving", "glass", "motion_z = \"up\"\n") + wall("with it", "glass", "motion_z = \"up\"\n");
  const auto file = case_of(folder, scattered + steel + walls);
  const CaseWalls made = make_walls(file, place_spheres(file));
  std::vector<Index> joined;
  for (const auto& one : made.walls) joined.push_back(one.joined);
  EXPECT_EQ(joined, (std::vector<Index>{0, 0, 2, 3, 4, 4}));
}

INSTANTIATE_TEST_SUITE_P(run_spheres, InParts, testing::Values(scattered, bonded, tetrapods, brittle, rained, mixed));

TEST(run_spheres, what_rains_rests_at_the_start_and_all_else_has_waited) {
  const TemporaryFolder folder;
  carry_out(case_of(folder, rained, {"time.end=0.02", "time.snapshot_interval=0.02"}), folder / "run");
  const auto start = rows_of(folder / "run/history.csv").front(), gauges = rows_of(folder / "run/gauges.csv").front();
  const Real ball = 2500 * 4.18879 * 0.008 * 0.008 * 0.008;
  EXPECT_NEAR(start.at("energy_translation"), 0.5 * ball, 1e-6 * ball);
  EXPECT_EQ(start.at("energy_rotation"), 0);
  EXPECT_GT(start.at("energy_tangential"), 0);
  EXPECT_EQ(start.at("energy_friction"), 0);
  EXPECT_EQ(gauges.at("ball.position_z"), 0.1);
  EXPECT_EQ(gauges.at("ball.velocity_z"), -1);
  EXPECT_LT(gauges.at("bed.position_z"), 0.012);  // from 0.015; tetrapods, which began at 0.045, lie on it
  EXPECT_LT(gauges.at("armour.position_z"), 0.035);
  EXPECT_LT(std::abs(read_manifest(folder / "run")["results"]["energy_residual"].get<double>()), 1e-3 * ball);
}

TEST(run_spheres, rain_stays_as_it_lies) {
  const TemporaryFolder folder;
  carry_out(case_of(folder, rained, {"spheres.2.held=true", "spheres.2.velocity=[0.0, 0.0, 0.0]"}), folder / "run");
  const auto rows = rows_of(folder / "run/gauges.csv");
  for (const char* place : {"bed.position_x", "bed.position_z", "armour.position_z"})
    EXPECT_NEAR(rows.back().at(place), rows.front().at(place), 1e-6) << place;
}

TEST(run_spheres, rain_stops_when_asked) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  const RunOutcome outcome = carry_out(case_of(folder, rained), folder / "run", Begin::fresh, &stop);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.manifest.status, "stopped");
}

TEST(run_spheres, a_bonded_block_breaks_and_energy_balances) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, bonded, {"time.end=0.05", "time.snapshot_interval=0.05", "time.stability_fraction=0.1"});
  carry_out(file, folder / "run");
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_EQ(results["bonds"], 540);
  EXPECT_GT(results["broken_bonds"], 10);
  EXPECT_LT(std::abs(results["energy_residual"].get<double>()), 1e-2 * results["energy_lost"].get<double>());
  EXPECT_TRUE(read_text(folder / "run/history.csv").find(",energy_bonds [J],energy_bond_dashpot [J],energy_fracture [J],") !=
              std::string::npos);
}

TEST(run_spheres, tetrapods_come_with_the_mass_of_their_union) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, tetrapods);
  const SpheresModel model = build_spheres(file);
  ASSERT_EQ(model.clumps, 20);
  EXPECT_EQ(model.group.size(), 20 * 9);
  const state::Clump& one = model.stepper->clumps().clumps.front();
  EXPECT_NEAR(one.mass, 2500 * one.volume, 1e-12);
  EXPECT_GT(one.volume, 0.7 * 0.280 * 8e-6);
  EXPECT_LT(one.volume, 0.280 * 8e-6);
  EXPECT_NE(registry::check_case(file).find("clumps      20 rigid"), std::string::npos);
  carry_out(case_of(folder, tetrapods, {"time.end=0.05", "time.snapshot_interval=0.05"}), folder / "run");
  EXPECT_EQ(read_manifest(folder / "run")["results"]["clumps"], 20);
}

/// A shape from a file has its centre of mass where the case puts it, whatever its own origin.
TEST(run_spheres, shapes_are_placed_by_their_centre_of_mass) {
  const TemporaryFolder folder;
  const std::string shape = "[[shapes]]\nname = \"bar\"\nsource = \"file\"\nscale = 0.001\nfile = \"" +
                            folder.write("bar.txt", "2 10 0 0\n2 12 0 0\n2 14 0 0\n").string() + "\"\n";
  const auto file = case_of(folder, shape + R"([[spheres]]
name = "a"
material = "glass"
shape = "bar"
centre = [0.03, 0.03, 0.03]
rotation = [0.0, 1.5707963267948966, 0.0]
angular_velocity = [0.0, 0.0, 2.0]
)");
  const Placement placement = place_spheres(file);
  EXPECT_LT((placement.spheres.place[1].centre() - Vector3(0.03, 0.03, 0.03)).norm(), 1e-8);
  EXPECT_LT((placement.spheres.place[2].centre() - Vector3(0.03, 0.03, 0.028)).norm(), 1e-8);  // x of the file is -z now
  const state::Clump& clump = placement.clumps.clumps.front();
  const Vector3 spin = clump.spin_of(clump.angular_momentum);
  EXPECT_NEAR(spin[2], 2, 1e-9);
  EXPECT_NEAR(spin[0], 0, 1e-9);
}

TEST(run_spheres, says_what_is_wrong_with_bonds_and_shapes) {
  const std::string weak = refused(bonded, {"bonds.0.fracture_energy=0.01"});
  EXPECT_NE(weak.find("error: fracture_energy 0.01 N/m is less than a bond of length 0.008 m holds when it begins to fail"),
            std::string::npos)
      << weak;
  EXPECT_NE(weak.find("give 0.2001 N/m or more"), std::string::npos) << weak;
  const std::string apart = refused(bonded, {"spheres.0.spacing=0.0082"});
  EXPECT_NE(apart.find("error: the bonds \"cement\" join no spheres"), std::string::npos) << apart;
  const TemporaryFolder folder;
  const auto shape = [&](const std::string& source, const std::string& name) {
    return "[[shapes]]\nname = \"s\"\nsource = \"" + source + "\"\nfile = \"" + name +
           "\"\n[[spheres]]\nname = \"a\"\nmaterial = \"glass\"\nshape = \"s\"\ncentre = [0.0, 0.0, 1.0]\n";
  };
  const std::string empty = refused(shape("file", folder.write("none.txt", "# nothing\n").string()));
  EXPECT_NE(empty.find("error: the shape \"s\" has no sphere"), std::string::npos) << empty;
  const std::string cement = "[[bonds]]\nname = \"cement\"\nbond_normal_stiffness = 1e9\nbond_shear_stiffness = 1e9\n";
  const std::string apart_within = refused(shape("file", folder.write("two.txt", "0.1 0 0 0\n0.1 0.3 0 0\n").string()) + cement,
                                           {"shapes.0.bonds=\"cement\""});
  EXPECT_NE(apart_within.find("error: the spheres of the shape \"s\" are not all connected by bonds"), std::string::npos)
      << apart_within;
  const std::string unused =
      refused(std::string(scattered) + cement + "[[shapes]]\nname = \"s\"\nheight = 0.1\nbonds = \"cement\"\n");
  EXPECT_NE(unused.find("error: the bonds \"cement\" join no spheres"), std::string::npos) << unused;
  EXPECT_NE(unused.find("no group is of a shape that names them"), std::string::npos) << unused;
  const std::string open = refused(shape("mesh", folder
                                                     .write("open.stl",
                                                            "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                                                            "0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n")
                                                     .string()));
  EXPECT_NE(open.find("error: the surface of the shape \"s\" has holes"), std::string::npos) << open;
}

TEST(run_spheres, places_lattices_in_the_middle_of_their_box) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, R"([[spheres]]
name = "a"
material = "glass"
source = "lattice"
radius = 0.005
lower = [0.0, 0.0, 0.0]
upper = [0.034, 0.02, 0.011]
)");
  const Placement placement = place_spheres(file);
  ASSERT_EQ(placement.spheres.size(), 6);
  EXPECT_LT((placement.spheres.place[0].centre() - Vector3(0.007, 0.005, 0.0055)).norm(), 1e-12);
}

/// One on the floor, one on its shoulder across the periodic side, and a bar, upright, on both.
TEST(run_spheres, lowers_bodies_until_they_touch) {
  const TemporaryFolder folder;
  const std::string shape = "[[shapes]]\nname = \"bar\"\nsource = \"file\"\nfile = \"" +
                            folder.write("bar.txt", "0.005 0 0 0\n0.005 0.008 0 0\n0.005 0.016 0 0\n").string() + "\"\n";
  const auto group = [](const std::string& name, const std::string& rest) {
    return "[[spheres]]\nname = \"" + name + "\"\nmaterial = \"glass\"\nlowered = true\n" + rest;
  };
  const auto file = case_of(folder, shape + group("first", "radius = 0.005\ncentre = [0.001, 0.02, 0.5]\n") +
                                        group("second", "radius = 0.005\ncentre = [0.073, 0.02, -1.0]\n") +
                                        group("bar",
                                              "shape = \"bar\"\ncentre = [0.073, 0.02, 0.3]\nrotation = [0.0, "
                                              "1.5707963267948966, 0.0]\n"));
  const Placement placement = place_spheres(file);
  EXPECT_LT((placement.spheres.place[0].centre() - Vector3(0.001, 0.02, 0.005)).norm(), 1e-12);
  EXPECT_LT((placement.spheres.place[1].centre() - Vector3(0.073, 0.02, 0.011)).norm(), 1e-12);  // 6 mm up on 8 mm across
  EXPECT_NEAR((placement.spheres.place[4].centre() - placement.spheres.place[1].centre()).norm(), 0.01, 1e-12);
  EXPECT_GT(placement.spheres.place[4].z, 0.0209);
  const std::string nothing =
      refused(group("a", "radius = 0.005\ncentre = [0.0, 0.0, 0.5]\n"), {"gravity.acceleration=[0.0, 0.0, 9.81]"});
  EXPECT_NE(nothing.find("error: there is nothing below (0, 0, 0.5) on which \"a\" could stand"), std::string::npos) << nothing;
}

/// Sliders and their dashpots turn spheres against each other in a bed: the default step must bear them, whatever brakes.
TEST(run_spheres, a_bed_keeps_its_energy_at_the_default_step) {
  const TemporaryFolder folder;
  for (const std::string model : {"hertz", "linear"}) {
    std::vector<std::string> settings = {"contact.restitution=0.3", "contact.friction_coefficient=0.5", "spheres.0.count=300",
                                         "time.end=0.6", "time.history_interval=0.05"};
    if (model == "linear")
      for (const char* one : {"contact.model=\"linear\"", "contact.contact_stiffness=1e4", "contact.contact_shear_stiffness=1e4"})
        settings.emplace_back(one);
    carry_out(case_of(folder, scattered, settings), folder / model);
    const auto figures = read_manifest(folder / model)["results"];
    EXPECT_LT(std::abs(figures["energy_residual"].get<double>()), 2e-2 * figures["energy_lost"].get<double>()) << model;
  }
}

TEST(run_spheres, pairs_of_materials_have_their_own_constants) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, std::string(scattered) + R"([[materials]]
name = "steel"
density = 7800.0
youngs_modulus = 2e11
poisson_ratio = 0.3
[[pairs]]
between = ["steel", "glass"]
friction_coefficient = 0.1
)");
  const auto table = contact_table(file.as<cases::SpheresCase>());
  EXPECT_EQ(table.of(0, 0).friction, 0.4);
  EXPECT_EQ(table.of(0, 1).friction, 0.1);
  EXPECT_EQ(table.of(1, 0).friction, 0.1);
  EXPECT_EQ(table.of(0, 1).rolling, 0.05);
  EXPECT_NEAR(table.of(0, 1).normal / table.of(0, 0).normal, 2, 1e-3);
}

TEST(run_spheres, says_what_does_not_fit) {
  EXPECT_NE(
      refused("[[spheres]]\nname = \"a\"\nmaterial = \"glass\"\ncentre = [0.0, 0.0, 0.1]\nradius = 0.03\n")
          .find("error: the domain is 0.08 m long along the periodic axis x, and the diameter of the largest sphere is 0.06 m"),
      std::string::npos);
  const std::string overlap = refused(R"([[spheres]]
name = "a"
material = "glass"
centre = [0.01, 0.0, 0.02]
radius = 0.005
[[spheres]]
name = "b"
material = "glass"
centre = [0.018, 0.0, 0.02]
radius = 0.005
)");
  EXPECT_NE(overlap.find("error: 1 pairs of spheres overlap at the start by more than 0.05 of the smaller radius: a 1 at (0.01, "
                         "0, 0.02) and b 1 at "
                         "(0.018, 0, 0.02) by 0.4"),
            std::string::npos)
      << overlap;
  const std::string full = refused(scattered, {"spheres.0.count=20000"});
  EXPECT_NE(full.find("error: there is no space for sphere"), std::string::npos) << full;
  const std::string beyond = refused(scattered, {"walls.0.point=[0.0, 0.0, 0.1]"});
  EXPECT_NE(beyond.find("spheres begin within the wall \"floor\""), std::string::npos) << beyond;
  const std::string step = refused(scattered, {"time.step=1e-3"});
  EXPECT_NE(step.find("error: the step of 0.001 s is"), std::string::npos) << step;
  const TemporaryFolder folder;
  const std::string row = words_of<UserError>([&] {
    const auto file = case_of(folder, "[[spheres]]\nname = \"a\"\nmaterial = \"glass\"\nsource = \"file\"\nfile = \"" +
                                          folder.write("a.txt", "# comment\n0.005 0 0 0.01\n0.005, 0, 0\n").string() + "\"\n");
    registry::check_case(file);
  });
  EXPECT_NE(row.find("a.txt:3: four numbers were expected, radius, x, y and z in m, found"), std::string::npos) << row;
}

}  // namespace
}  // namespace sazare::runs
