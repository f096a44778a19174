#include <gtest/gtest.h>

#include <fstream>

#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::run_quietly, test::TemporaryFolder, test::words_of;

cases::CaseFile beam(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(), {"time.end=0.06", "mesh.parameters={along=6}"});
  return registry::read_case("cases/cantilever-fem/case.toml", settings);
}

/// A beam that yields.
cases::CaseFile weak_beam() { return beam({"materials.0.cohesion=2e6", "materials.0.friction_angle=20"}); }

/// A beam of soil that degrades with strain.
cases::CaseFile soft_beam() { return beam({"materials.0.backbone=hyperbolic", "materials.0.reference_strain=2e-4"}); }

TEST(run_fem, writes_its_folder_and_its_figures) {
  const TemporaryFolder folder;
  run_quietly(beam(), folder / "run");
  const nlohmann::json manifest = read_manifest(folder / "run");
  EXPECT_EQ(manifest["method"], "fem");
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["results"]["steps"], 120);
  EXPECT_EQ(manifest["results"]["step_cuts"], 0);
  EXPECT_LT(std::abs(manifest["results"]["energy_residual"].get<double>()),
            1e-7 * manifest["results"]["energy_work"].get<double>());
  EXPECT_TRUE(fs::exists(folder / "run/snapshots/finite_elements_00002.vtkhdf"));
  EXPECT_TRUE(read_text(folder / "run/gauges.csv").starts_with("time [s],tip.displacement_x [m],"));
}

void check_parts(const cases::CaseFile& file) {
  const TemporaryFolder folder;
  test::run_in_parts(file, folder / "parts", test::run_whole(file, folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  EXPECT_GT(read_manifest(folder / "whole")["results"]["energy_plastic"].get<double>(), 0);
  EXPECT_EQ(read_text(folder / "whole/gauges.csv"), read_text(folder / "parts/gauges.csv"));
}

TEST(run_fem, in_many_parts_gives_the_bits_of_one_run) { check_parts(weak_beam()); }

TEST(run_fem, of_soil_in_many_parts_gives_the_bits_of_one_run) { check_parts(soft_beam()); }

std::string refused(const std::vector<std::string>& settings) {
  return words_of<UserError>([&] { registry::check_case(beam(settings)); });
}

TEST(run_fem, says_what_does_not_fit_the_mesh) {
  EXPECT_NE(refused({"boundaries.0.group=fot"}).find("the mesh has no group \"fot\""), std::string::npos);
  EXPECT_NE(refused({"boundaries.0.group=fot"}).find("did you mean \"foot\""), std::string::npos);
  EXPECT_NE(refused({"materials.0.regions=[\"baem\"]"}).find("the mesh has no region \"baem\""), std::string::npos);
  EXPECT_NE(refused({"mesh.dimension=3"}).find("the physical groups of the mesh hold elements of 2 dimensions at most"),
            std::string::npos);
  EXPECT_NE(refused({"gauges.0.point=[10, 50, 0]"}).find("from the nearest node"), std::string::npos);
}

TEST(run_fem, names_a_node_that_nothing_holds) {
  const std::string words = refused({"time.analysis=static", "boundaries.0.kind=roller", "boundaries.0.axes=[\"x\"]"});
  EXPECT_NE(words.find("the stiffness is singular: nothing holds node "), std::string::npos) << words;
  EXPECT_NE(words.find(" along y"), std::string::npos) << words;
}

TEST(run_fem, says_what_was_tried_where_a_body_cannot_carry_its_load) {
  const TemporaryFolder folder;
  const auto file = beam({"time.analysis=static", "materials.0.cohesion=1e5", "materials.0.friction_angle=20", "solver.max_cuts=2",
                          "loads.0.ramp=0.06"});
  const std::string words = words_of<PhysicsError>([&] { run_quietly(file, folder / "run"); });
  EXPECT_NE(words.find("there is no equilibrium at t = "), std::string::npos) << words;
  EXPECT_NE(words.find("20 iterations with line search in a step, and steps cut to 1/4 of that of the case"), std::string::npos)
      << words;
}

}  // namespace
}  // namespace sazare::runs
