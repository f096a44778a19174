#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/studies/limit_regression.hpp"
#include "sazare/runs/studies/run_study.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::run_quietly, test::TemporaryFolder, test::words_of;

cases::CaseFile column(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(), {"particles.spacing=2", "time.end=0.5", "time.snapshot_interval=0.05",
                                     "materials.0.damping_ratio=0.02", "damping.f1=1", "damping.f2=15"});
  return registry::read_case("cases/column-ricker/case.toml", settings);
}

/// The words of refusing a step.
std::string refused(const std::vector<std::string>& settings) {
  return words_of<UserError>([&] { registry::check_case(column(settings)); });
}

TEST(run_mps, writes_its_folder_and_its_figures) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_quietly(column(), folder / "run");
  EXPECT_FALSE(outcome.stopped);
  const nlohmann::json manifest = read_manifest(folder / "run");
  EXPECT_EQ(manifest["method"], "mps");
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["results"]["particles"], 250);
  EXPECT_EQ(manifest["results"]["steps"], 5000);
  EXPECT_NEAR(manifest["results"]["peak_acceleration"].get<double>(), 1, 0.05);
  EXPECT_TRUE(fs::exists(folder / "run/snapshots/particles_00010.vtkhdf"));
  EXPECT_TRUE(read_text(folder / "run/gauges.csv").starts_with("time [s],GL -100 m.displacement_x [m],"));
}

/// What a column says of its equilibrium under gravity after so many steps: refused, all but reached, or nothing.
std::string words_after_settling(int steps) {
  const TemporaryFolder folder;
  const auto file = column({"gravity.acceleration=[0, -9.81, 0]", "gravity.settle=true", "time.end=0.05", "particles.spacing=5",
                            "gravity.max_settling_steps=" + std::to_string(steps)});
  testing::internal::CaptureStdout();
  std::string refusal;
  try {
    registry::run_case(file, {folder / "run", Begin::fresh, false, nullptr});
  } catch (const PhysicsError& failure) {
    refusal = failure.what();
  }
  const std::string told = testing::internal::GetCapturedStdout();
  return refusal.empty() && told.find("all but reached: after ") == std::string::npos ? "" : refusal + told;
}

/// Ground that is close to its strength creeps for long before it rests to 1e-5 of gravity.
TEST(run_mps, begins_from_an_equilibrium_that_is_all_but_reached) {
  EXPECT_NE(words_after_settling(10).find("no equilibrium under gravity: after 10 steps"), std::string::npos);
  EXPECT_EQ(words_after_settling(100000), "");
  const auto is_refused = [](int steps) { return words_after_settling(steps).find("no equilibrium") != std::string::npos; };
  int too_few = 10, enough = 100000;
  while (enough - too_few > 1) (is_refused((too_few + enough) / 2) ? too_few : enough) = (too_few + enough) / 2;
  const std::string words = words_after_settling(enough);
  EXPECT_NE(words.find("all but reached: after " + std::to_string(enough) + " steps"), std::string::npos) << words;
}

TEST(run_mps, tells_that_nothing_holds_ground_that_falls) {
  const auto checked = [](const std::string& boundary) {
    return registry::check_case(registry::read_case_text(
        "[case]\ntitle = \"free\"\nmethod = \"mps\"\n[particles]\nspacing = 1.0\ndimension = 2\n"
        "[[regions]]\nname = \"soil\"\nlower = [0.0, 0.0, 0.0]\nupper = [4.0, 4.0, 0.0]\n"
        "[[materials]]\nname = \"ground\"\nregions = [\"soil\"]\ndensity = 1800.0\ns_wave_velocity = 100.0\n"
        "p_wave_velocity = 200.0\n" +
            boundary +
            "[gravity]\nacceleration = [0.0, -9.81, 0.0]\n"
            "[time]\nend = 0.1\nhistory_interval = 0.01\n",
        "case.toml"));
  };
  EXPECT_NE(checked("").find("warning: nothing holds the ground: it falls"), std::string::npos) << checked("");
  EXPECT_EQ(checked("[[boundaries]]\nside = \"bottom\"\nkind = \"fixed\"\n").find("nothing holds"), std::string::npos);
}

