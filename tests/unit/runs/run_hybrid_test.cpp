#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::run_quietly, test::TemporaryFolder, test::words_of;

cases::CaseFile oscillator(const std::vector<std::string>& settings = {}) {
  return registry::read_case("cases/two-mass-oscillator/case.toml", settings);
}

/// A few tetrapods that are thrown against the caisson.
cases::CaseFile seawall() {
  std::vector<std::string> settings = {"coupling.scheme=iterative", "bodies.spheres.0.upper=[-0.01, 0.2, 0.315]",
                                       "bodies.spheres.1.upper=[-0.44, 0.12, 0.315]", "bodies.spheres.0.velocity=[1, 0, 0]"};
  for (const char* side : {"continuum", "bodies"})
    for (const char* time : {"end=0.1", "history_interval=0.01", "snapshot_interval=0.1"})
      settings.push_back(std::string(side) + ".time." + time);
  return registry::read_case("cases/seawall-shaking-table/case.toml", settings);
}

TEST(run_hybrid, writes_a_folder_for_each_side_and_what_goes_over_the_surface) {
  const TemporaryFolder folder;
  run_quietly(oscillator(), folder / "run");
  const nlohmann::json manifest = read_manifest(folder / "run");
  EXPECT_EQ(manifest["method"], "hybrid");
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["results"]["windows"], 1000);
  EXPECT_EQ(manifest["results"]["steps_per_window"], 20);
  EXPECT_GT(manifest["results"]["energy_work"].get<double>(), 0) << "or every run would be warned of";
  EXPECT_LT(std::abs(manifest["results"]["energy_coupling_error"].get<double>()),
            1e-5 * std::abs(manifest["results"]["energy_work_on_nodes"].get<double>()));
  EXPECT_TRUE(read_text(folder / "run/history.csv").starts_with("time [s],surface.displacement_x [m],"));
  for (const std::string side : {"continuum", "bodies"}) {
    EXPECT_EQ(read_manifest(folder / "run" / side)["status"], "done");
    EXPECT_TRUE(fs::exists(folder / "run" / side / "gauges.csv"));
    EXPECT_TRUE(fs::exists(folder / "run" / side / "history.csv"));
  }
  EXPECT_TRUE(fs::exists(folder / "run/continuum/snapshots/finite_elements_00001.vtkhdf"));
  EXPECT_TRUE(fs::exists(folder / "run/bodies/snapshots/particles_00001.vtkhdf"));
}

TEST(run_hybrid, can_be_run_again_from_the_case_in_its_folder) {
  const TemporaryFolder folder;
  run_quietly(oscillator({"continuum.time.end=0.01", "bodies.time.end=0.01"}), folder / "run");
  run_quietly(registry::read_case(folder / "run/case.toml"), folder / "again");
  EXPECT_EQ(read_manifest(folder / "run")["state_hash"], read_manifest(folder / "again")["state_hash"]);
}

TEST(run_hybrid, in_many_parts_gives_the_bits_of_one_run) {
  const TemporaryFolder folder;
  test::run_in_parts(seawall(), folder / "parts", test::run_whole(seawall(), folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  EXPECT_GT(read_manifest(folder / "whole")["results"]["peak_force"].get<double>(), 0);
  for (const char* table : {"continuum/gauges.csv", "bodies/gauges.csv", "bodies/walls.csv"})
    EXPECT_EQ(read_text(folder / "whole" / table), read_text(folder / "parts" / table)) << table;
}

constexpr Real pulse = 6, friction = 0.2, weight = 9.81, pulse_end = 0.25, slide_end = 0.8;

/// A block that stands on a slab of 5 GPa with contacts of 10 GPa, while the slab is pushed away beneath it.
cases::CaseFile block_on_moving_slab(const fs::path& folder, const std::string& scheme) {
  std::ofstream(folder / "slab.geo") << R"(
Point(1) = {-2, -0.5, 0, 0.25}; Point(2) = {2, -0.5, 0, 0.25}; Point(3) = {2, 0, 0, 0.25}; Point(4) = {-2, 0, 0, 0.25};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 17; Transfinite Curve{2, 4} = 3; Transfinite Surface{1}; Recombine Surface{1};
Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Surface("slab") = {1};
)";
  const std::string times = fmt::format("end = {}\nhistory_interval = 0.01\nsnapshot_interval = {}\n", slide_end, slide_end);
  std::ofstream(folder / "slab.toml") << R"([case]
title = "slab"
method = "fem"
[mesh]
file = "slab.geo"
dimension = 2
[[materials]]
name = "concrete"
regions = ["slab"]
density = 2400.0
youngs_modulus = 5e9
poisson_ratio = 0.2
[[motions]]
name = "push"
type = "sine"
quantity = "acceleration"
frequency = 2.0
cycles = 0.5
amplitude = )" << fmt::format("{:.1f}", pulse)
                                      << R"(
[[boundaries]]
group = "foot"
kind = "prescribed"
motion_x = "push"
axes = ["y"]
[time]
step = 2e-4
)" << times;
  std::ofstream(folder / "block.toml") << R"([case]
