/// Runs of method mps with free-field sides.

#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

using test::read_manifest, test::read_text, test::TemporaryFolder, test::words_of;
using Settings = std::vector<std::string>;

cases::CaseFile ground(Settings settings = {}) {
  settings.insert(settings.begin(), "particles.spacing=1");
  return registry::read_case("validation/analytic/free-field/level-ground.toml", settings);
}

const Settings settles{"gravity.acceleration=[0,-9.81,0]", "gravity.settle=true"};

TEST(mps_free_field, leaves_ground_at_rest_that_has_settled) {
  const TemporaryFolder folder;
  Settings settings = settles;
  settings.push_back("motions.0.amplitude=0");
  registry::run_case(ground(settings), {folder / "run", Begin::fresh, true, nullptr});
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_GT(results["settlement"].get<double>(), 1e-4);
  EXPECT_LT(results["peak_acceleration"].get<double>(), 1e-4 * 9.81);
}

TEST(mps_free_field, gives_the_bits_of_one_run_in_parts_and_on_threads) {
  const TemporaryFolder folder;
  Settings settings = settles;
  settings.insert(settings.end(), {"materials.1.cohesion=3e3", "materials.1.friction_angle=20", "time.end=1", "time.step=5e-4"});
  parallel::set_threads(1);
  const std::int64_t asked = test::run_whole(ground(settings), folder / "whole");
  parallel::set_threads(2);
  test::run_in_parts(ground(settings), folder / "parts", asked);
  test::expect_same_runs(folder / "whole", folder / "parts");
  EXPECT_GT(read_manifest(folder / "whole")["results"]["energy_plastic"].get<double>(), 0);
}

/// A slope that is shaken to pieces: what has broken beside a side and has left its place is no longer pushed on by the ground
/// beyond, which would make it as fast as a bullet.
TEST(mps_free_field, lets_broken_ground_go) {
  const TemporaryFolder folder;
  Settings settings = settles;
  settings.insert(
      settings.end(),
      {"particles.spacing=2",
       "regions=[{name=\"rock\",shape=\"polygon\",points=[[-40,0],[70,0],[70,10],[-40,10],[-40,0]]},"
       "{name=\"soil\",shape=\"polygon\",points=[[-40,10],[70,10],[70,30],[30,30],[0,18],[-40,18],[-40,10]]}]",
       "materials.0.s_wave_velocity=500", "materials.0.p_wave_velocity=935.4", "materials.1.s_wave_velocity=250",
       "materials.1.p_wave_velocity=467.7", "materials.1.density=1850", "materials.1.cohesion=15e3",
       "materials.1.friction_angle=30", "gauges=[]", "motions.0.frequency=2", "motions.0.peak_time=0.6", "motions.0.amplitude=1",
       "damping.f1=0.2", "damping.f2=8", "time.end=4", "time.history_interval=0.1", "time.snapshot_interval=4"});
  registry::run_case(ground(settings), {folder / "run", Begin::fresh, true, nullptr});
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_GT(results["broken_links"].get<double>(), 0);
  EXPECT_LT(results["peak_displacement"].get<double>(), 100);
}

TEST(mps_free_field, tells_the_largest_frequency_of_ground_and_columns) {
  const std::string told = registry::check_case(ground());
  EXPECT_EQ(told.find("the largest frequency, 0 rad/s"), std::string::npos) << told;
}

std::string refused(const Settings& settings) {
  return words_of<UserError>([&] { registry::check_case(ground(settings)); });
}

TEST(mps_free_field, refuses_sides_that_no_column_fits) {
  const std::string uneven = refused({"regions.1.lower=[2,5,0]"});
  EXPECT_NE(
      uneven.find("no column of layers fits the ground beside side \"left\": at y = 5.5 m there are both \"rock\" and \"soil\""),
      std::string::npos)
      << uneven;
  const std::string steep = refused({"regions.0.upper=[20,5,0]", "regions.1.lower=[2,5,0]"});
  EXPECT_NE(steep.find("at y = 5.5 m there are 2 of 4 particles"), std::string::npos) << steep;
  const std::string held = refused({"boundaries.0.region=soil"});
  EXPECT_EQ(held.find("no column"), std::string::npos) << held;
  const std::string narrow = refused({"regions.0.upper=[7,10,0]", "regions.1.upper=[7,10,0]"});
  EXPECT_NE(narrow.find("the body is 7 particles wide"), std::string::npos) << narrow;
}

}  // namespace
}  // namespace sazare::runs