/// Two layers with a gap of two spacings between them: the upper one is joined to nothing.
TEST(run_mps, tells_of_parts_that_nothing_holds) {
  const TemporaryFolder folder;
  const auto checked = [&](const std::string& lower) {
    const std::string text =
        "[case]\ntitle = \"two layers\"\nmethod = \"mps\"\n[particles]\nspacing = 1.0\ndimension = 2\n"
        "[[regions]]\nname = \"rock\"\nlower = [0.0, 0.0, 0.0]\nupper = [4.0, 2.0, 0.0]\n"
        "[[regions]]\nname = \"soil\"\nlower = [0.0, " + lower + ", 0.0]\nupper = [4.0, 7.0, 0.0]\n"
        "[[materials]]\nname = \"ground\"\nregions = [\"rock\", \"soil\"]\ndensity = 1800.0\ns_wave_velocity = 100.0\n"
        "p_wave_velocity = 200.0\n[[boundaries]]\nside = \"bottom\"\nkind = \"fixed\"\n[time]\nend = 0.1\nhistory_interval = 0.01\n";
    return registry::check_case(registry::read_case_text(text, folder / "case.toml"));
  };
  const std::string parted = checked("4.0"), whole = checked("2.0");
  EXPECT_NE(parted.find("nothing holds 12 of the 20 particles, such as that at (0.5, 4.5, 0) m"), std::string::npos) << parted;
  EXPECT_NE(parted.find("wider than the influence radius of 1.5 m"), std::string::npos) << parted;
  EXPECT_EQ(whole.find("nothing holds"), std::string::npos) << whole;
  EXPECT_NE(whole.find("size        4 x 7 m, from (0, 0, 0) to (4, 7, 0) m"), std::string::npos) << whole;
  EXPECT_NE(whole.find("ground: P 200 m/s, S 100 m/s; S waves of 10 Hz are ten times 1 m long"), std::string::npos) << whole;
}

/// Whether check warns that a slope of this spacing is too coarse to judge its rest.
bool is_coarse(const std::string& spacing, const std::string& top, const std::string& settle, const std::string& strength) {
  const std::string text =
      "[case]\ntitle = \"slope\"\nmethod = \"mps\"\n[particles]\nspacing = " + spacing + "\nfit = \"inside\"\n" +
      "[[regions]]\nname = \"soil\"\nshape = \"polygon\"\npoints = [[0, 0], [40, 0], [40, " + top + "], [10, " + top +
      "], [0, 0]]\n[[materials]]\nname = \"ground\"\nregions = [\"soil\"]\ndensity = 1800.0\ns_wave_velocity = 100.0\n"
      "p_wave_velocity = 200.0\n" +
      strength +
      "[[boundaries]]\nside = \"bottom\"\nkind = \"fixed\"\n"
      "[gravity]\nacceleration = [0.0, -9.81, 0.0]\nsettle = " +
      settle + "\n[time]\nend = 0.1\nhistory_interval = 0.01\n";
  return registry::check_case(registry::read_case_text(text, "case.toml")).find("so few bear more than their strength says") !=
         std::string::npos;
}

TEST(run_mps, tells_of_slopes_that_are_too_coarse_to_judge_their_rest) {
  const std::string strength = "cohesion = 10e3\nfriction_angle = 30.0\nrupture_strain = 0.1\n";
  EXPECT_TRUE(is_coarse("0.5", "10", "true", strength));
  EXPECT_FALSE(is_coarse("0.2", "10", "true", strength));
  EXPECT_FALSE(is_coarse("0.5", "10", "false", strength));
  EXPECT_FALSE(is_coarse("0.5", "10", "true", ""));
  EXPECT_FALSE(is_coarse("0.5", "1", "true", strength));
}

/// What `check` says of a layer whose cohesion of 20 kPa falls to 4 kPa, a line a word; mu is 2e7 Pa.
std::string softening_words(const std::string& spacing, const std::string& softening,
                            const std::string& strength = "friction_angle = 0.0\nresidual_cohesion = 4e3\n") {
  const std::string text =
      "[case]\ntitle = \"t\"\nmethod = \"mps\"\n[particles]\nspacing = " + spacing +
      "\n[[regions]]\nname = \"soil\"\nlower = [0.0, 0.0, 0.0]\nupper = [16.0, 16.0, 0.0]\n[[materials]]\nname = \"ground\"\n"
      "regions = [\"soil\"]\ndensity = 2000.0\ns_wave_velocity = 100.0\np_wave_velocity = 200.0\ncohesion = 20e3\n" +
      strength + softening + "[[boundaries]]\nside = \"bottom\"\nkind = \"fixed\"\n[time]\nend = 0.1\nhistory_interval = 0.01\n";
  try {
    return registry::check_case(registry::read_case_text(text, "case.toml"));
  } catch (const UserError& error) {
    return error.what();
  }
}