title = "block"
method = "rectangles"
[[blocks]]
name = "rock"
material = "rock"
lower = [-0.5, 0.0, 0.0]
upper = [0.5, 0.5, 0.0]
[[materials]]
name = "rock"
density = 2500.0
face_normal_stiffness = 1e10
face_shear_stiffness = 1e10
[contact]
face_normal_stiffness = 1e10
face_shear_stiffness = 1e10
damping_ratio = 0.3
friction_angle = )" << fmt::format("{:.6f}", std::atan(friction) * 180 / std::numbers::pi)
                                       << R"(
[gravity]
acceleration = [0.0, -9.81, 0.0]
[[gauges]]
name = "rock"
point = [0.0, 0.25, 0.0]
[time]
)" << times;
  std::ofstream(folder / "case.toml") << "[case]\ntitle = \"slide\"\nmethod = \"hybrid\"\n[sides]\ncontinuum = \"slab.toml\"\n"
                                         "bodies = \"block.toml\"\n[surface]\ngroup = \"top\"\n[coupling]\nscheme = \""
                                      << scheme << "\"\n";
  return registry::read_case(folder / "case.toml");
}

/// How far Newmark's rigid block, which friction alone takes along, is left behind.
Real newmark_slide() {
  Real slab = 0, block = 0, behind = 0;
  constexpr Real step = 1e-6;
  for (Real time = 0; time < slide_end; time += step) {
    const Real push = time < pulse_end ? pulse * std::sin(4 * std::numbers::pi * time) : 0;
    const bool slides = slab > block || push > friction * weight;
    slab += step * push;
    block = slides ? std::min(slab, block + step * friction * weight) : slab;
    behind += step * (slab - block);
  }
  return behind;
}

Real last_of(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::string titles, line, last, word;
  std::getline(lines, titles);
  while (std::getline(lines, line)) last = line;
  std::istringstream names(titles), values(last);
  while (std::getline(names, word, ',')) {
    std::string value;
    std::getline(values, value, ',');
    if (word == name) return std::stod(value);
  }
  ADD_FAILURE() << name;
  return 0;
}

/// Contacts twice as stiff as the ground: a force that lags behind feeds on itself there.
TEST(run_hybrid, a_stiff_contact_on_softer_ground_gains_no_energy) {
  const TemporaryFolder folder;
  run_quietly(block_on_moving_slab(folder.path(), "automatic"), folder / "run");
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  const Real slide = last_of(read_text(folder / "run/history.csv"), "surface.displacement_x [m]") -
                     last_of(read_text(folder / "run/bodies/gauges.csv"), "rock.displacement_x [m]");
  EXPECT_NEAR(slide, newmark_slide(), 0.02 * newmark_slide());
  const Real kinetic = 0.5 * 1250 * std::pow(2 * pulse * pulse_end / std::numbers::pi, 2);  // what the block is given
  EXPECT_LT(std::abs(results["energy_coupling_error"].get<Real>()), 1e-3 * kinetic);
  EXPECT_LT(std::abs(results["energy_residual"].get<Real>()), 1e-2 * kinetic);
  EXPECT_LT(results["passes"].get<Real>(), 4 * results["windows"].get<Real>());
  EXPECT_LT(results["unconverged_windows"].get<Real>(), 0.01 * results["windows"].get<Real>());
}

/// What windows leave of the force must not build up to a rattle that never ends.
TEST(run_hybrid, a_body_at_rest_stays_at_rest) {
  const TemporaryFolder folder;
  run_quietly(registry::read_case("validation/analytic/block-on-fem-ground/rectangle.toml"), folder / "run");
  const std::string table = read_text(folder / "run/history.csv");
  constexpr Real square = 2500 * 9.81 * 0.2 * 0.2 * 0.25;
  EXPECT_NEAR(last_of(table, "surface.force_y [N]"), -square, 1e-6 * square);
  EXPECT_LT(last_of(table, "force_mismatch [-]"), 1e-6);
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_LT(results["passes"].get<Real>(), 1.1 * results["windows"].get<Real>());
}

