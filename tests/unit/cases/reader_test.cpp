#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_folder.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

TEST(Reader, TakesDefaultsFromTheSchema) {
  const CaseFolder folder;
  const BlocksCase blocks = folder.read(smallest_case()).as<cases::BlocksCase>();
  EXPECT_EQ(blocks.title, "Small");
  EXPECT_EQ(blocks.mesh.scale, 1);
  EXPECT_EQ(blocks.materials.at(0).density, 2700);
  EXPECT_TRUE(blocks.joints.at(0).bonded);
  EXPECT_EQ(blocks.joints.at(0).normal_damping, 0);
  EXPECT_EQ(blocks.contact.damping_cap, DampingCap::step);
  EXPECT_EQ(blocks.contact.edge_division, 5);
  EXPECT_EQ(blocks.gravity.acceleration, Vector3::Zero());
  EXPECT_EQ(blocks.time.levels, Levels::per_element);
  EXPECT_EQ(blocks.time.limiter, Limiter::stability);
  EXPECT_FALSE(blocks.time.base_step);
  EXPECT_EQ(blocks.time.stability_fraction, 0.5);
  EXPECT_EQ(blocks.time.travel_length, 1e-8);
  EXPECT_EQ(blocks.time.neighbor_levels, 2);
  EXPECT_FALSE(blocks.time.strict);
  EXPECT_EQ(blocks.output.checkpoint_interval, 60);
}