TEST(run_mps, tells_of_softening_and_refuses_what_its_particles_do_not_resolve) {
  const auto has = [](const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; };
  const std::string never = "rupture_strain = 1e9\n", slow = "softening_displacement = 0.1\n",
                    fast = "softening_displacement = 2e-3\n";
  const std::string fine = softening_words("0.5", never + slow);
  EXPECT_TRUE(has(fine, "cohesion falls to 4000 Pa, at first over a slip of 0.1 m across a band")) << fine;
  EXPECT_TRUE(has(fine, "ground: to a plastic shear strain of 0.0157, in a band 6.35 m wide; spacing at most 4.13 m")) << fine;
  EXPECT_TRUE(has(fine, "would be 6.35 m wide, in ground 16 m high: it has hardly room to soften")) << fine;
  EXPECT_FALSE(has(softening_words("0.5", never + "softening_displacement = 0.02\n"), "hardly room"));
  const std::string coarse = softening_words("0.5", never + fast);
  EXPECT_TRUE(has(coarse, "particles of 0.5 m do not resolve the softening of \"ground\" over 0.002 m")) << coarse;
  EXPECT_TRUE(has(coarse, "a spacing of 0.0827 m or less would do, or a softening_displacement of 0.0121 m or more")) << coarse;
  const std::string brittle = softening_words("0.5", "rupture_strain = 0.01\n" + slow);
  EXPECT_TRUE(has(brittle, "breaks at a plastic shear strain of 0.01, before its strength has fallen, at 0.0157")) << brittle;
}

/// 16 m of 2000 kg/m3 press with 313.9 kPa: the drop is that (sin 40 - sin 30) less the growth of 20 kPa cos(phi).
TEST(run_mps, tells_of_friction_that_softens_and_where_its_bands_are_too_narrow) {
  const auto has = [](const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; };
  const std::string sand = "friction_angle = 40.0\nresidual_friction_angle = 30.0\nrupture_strain = 1e9\n",
                    weight = "[gravity]\nacceleration = [0.0, -9.81, 0.0]\n";
  const Real drop = 313.92e3 * (std::sin(40 * std::numbers::pi / 180) - 0.5) -
                    20e3 * (std::cos(30 * std::numbers::pi / 180) - std::cos(40 * std::numbers::pi / 180));
  const Real diagonal = (1.5 / std::sqrt(2.0) - 1) / 2,
             reach = 0.25 * 0.75 * (0.5 + 4 * diagonal) / (0.5 + 2 * diagonal),  // of links in the plane
      strain = std::cbrt(0.1 * 0.1 * drop / (std::numbers::pi * std::numbers::pi * reach * 2e7));
  const std::string fine = softening_words("0.5", "softening_displacement = 0.1\n" + weight, sand);
  EXPECT_TRUE(has(fine, "friction angle falls to 30 deg, at first over a slip of 0.1 m across a band")) << fine;
  EXPECT_TRUE(has(fine, "under 314 kPa, the weight of the highest ground")) << fine;
  EXPECT_TRUE(has(fine, fmt::format("to a plastic shear strain of {:.3g}", strain))) << fine;
  const std::string deep = softening_words("0.5", "softening_displacement = 0.03\n" + weight, sand);
  EXPECT_TRUE(has(deep, "bands of \"ground\" would be less than 6.3 spacings of 0.5 m wide")) << deep;
  // Without gravity nothing is known of the pressure, and nothing is refused.
  const std::string weightless = softening_words("0.5", "softening_displacement = 0.1\n", sand);
  EXPECT_FALSE(has(weightless, "error") || has(weightless, "6.3 spacings") || has(weightless, "hardly room")) << weightless;
}

/// A coarse slope in which links break.
cases::CaseFile slope() {
  const std::vector<std::string> settings = {"particles.spacing=2", "materials.0.rupture_strain=2e-3", "time.end=3",
                                             "time.snapshot_interval=1"};
  return registry::read_case("cases/slope-el-centro/case.toml", settings);
}

void expect_the_same_in_parts(const cases::CaseFile& file) {
  const TemporaryFolder folder;
  test::run_in_parts(file, folder / "parts", test::run_whole(file, folder / "whole"));
  test::expect_same_runs(folder / "whole", folder / "parts");
  EXPECT_EQ(read_text(folder / "whole/gauges.csv"), read_text(folder / "parts/gauges.csv"));
}

TEST(run_mps, in_many_parts_gives_the_bits_of_one_run) { expect_the_same_in_parts(column({"time.end=1"})); }

TEST(run_mps, slides_in_many_parts_with_the_bits_of_one_run) { expect_the_same_in_parts(slope()); }

