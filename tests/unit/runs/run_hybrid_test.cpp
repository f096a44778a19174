#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

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
  run_quietly(seawall(), folder / "whole");
  int parts = 1;
  for (;; ++parts) {
    std::atomic<bool> stop = false;
    std::jthread alarm([&](const std::stop_token& over) {
      const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100 * parts);
      while (!over.stop_requested() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      stop = true;
    });
    if (!run_quietly(seawall(), folder / "parts", Begin::resume, &stop).stopped) break;
  }
  EXPECT_GT(parts, 1);
  const nlohmann::json one = read_manifest(folder / "whole"), many = read_manifest(folder / "parts");
  EXPECT_GT(one["results"]["peak_force"].get<double>(), 0);
  EXPECT_EQ(one["state_hash"], many["state_hash"]);
  EXPECT_EQ(test::without_last_column(read_text(folder / "whole/history.csv")),
            test::without_last_column(read_text(folder / "parts/history.csv")));
  for (const char* table : {"continuum/gauges.csv", "bodies/gauges.csv", "bodies/walls.csv"})
    EXPECT_EQ(read_text(folder / "whole" / table), read_text(folder / "parts" / table)) << table;
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
    run_quietly(of(), folder / "whole");
    std::atomic<bool> stop = false;
    std::jthread alarm([&](const std::stop_token& over) {
      while (!over.stop_requested() && !fs::exists(folder / "parts/checkpoint"))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      stop = true;
    });
    const bool stopped = run_quietly(of(), folder / "parts", Begin::resume, &stop).stopped;
    parallel::set_threads(2);
    if (stopped) run_quietly(of(), folder / "parts", Begin::resume);
    parallel::set_threads(1);
    const nlohmann::json one = read_manifest(folder / "whole"), two = read_manifest(folder / "parts");
    EXPECT_GT(one["results"]["peak_force"].get<double>(), 0);
    EXPECT_EQ(one["state_hash"], two["state_hash"]);
    EXPECT_EQ(test::without_last_column(read_text(folder / "whole/history.csv")),
              test::without_last_column(read_text(folder / "parts/history.csv")));
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
