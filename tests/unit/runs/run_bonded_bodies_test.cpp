/// Cases with bodies of bonded spheres.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "sazare/registry/registry.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "tests/unit/runs/sphere_cases.hpp"

namespace sazare::runs {
namespace {

using namespace sphere_cases;
using test::read_manifest, test::TemporaryFolder;

TEST(run_bonded_bodies, bonded_tetrapods_break_and_tell_their_pieces) {
  const TemporaryFolder folder;
  const auto file = case_of(folder, brittle, {"time.end=0.1", "time.stability_fraction=0.05"});
  EXPECT_NE(registry::check_case(file).find("bodies      20 bonded, their inertia within"), std::string::npos);
  carry_out(file, folder / "run");
  const nlohmann::json results = read_manifest(folder / "run")["results"];
  EXPECT_EQ(results["clumps"], 0);
  EXPECT_EQ(results["bodies"], 20);
  EXPECT_EQ(results["bonds"], 160);
  EXPECT_GT(results["broken_bodies"], 2);
  EXPECT_LT(results["broken_bodies"], 20);
  const auto pieces = rows_of(folder / "run/fragments.csv");
  ASSERT_EQ(results["fragments"], pieces.size());
  Real mass = 0, elements = 0;
  for (const auto& piece : pieces) {
    mass += piece.at("mass");
    elements += piece.at("elements");
  }
  EXPECT_EQ(elements, 180);
  const auto whole = pieces.front();
  EXPECT_EQ(whole.at("elements"), 9);
  EXPECT_NEAR(mass, 20 * whole.at("mass"), 1e-12);
  EXPECT_NEAR(whole.at("mass"), 2500 * whole.at("volume"), 1e-12);
  const SpheresModel rigid = build_spheres(case_of(folder, tetrapods));
  EXPECT_NEAR(whole.at("mass"), rigid.stepper->clumps().clumps.front().mass, 1e-12);
  EXPECT_LT(std::abs(results["energy_residual"].get<double>()), 1e-2 * results["energy_lost"].get<double>());
}

/// One tetrapod on its feet: below a speed it stays whole, above it breaks; either way the energy balance closes.
TEST(run_bonded_bodies, a_dropped_tetrapod_breaks_above_a_speed) {
  for (const auto& [speed, breaks] : {std::pair(0.1, false), std::pair(3.0, true)}) {
    const TemporaryFolder folder;
    const auto file = case_of(folder, brittle,
                              {"spheres.0.count=1", "spheres.0.random_rotation=false", "spheres.0.upper=[0.08, 0.08, 0.027]",
                               "spheres.0.velocity=[0.0, 0.0, -" + std::to_string(speed) + "]", "time.end=0.03",
                               "time.snapshot_interval=0.03", "time.stability_fraction=0.05"});
    carry_out(file, folder / "run");
    const nlohmann::json results = read_manifest(folder / "run")["results"];
    EXPECT_EQ(results["broken_bodies"], breaks ? 1 : 0) << speed;
    EXPECT_LT(std::abs(results["energy_residual"].get<double>()), 1e-2 * results["energy_work"].get<double>()) << speed;
  }
}

/// `brittle` without the velocity, which neither rain nor what is lowered may have.
std::string resting(const std::string& key) {
  std::string text = brittle;
  const std::string velocity = "velocity = [0.0, 0.0, -1.0]";
  return text.replace(text.find(velocity), velocity.size(), key + " = true");
}

TEST(run_bonded_bodies, come_to_rest_before_the_beginning) {
  const TemporaryFolder folder;
  carry_out(case_of(folder, resting("rain"),
                    {"time.end=0.05", "time.snapshot_interval=0.05", "bonds.0.tensile_strength=3e6", "bonds.0.cohesion=3e6",
                     "bonds.0.fracture_energy=4e3"}),
            folder / "run");
  const auto rows = rows_of(folder / "run/history.csv"), gauges = rows_of(folder / "run/gauges.csv");
  EXPECT_EQ(rows.front().at("energy_translation") + rows.front().at("energy_rotation"), 0);
  EXPECT_EQ(rows.back().at("broken_bodies"), 0);
  EXPECT_GT(rows.front().at("contacts"), 20);
  EXPECT_LT(gauges.front().at("armour.position_z"), 0.04);  // from some 0.075
  EXPECT_NEAR(gauges.back().at("armour.position_z"), gauges.front().at("armour.position_z"), 1e-6);
}

TEST(run_bonded_bodies, are_lowered_until_they_touch) {
  const TemporaryFolder folder;
  const Placement placement = place_spheres(case_of(folder, resting("lowered")));
  ASSERT_EQ(placement.bonded_bodies, 20);
  std::vector<Real> gap(20, 1);  // of each body to the floor or the nearest sphere of another one
  const auto& place = placement.spheres.place;
  for (std::size_t i = 0; i < place.size(); ++i)
    for (std::size_t j = 0; j < place.size(); ++j) {
      Real& least = gap[static_cast<std::size_t>(placement.bonded_body[i])];
      least = std::min(least, place[i].z - place[i].radius);
      if (placement.bonded_body[i] == placement.bonded_body[j]) continue;
      const Vector3 apart = placement.spheres.box.nearest(place[j].centre() - place[i].centre());
      least = std::min(least, apart.norm() - place[i].radius - place[j].radius);
    }
  for (const Real least : gap) EXPECT_NEAR(least, 0, 1e-12);
}

/// A bonded bar, clamped at one end by a sphere that is held, sags under its own weight as Timoshenko's beam with the bar's
/// masses at its nodes.
TEST(run_bonded_bodies, a_bonded_bar_bends_as_beam_theory_says) {
  constexpr Real radius = 0.005, root = 0.007, modulus = 1e8, poisson = 0.2;
  const TemporaryFolder folder;
  const std::string rows = "0.005 0 0 0\n0.005 0.004 0 0\n0.005 0.008 0 0\n0.005 0.012 0 0\n0.005 0.016 0 0\n";
  const std::string text = "[[shapes]]\nname = \"bar\"\nsource = \"file\"\nbonds = \"beam\"\nfile = \"" +
                           folder.write("bar.txt", rows).string() + "\"\n" + R"([[spheres]]
name = "bar"
material = "glass"
shape = "bar"
centre = [0.03, 0.04, 0.05]
[[spheres]]
name = "clamp"
material = "glass"
centre = [0.015, 0.04, 0.05]
radius = 0.002
held = true
[[bonds]]
name = "beam"
youngs_modulus = 1e8
poisson_ratio = 0.2
damping_ratio = 1.0
[[bonds]]
name = "root"
between = ["clamp", "bar"]
radius_ratio = 2.5
youngs_modulus = 1e8
poisson_ratio = 0.2
damping_ratio = 1.0
)";
  const SpheresModel model = build_spheres(case_of(folder, text));
  methods::spheres::SphereStepper& stepper = *model.stepper;
  ASSERT_EQ(model.bonds, 5);
  std::map<Real, Real> nodes;  // mass by distance from the clamp
  for (std::size_t i = 0; i < 5; ++i) nodes[stepper.spheres().place[i].x - 0.015] = stepper.spheres().place[i].mass;
  const Real end = nodes.rbegin()->first, area = std::numbers::pi * radius * radius,
             second_moment = 0.25 * area * radius * radius;
  EXPECT_NEAR(end, root + 0.016, 1e-7);
  const Real shear = 6 * (1 + poisson) / (7 + 6 * poisson) * modulus / (2 * (1 + poisson)) * area;
  Real sag = 0;
  for (const auto& [at, mass] : nodes)
    sag += mass * 9.81 * (at * at * (3 * end - at) / (6 * modulus * second_moment) + at / shear);
  stepper.start();
  while (stepper.time() < 0.3) stepper.advance();
  stepper.evaluate_now();
  Real found = 0;
  for (std::size_t i = 0; i < stepper.spheres().size(); ++i) {
    const auto number = static_cast<std::size_t>(stepper.spheres().number[i]);
    found = std::max(found, model.placed[number].z() - stepper.spheres().place[i].z);
  }
  EXPECT_GT(sag, 1e-6);
  EXPECT_NEAR(found, sag, 1e-4 * sag);
}

}  // namespace
}  // namespace sazare::runs