TEST(run_mps, slides_with_the_same_bits_with_any_number_of_threads) {
  const TemporaryFolder folder;
  for (const int threads : {1, 2, 3}) {
    parallel::set_threads(threads);
    run_quietly(slope(), folder / std::to_string(threads));
  }
  parallel::set_threads(0);
  const nlohmann::json one = read_manifest(folder / "1");
  EXPECT_GT(one["results"]["broken_links"], 10);
  EXPECT_GT(one["results"]["energy_contact"], 0);
  for (const char* other : {"2", "3"}) EXPECT_EQ(one["state_hash"], read_manifest(folder / other)["state_hash"]);
}

TEST(run_mps, has_the_same_bits_with_any_number_of_threads) {
  const TemporaryFolder folder;
  const cases::CaseFile file = column({"particles.spacing=0.5", "time.end=0.02", "time.snapshot_interval=0.02"});
  for (const int threads : {1, 2, 3}) {
    parallel::set_threads(threads);
    run_quietly(file, folder / std::to_string(threads));
  }
  parallel::set_threads(0);
  const auto hash = [&](const char* name) { return read_manifest(folder / name)["state_hash"]; };
  EXPECT_EQ(hash("1"), hash("2"));
  EXPECT_EQ(hash("1"), hash("3"));
}

TEST(run_mps, refuses_a_step_above_the_limit_and_warns_of_one_near_it) {
  const std::vector<std::string> undamped = {"materials.0.damping_ratio=0", "time.end=0.504", "time.history_interval=0.0084",
                                             "time.snapshot_interval=0.504"};
  auto above = undamped, near = undamped;
  above.push_back("time.step=0.0084");
  const std::string words = refused(above);
  EXPECT_NE(words.find("--set time.step: error: the step of 0.0084 s is 1.029 times the predicted limit of 0.008165 s"),
            std::string::npos)
      << words;
  EXPECT_NE(words.find("help: choose 0.00735 s or less, or give no step"), std::string::npos) << words;
  near.insert(near.end(), {"time.end=0.486", "time.history_interval=0.0081", "time.snapshot_interval=0.486", "time.step=0.0081"});
  EXPECT_EQ(refused(near), "");
  EXPECT_NE(registry::check_case(column(near)).find("0.9 of it leaves a margin for large motion"), std::string::npos);
}

TEST(run_mps, refuses_what_does_not_fit_its_particles) {
  EXPECT_NE(refused({"gauges.0.point=[50,0,0]"}).find("gauge \"GL -100 m\" is 41"), std::string::npos)
      << refused({"gauges.0.point=[50,0,0]"});
  EXPECT_NE(refused({"time.integrator=\"euler\"", "materials.0.damping_ratio=0", "time.step=1e-3", "time.strict=true"})
                .find("Euler's step without damping is never stable"),
            std::string::npos);
}

TEST(run_mps, viscous_base_lets_a_wave_in_and_out) {
  const TemporaryFolder folder;
  run_quietly(column({"boundaries=[{side=\"bottom\",kind=\"viscous\",motion_x=\"wavelet\"}]", "materials.0.damping_ratio=0",
                      "time.step=2e-3", "time.end=3", "time.history_interval=0.05", "time.snapshot_interval=3"}),
              folder / "run");
  std::istringstream history(read_text(folder / "run/history.csv"));
  std::string line;
  std::getline(history, line);
  Real largest = 0, last = 0;
  while (std::getline(history, line)) {
    Real time = 0, kinetic = 0, elastic = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &kinetic, &elastic), 3);
    last = kinetic + elastic;
    largest = std::max(largest, last);
  }
  EXPECT_GT(largest, 100);          // J/m: the wave is in the column
  EXPECT_LT(last, 2e-3 * largest);  // and has left: 2 m particles send 4 % of its amplitude back
}

TEST(run_mps, a_body_in_3d_has_the_limit_and_motion_of_one_in_2d_between_rollers) {
  // A column of cubes periodic across both ways moves as the plane one.
  const TemporaryFolder folder;
  const auto settings = [](bool solid) {
    std::vector<std::string> list = {"time.end=0.4", "time.history_interval=0.1", "time.snapshot_interval=0.4", "time.step=1e-3"};
    if (solid)
      list.insert(list.end(), {"particles.dimension=3", "particles.periodic=[\"x\",\"y\"]", "regions.0.upper=[4,4,100]",
                               "gauges.0.point=[2,2,0]", "gauges.1.point=[2,2,25]", "gauges.2.point=[2,2,50]",
                               "gauges.3.point=[2,2,75]", "gauges.4.point=[2,2,100]"});
    return list;
  };
  run_quietly(column(settings(false)), folder / "plane");
  run_quietly(column(settings(true)), folder / "solid");
  const auto peak = [&](const char* name) { return read_manifest(folder / name)["results"]["peak_displacement"].get<double>(); };
  EXPECT_NEAR(peak("plane"), peak("solid"), 0.01 * peak("plane"));
}