/// A case with an end and rows of its own.
cases::CaseFile shortened(const std::string& name, const std::string& end, const std::string& interval,
                          std::vector<std::string> settings = {}) {
  for (const char* side : {"continuum", "bodies"})
    for (const auto& [key, value] : {std::pair{"end", end}, {"history_interval", interval}, {"snapshot_interval", end}})
      settings.push_back(fmt::format("{}.time.{}={}", side, key, value));
  return registry::read_case("cases/" + name + "/case.toml", settings);
}

/// Blocks in the plane and tetrahedra in space, that touch by then.
const auto blocks_in_the_plane = [] {
  return shortened("block-on-soft-ground", "0.1", "0.01", {"coupling.scheme=iterative", "coupling.tolerance=1e-2"});
};
const auto tetrahedra = [] { return shortened("rock-fall-on-slab", "0.0016", "1e-4"); };

TEST(run_hybrid, bodies_of_any_method_go_on_from_a_checkpoint_as_if_nothing_had_been) {
  for (const auto& of : {std::function<cases::CaseFile()>(blocks_in_the_plane), std::function<cases::CaseFile()>(tetrahedra)}) {
    const TemporaryFolder folder;
    const std::int64_t asked = test::run_whole(of(), folder / "whole");
    parallel::set_threads(2);
    test::run_in_parts(of(), folder / "parts", asked);
    parallel::set_threads(1);
    EXPECT_GT(read_manifest(folder / "whole")["results"]["peak_force"].get<double>(), 0);
    test::expect_same_runs(folder / "whole", folder / "parts");
  }
}

TEST(run_hybrid, gives_the_same_bits_on_any_number_of_threads) {
  const TemporaryFolder folder;
  run_quietly(seawall(), folder / "one");
  parallel::set_threads(2);
  run_quietly(seawall(), folder / "two");
  parallel::set_threads(1);
  EXPECT_EQ(read_manifest(folder / "one")["state_hash"], read_manifest(folder / "two")["state_hash"]);
}

TEST(run_hybrid, what_rains_lies_before_the_wall_when_the_windows_begin) {
  const TemporaryFolder folder;
  const std::vector<std::string> settings = {"bodies.spheres.0.upper=[-0.01, 0.2, 0.315]",
                                             "bodies.spheres.1.upper=[-0.44, 0.12, 0.315]",
                                             "bodies.spheres.0.rain=true",
                                             "bodies.spheres.1.rain=true",
                                             "bodies.time.end=0.01",
                                             "continuum.time.end=0.01",
                                             "bodies.time.snapshot_interval=0.01",
                                             "continuum.time.snapshot_interval=0.01"};
  run_quietly(registry::read_case("cases/seawall-shaking-table/case.toml", settings), folder / "run");
  const nlohmann::json bodies = read_manifest(folder / "run/bodies")["results"];
  EXPECT_GT(bodies["contacts"].get<int>(), 0);
  EXPECT_LT(bodies["peak_speed"].get<double>(), 0.01);  // m/s; without rain they fall with 0.1 m/s by then
}

std::string refused(const std::vector<std::string>& settings) {
  return words_of<UserError>([&] { registry::check_case(oscillator(settings)); });
}

TEST(run_hybrid, says_what_does_not_fit) {
  EXPECT_NE(refused({"surface.group=tpo"}).find("the mesh has no group \"tpo\""), std::string::npos);
  EXPECT_NE(refused({"surface.group=tpo"}).find("did you mean \"top\""), std::string::npos);
  EXPECT_NE(refused({"bodies.spheres.0.centre=[0.05, 5, 0]"}).find("no body is near the surface"), std::string::npos);
  EXPECT_NE(refused({"bodies.time.step=8e-6", "bodies.time.history_interval=0.1", "continuum.time.history_interval=0.1",
                     "bodies.time.snapshot_interval=0.1", "continuum.time.snapshot_interval=0.1"})
                .find("is not a whole multiple of that of the bodies"),
            std::string::npos);
}

TEST(run_hybrid, chooses_a_step_of_the_bodies_that_divides_the_window) {
  const std::string words = registry::check_case(registry::read_case("cases/seawall-shaking-table/case.toml"));
  EXPECT_NE(words.find("steps of the spheres"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::runs