TEST(Reader, TakesEveryKeyThatIsGiven) {
  const CaseFolder folder;
  const BlocksCase blocks = folder.read(full_case()).as<cases::BlocksCase>();
  EXPECT_EQ(blocks.title, "Full \"quoted\" 発破");
  EXPECT_EQ(blocks.mesh.file, folder.path() / "block.geo");
  EXPECT_TRUE(blocks.mesh.is_geometry());
  const std::vector<std::pair<std::string, Real>> parameters{{"depth", 3}, {"edge length", 0.1}};
  EXPECT_EQ(blocks.mesh.parameters, parameters);
  EXPECT_EQ(blocks.materials.at(0).regions, (std::vector<std::string>{"rock", "roof"}));
  EXPECT_NEAR(blocks.joints.at(0).friction_coefficient, 1 / std::numbers::sqrt3, 1e-15);
  EXPECT_EQ(blocks.joints.at(1).between, (std::array<std::string, 2>{"rock", "clay"}));
  EXPECT_TRUE(blocks.joints.at(2).on_surface());
  EXPECT_FALSE(blocks.joints.at(2).bonded);
  EXPECT_EQ(blocks.contact.damping_cap, DampingCap::critical);
  EXPECT_EQ(blocks.blasts.at(0).name, "hole 1");
  EXPECT_EQ(blocks.blasts.at(0).cut_distance, 0.005);
  EXPECT_EQ(std::get<PressurePulse>(blocks.blasts.at(0).pressure).decay_ratio, 2.75);
  EXPECT_EQ(blocks.gravity.acceleration, Vector3(0, 0.1, -9.81));
  EXPECT_EQ(blocks.initial_stress.normal, Vector3(-3e6, -1e6, -2e6));
  EXPECT_EQ(blocks.initial_stress.shear, Vector3(0, 2e5, 0));
  EXPECT_EQ(blocks.initial_stress.normal_per_depth, Vector3(-1e4, -1e4, -26487));
  EXPECT_EQ(blocks.initial_stress.shear_per_depth, Vector3(0, 0, 100));
  EXPECT_EQ(blocks.initial_stress.datum, 12.5);
  EXPECT_EQ(blocks.boundaries.at(1).kind, BoundaryKind::frictionless);
  EXPECT_EQ(blocks.boundaries.at(2).kind, BoundaryKind::prescribed);
  EXPECT_EQ(blocks.boundaries.at(2).motion, (std::array<std::string, 3>{"shake", "wavelet", "record"}));
  EXPECT_EQ(blocks.motions.at(0).frequency, 20);
  EXPECT_EQ(blocks.constraints.at(0).translation, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(blocks.constraints.at(0).rotation, (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(blocks.initial_velocities.at(0).velocity, Vector3(0.1, 0, -1e-3));
  EXPECT_EQ(blocks.gauges.at(0).point, Vector3(0.3, 0.6, 0.1));
  EXPECT_EQ(blocks.time.limiter, Limiter::travel);
  EXPECT_EQ(blocks.time.base_step, 1e-8);
  EXPECT_TRUE(blocks.time.strict);
}

TEST(Reader, TakesCharges) {
  const CaseFolder folder;
  const std::vector<Charge> charges = folder.read(full_case()).as<cases::BlocksCase>().charges;
  const Charge &upper = charges.at(0), &lower = charges.at(1), &other = charges.at(2);
  EXPECT_EQ(upper.filling().velocity, 3900);
  EXPECT_EQ(upper.filling().density, laws::explosives[0].density);
  EXPECT_NEAR(upper.volume(), 0.5 * std::numbers::pi / 4 * 0.065 * 0.065 * 2.5, 1e-12);
  EXPECT_EQ(upper.primer_depth(), 4.5);
  EXPECT_NEAR(upper.firing_time(0), 2.5e-4, 5e-5);
  EXPECT_NE(upper.firing_time(0), upper.firing_time(1));
  EXPECT_TRUE(upper.vents);
  EXPECT_EQ(upper.stemming_density, 1700);
  EXPECT_EQ(upper.stemming_resistance, 1e5);
  EXPECT_EQ(upper.gas_in_cracks, GasInCracks::flow);
  EXPECT_EQ(upper.crack_aperture, 2e-4);
  EXPECT_EQ(upper.discharge_coefficient, 0.7);
  EXPECT_EQ(lower.gas_in_cracks, GasInCracks::share);
  EXPECT_EQ(lower.crack_pressure_share, 0.5);
  EXPECT_EQ(lower.crack_aperture, 5e-5);
  EXPECT_EQ(lower.stemming_density, 1600);
  EXPECT_EQ(lower.bottom_depth(), 10);
  EXPECT_EQ(lower.primer_depth(), 10);
  EXPECT_EQ(lower.explosive_diameter(), 0.089);
  EXPECT_NEAR(lower.filling().energy, 1150 * 5000.0 * 5000.0 / 16, 1);
  EXPECT_EQ(other.name, "hole_5");
  EXPECT_NEAR(other.filling().energy, 7e9, 1e-3 * 7e9);
  EXPECT_EQ(other.filling().gas.r2, 0.95);
}

/// A thousand detonators scatter as they are said to.
TEST(Reader, DelaysScatterNormally) {
  Charge charge;
  charge.delay = 1;
  charge.delay_scatter = 0.01;
  Real sum = 0, squares = 0;
  constexpr int count = 1000;
  for (int i = 0; i < count; ++i) {
    const Real off = charge.firing_time(static_cast<std::size_t>(i)) - 1;
    sum += off / count;
    squares += off * off / count;
  }
  EXPECT_NEAR(sum, 0, 1e-3);
  EXPECT_NEAR(std::sqrt(squares), 0.01, 1e-3);
}

TEST(Reader, ReadsThePressureTable) {
  const CaseFolder folder;
  const Blast blast = folder.read(full_case()).as<cases::BlocksCase>().blasts.at(1);
  EXPECT_EQ(blast.name, "hole_2");
  EXPECT_TRUE(std::isinf(blast.cut_distance));
  const auto& table = std::get<PressureTable>(blast.pressure);
  EXPECT_EQ(table.time, (std::vector<Real>{0, 1.33e-4, 5e-4}));
  EXPECT_EQ(table.pressure, (std::vector<Real>{0, 5.75e8, 0}));
}

TEST(Reader, ReadsFilesWithWindowsLineEnds) {
  const CaseFolder folder;
  std::string text;
  for (char c : smallest_case()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(folder.read(text).as<cases::BlocksCase>().title, "Small");
}

/// Long lines and deep keys are told of, in time that grows with their length.
TEST(Reader, HostileTextIsRefusedQuickly) {
  const CaseFolder folder;
  const std::string head = "[case]\ntitle = \"x\"\nmethod = \"mps\"\n", a(200000, 'a'), blanks(200000, ' ');
  std::string dotted = "a", quoted = "\"=\"";
  for (int i = 0; i < 200000; ++i) {
    dotted += ".a";
    quoted += ".\"=\"";
  }
  for (const std::string& line : {"x = " + a, a + " = ?", "x = 0." + std::string(500000, '0') + "1",
                                  "x = " + std::string(100000, '[') + std::string(100000, ']'), "x = a" + blanks + "b",
                                  "x = a" + blanks + "#", "x = 1 " + std::string(200000, 'm') + blanks + "m"})
    EXPECT_THROW(folder.read(head + line + "\n"), UserError) << line.substr(0, 20);
  for (const std::string& line :
       {dotted + " = 1", "[" + dotted + "]", "[[" + dotted + "]]", "x = { " + dotted + " = 1 }", quoted + " = 1"}) {
    const std::string words = folder.refusal(head + line + "\n");
    EXPECT_NE(words.find("a key has more than 64 parts"), std::string::npos) << words.substr(0, 200);
  }
  EXPECT_NO_THROW(folder.read(smallest_case() + "# " + dotted + "\n")) << "in a comment";
}

TEST(Reader, TakesAByteOrderMarkAndAHybridThatNamesItselfIsRefused) {
  const CaseFolder folder;
  EXPECT_EQ(folder.read("\xef\xbb\xbf" + smallest_case()).as<cases::BlocksCase>().title, "Small");
  const std::string words = folder.refusal(
      "[case]\ntitle = \"x\"\nmethod = \"hybrid\"\n[sides]\ncontinuum = \"case.toml\"\nbodies = \"case.toml\"\n[surface]\ngroup "
      "= \"top\"\n");
  EXPECT_NE(words.find("a side of a hybrid case is of method hybrid itself"), std::string::npos) << words;
}

TEST(Reader, SaysWhenTheCaseFileIsNotThere) {
  const CaseFolder folder;
  EXPECT_THROW(registry::read_case(folder.path() / "none.toml"), UserError);
  EXPECT_THROW(registry::read_case(folder.path()), UserError);
}

TEST(Reader, AcceptsTheLargestStrengthItSuggests) {
  const CaseFolder folder;
  const std::string message = folder.refusal(smallest_case(), {"joints.0.tensile_strength=2e7"});
  EXPECT_NE(message.find("9.471e6 Pa"), std::string::npos) << message;
  EXPECT_NE(message.find("444.5 N/m"), std::string::npos) << message;
  EXPECT_NO_THROW(folder.read(smallest_case(), {"joints.0.tensile_strength=9.471e6"}));
  EXPECT_NO_THROW(folder.read(smallest_case(), {"joints.0.tensile_strength=2e7", "joints.0.fracture_energy=444.5"}));
}

TEST(Reader, KeepsPlacesForWhatTheEngineFindsOut) {
  const CaseFolder folder;
  const CaseFile file = folder.read(full_case());
  const std::string text = warning(file, "gauges.0.point", "the gauge is outside", "move it");
  EXPECT_NE(text.find("case.toml:110:9: warning: the gauge is outside"), std::string::npos) << text;
  try {
    refuse(file, "time.no_such_key", "bad", "help");
  } catch (const UserError& failure) {
    EXPECT_NE(std::string(failure.what()).find("| [time]"), std::string::npos) << failure.what();
  }
  EXPECT_THROW(refuse(file, "nothing.at.all", "bad", "help"), UserError);
  EXPECT_THROW(refuse(file, "gauges.7.point", "bad", "help"), UserError);
}

}  // namespace
}  // namespace sazare::cases
