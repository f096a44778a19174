#include <gtest/gtest.h>

#include <fstream>

#include "sazare/core/error.hpp"
#include "sazare/methods/rectangles/run/assembly.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder, test::words_of;

/// The mortar beam, coarse and loaded fast, so that it breaks soon.
cases::CaseFile beam(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(), {"blocks.0.element_size=0.01", "rollers.2.velocity=[0,-0.1,0]", "time.end=0.003",
                                     "gauges.0.point=[0.081,0.002,0]", "time.snapshot_interval=5e-4",
                                     "rollers.0.center=[0.035,-0.005,0]", "rollers.1.center=[0.125,-0.005,0]"});
  return registry::read_case("cases/mortar-beam/case.toml", settings);
}

std::string refused(const std::vector<std::string>& settings) {
  return words_of<UserError>([&] { registry::check_case(beam(settings)); });
}

TEST(run_rectangles, writes_its_folder_and_its_figures) {
  const TemporaryFolder folder;
  EXPECT_FALSE(registry::run_case(beam(), {folder / "run", Begin::fresh, true}).stopped);
  const nlohmann::json manifest = read_manifest(folder / "run");
  EXPECT_EQ(manifest["method"], "rectangles");
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["results"]["elements"], 64);
  EXPECT_GT(manifest["results"]["broken_springs"], 0);
  EXPECT_GT(manifest["results"]["peak_force_platen"], 1500);
  EXPECT_TRUE(fs::exists(folder / "run/snapshots/rectangles_00006.vtkhdf"));
  EXPECT_NE(read_text(folder / "run/history.csv").find("platen.force_y [N]"), std::string::npos);
  EXPECT_TRUE(read_text(folder / "run/gauges.csv").starts_with("time [s],middle.displacement_x [m],"));
}

TEST(run_rectangles, in_many_parts_gives_the_bits_of_one_run) {
  const TemporaryFolder folder;
  const cases::CaseFile file = beam();
  test::run_in_parts(file, folder / "parts", test::run_whole(file, folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  EXPECT_EQ(read_text(folder / "whole/gauges.csv"), read_text(folder / "parts/gauges.csv"));
}

TEST(run_rectangles, refuses_a_step_above_the_limit_and_warns_of_one_near_it) {
  const std::string words = refused({"time.step=2.5e-6"});
  EXPECT_NE(words.find("--set time.step: error: the step of 2.5e-6 s is 1.2"), std::string::npos) << words;
  EXPECT_NE(words.find("(26) of the paper gives"), std::string::npos) << words;
}

TEST(run_rectangles, refuses_what_overlaps_at_the_start) {
  const std::string words =
      refused({"blocks=[{name=\"beam\",material=\"mortar\",element_size=0.01,lower=[0,0,0],upper=[0.16,0.04,0]},"
               "{name=\"other\",material=\"mortar\",lower=[0.1,0.037,0],upper=[0.15,0.087,0]}]"});
  EXPECT_NE(words.find("overlaps another element by 0.003"), std::string::npos) << words;
}

TEST(run_rectangles, refuses_a_support_below_nothing) {
  const std::string words = refused({"rollers.0.center=[0.035,-0.009,0]"});
  EXPECT_NE(words.find("the support \"left\" touches no element"), std::string::npos) << words;
}

TEST(run_rectangles, refuses_a_gauge_outside) {
  EXPECT_NE(refused({"gauges.0.point=[0.5,0,0]"}).find("gauge \"middle\" is in no element"), std::string::npos);
}

TEST(run_rectangles, refuses_more_elements_than_the_machine_can_hold) {
  const std::vector<std::string> fine = {"blocks.0.element_size=1e-10"};
  const std::string squares = refused(fine);
  EXPECT_NE(squares.find("the block would have 640e15 elements"), std::string::npos) << squares;
  const std::string polygons =
      words_of<UserError>([&] { registry::check_case(registry::read_case("cases/irregular-beam/case.toml", fine)); });
  EXPECT_NE(polygons.find("the block would have 640e15 elements"), std::string::npos) << polygons;
  EXPECT_NE(polygons.find("this machine has"), std::string::npos) << polygons;
}

TEST(block_assembly, takes_polygons_and_images_and_turned_lattices) {
  const TemporaryFolder folder;
  std::ofstream(folder / "two.pgm") << "P2\n# two blocks\n3 2\n9\n9 5 5\n3 5 5\n";
  std::ofstream(folder / "case.toml") << R"([case]
title = "shapes"
method = "rectangles"
[[blocks]]
name = "triangle"
material = "stone"
shape = "polygon"
element_size = 0.25
points = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [0.0, 0.0]]
angle = 30.0
[[blocks]]
name = "picture"
material = "stone"
shape = "image"
file = "two.pgm"
element_size = 0.5
lower = [5.0, 0.0, 0.0]
[[materials]]
name = "stone"
density = 2500.0
face_normal_stiffness = 1e9
face_shear_stiffness = 4e8
[contact]
face_normal_stiffness = 1e9
face_shear_stiffness = 4e8
friction_angle = 30.0
[time]
end = 1.0
)";
  const Assembly assembly = assemble(registry::read_case(folder / "case.toml"));
  EXPECT_EQ(assembly.elements, 36 - 8 + 5);  // centres on the polygon's edge lie outside
  EXPECT_EQ(assembly.case_block, (std::vector<Index>{0, 1, 1}));
  EXPECT_NEAR(assembly.particles.angle[0], std::numbers::pi / 6, 1e-15);
  EXPECT_NEAR(assembly.particles.start[0][0], 0.125 * (std::cos(std::numbers::pi / 6) - 0.5), 1e-15);
  std::ofstream(folder / "two.pgm") << "P2\n3 2\n9\n9 5 5\n3 5\n";
  const std::string words = words_of<UserError>([&] { assemble(registry::read_case(folder / "case.toml")); });
  EXPECT_NE(words.find("the image ends before its 3 x 2 pixels"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::runs