TEST(limit_regression, finds_the_coefficients_that_made_the_points) {
  std::vector<LimitPoint> points;
  for (const Real radius : {0.25, 0.5, 1.0})
    for (const Real velocity : {100.0, 400.0})
      for (const Real damping : {0.001, 0.01, 0.05, 0.22}) {
        points.push_back({radius, velocity, damping, 0});
        points.back().limit = paper_shear_fit.predict(points.back());
      }
  const LimitFit fit = fit_limits(points);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(fit.b1[i], paper_shear_fit.b1[i], 1e-9);
    EXPECT_NEAR(fit.b2[i], paper_shear_fit.b2[i], 1e-9);
  }
  EXPECT_NEAR(log_error(fit, points), 0, 1e-9);
  // The values that its equations give: 4.49e-3 s and 9.26e-3 s at h = 0.001, 2.48e-3 s at h = 0.1.
  EXPECT_NEAR(paper_shear_fit.predict({0.5, 100, 0.001, 0}), 4.49e-3, 5e-6);
  EXPECT_NEAR(paper_shear_fit.predict({1.0, 100, 0.001, 0}), 9.26e-3, 5e-6);
  EXPECT_NEAR(paper_shear_fit.predict({0.5, 100, 0.1, 0}), 2.48e-3, 5e-6);
}

/// A study of four small cases.
cases::Study small_study(const TemporaryFolder& folder) {
  std::ofstream(folder / "study.toml") << R"([study]
title = "small"
[[families]]
name = "S"
case = ")" << fs::absolute("cases/stability-study/column-s.toml").string()
                                       << R"("
[[parameters]]
name = "spacing"
keys = ["particles.spacing"]
values = [3.2, 5.0]
[[parameters]]
name = "damping"
keys = ["materials.0.damping_ratio"]
values = [0.0, 0.1]
[limit]
divergence = 1e3
)";
  return cases::read_study(folder / "study.toml");
}

TEST(study, finds_predicted_limits_and_goes_on_where_it_stopped) {
  const TemporaryFolder folder;
  const cases::Study study = small_study(folder);
  const StudyOutcome whole = registry::run_study(study, {folder / "whole", Begin::fresh, true, 2, nullptr});
  EXPECT_EQ(whole.done, 4);
  EXPECT_LT(read_manifest(folder / "whole")["results"]["largest_log_difference"].get<double>(), 0.02);
  EXPECT_NE(whole.summary.find("of the bisection in all cases"), std::string::npos) << whole.summary;
  const std::string rows = test::without_last_column(read_text(folder / "whole/study.csv"));

  // A study of which only one row is left goes on with the other three.
  fs::copy(folder / "whole", folder / "part", fs::copy_options::recursive);
  const std::string text = read_text(folder / "whole/study.csv");
  std::ofstream(folder / "part/study.csv") << text.substr(0, text.find('\n', text.find('\n') + 1) + 1);
  std::ofstream(folder / "part/manifest.json") << R"({"status": "stopped"})";
  EXPECT_EQ(registry::run_study(study, {folder / "part", Begin::resume, true, 1, nullptr}).done, 4);
  EXPECT_EQ(test::without_last_column(read_text(folder / "part/study.csv")), rows);

  std::ofstream(folder / "part/manifest.json") << R"({"status": "stopped"})";
  const std::string header = text.substr(0, text.find('\n') + 1),
                    row = text.substr(header.size(), text.find('\n', header.size()) + 1 - header.size());
  for (const std::string& damaged :
       {"x" + row, "99" + row, "-1" + row.substr(1), row.substr(0, row.size() - 1) + "s\n", "1e999" + row.substr(1)}) {
    std::ofstream(folder / "part/study.csv") << header << damaged;
    const std::string said = words_of<UserError>([&] {
      registry::run_study(study, {folder / "part", Begin::resume, true, 1, nullptr});
    });
    EXPECT_NE(said.find("study.csv: a row is damaged"), std::string::npos) << damaged << said;
  }
  std::ofstream(folder / "study.toml", std::ios::app) << "ratio = 1.1\n";
  const std::string words = words_of<UserError>([&] {
    registry::run_study(cases::read_study(folder / "study.toml"), {folder / "part", Begin::resume, true, 1, nullptr});
  });
  EXPECT_NE(words.find("cannot be resumed: the study, its cases or the program have changed"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::runs
