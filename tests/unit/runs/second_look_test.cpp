#include <gtest/gtest.h>

#include "sazare/registry/registry.hpp"

namespace sazare::runs {
namespace {

/// What check tells of a case with these keys in front of the last ones.
std::string checked(const std::string& text) { return registry::check_case(registry::read_case_text(text, "case.toml")); }

void expect_words(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* part : words) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

/// Sound rock: sqrt(G/rho) = 2287 m/s; E G/s_t^2 = 30e9 * 100/6e6^2 = 0.0833 m.
TEST(second_look_blocks, tells_the_shortest_wave_and_the_process_zone) {
  const auto with_energy = [](const std::string& energy) {
    return checked(
        "[case]\ntitle = \"Block\"\nmethod = \"blocks\"\n[mesh]\nfile = \"tests/regression/block/block.msh\"\n"
        "[[materials]]\nname = \"rock\"\nregions = [\"rock\"]\ndensity = 2390.0\nyoungs_modulus = 30e9\npoisson_ratio = 0.2\n"
        "[[joints]]\nname = \"face\"\nbetween = [\"rock\", \"rock\"]\ncohesion = 6e6\nfriction_coefficient = 0.58\n"
        "tensile_strength = 6e6\nfracture_energy = " +
        energy +
        "\n[contact]\ncontact_stiffness = 1.5e9\nfriction_coefficient = 0.58\n"
        "[time]\nend = 5e-4\nhistory_interval = 1e-6\nsnapshot_interval = 1e-5\n");
  };
  const std::string text = with_energy("100.0");
  expect_words(text, {"S 2290 m/s", "; S waves of ", " Hz are ten times ",
                      "face: process zone E G/s_t^2 of 0.0833 m, edges of elements up to "});
  EXPECT_NE(text.find("longer ones do not resolve"), std::string::npos) << "elements of some 0.1 m";
  EXPECT_EQ(with_energy("1000.0").find("longer ones do not resolve"), std::string::npos);
}

/// 16 particles of 1 m2 and 2000 kg/m3, of which the base cuts four in half; S waves of 300 m/s are ten times 1 m long at 30 Hz.
TEST(second_look_mps, tells_the_weight_and_warns_of_short_waves) {
  const auto with_motion = [](const char* frequency) {
    return checked(
        std::string(
            "[case]\ntitle = \"Column\"\nmethod = \"mps\"\n[particles]\nspacing = 1.0\nperiodic = [\"x\"]\n"
            "[[regions]]\nname = \"s\"\nlower = [0.0, 0.0, 0.0]\nupper = [4.0, 4.0, 0.0]\n"
            "[[materials]]\nname = \"m\"\nregions = [\"s\"]\ndensity = 2000.0\ns_wave_velocity = 300.0\npoisson_ratio = 0.3\n"
            "[[motions]]\nname = \"shake\"\ntype = \"ricker\"\npeak_time = 0.2\nfrequency = ") +
        frequency +
        "\n[[boundaries]]\nside = \"bottom\"\nkind = \"prescribed\"\nmotion_x = \"shake\"\n"
        "[time]\nend = 0.5\nhistory_interval = 0.01\n");
  };
  const std::string slow = with_motion("25.0"), fast = with_motion("35.0");
  expect_words(slow, {"mass        28000 kg/m, weight 274.6 kN/m", "S waves of 30 Hz are ten times 1 m long"});
  EXPECT_EQ(slow.find("is faster than"), std::string::npos) << slow;
  expect_words(
      fast, {"case.toml:18:8: warning: the motion \"shake\" of 35 Hz or so is faster than what a size of 1 m follows: S waves of "
             "300 m/s are 10 of them long at 30 Hz"});
}

std::string squares(const std::string& wall) {
  return checked(
      "[case]\ntitle = \"Squares\"\nmethod = \"rectangles\"\n"
      "[[blocks]]\nname = \"b\"\nmaterial = \"m\"\nelement_size = 0.1\nlower = [0.0, 0.0, 0.0]\nupper = [0.4, 0.2, 0.0]\n"
      "[[materials]]\nname = \"m\"\ndensity = 2500.0\nface_normal_stiffness = 1e9\nface_shear_stiffness = 4e8\n"
      "[contact]\nface_normal_stiffness = 1e9\nface_shear_stiffness = 4e8\ndamping_ratio = 0.5\nfriction_angle = 20.0\n" +
      wall + "[gravity]\nacceleration = [0.0, -10.0, 0.0]\n[time]\nend = 2.0\nhistory_interval = 0.01\n");
}

/// 8 squares of 25 kg; waves along the lattice are those of its springs: sqrt(1e9/2500) and sqrt(4e8/2500).
TEST(second_look_rectangles, tells_mass_waves_cost_and_what_holds) {
  const std::string text = squares("");
  expect_words(text,
               {"mass        200 kg, weight 1.961 kN", "m: P 632.5 m/s, S 400 m/s; S waves of 400 Hz are ten times 0.1 m long",
                "cost        about ", "held        no wall or roller holds the blocks, which fall 20 m in the time of the run"});
  EXPECT_EQ(squares("[[walls]]\nname = \"w\"\nfrom = [-1.0, 0.0, 0.0]\nto = [1.0, 0.0, 0.0]\n").find("no wall or roller"),
            std::string::npos);
}

TEST(second_look_spheres, tells_the_weight_and_that_nothing_holds) {
  const auto with_wall = [](const std::string& wall) {
    return checked(
        "[case]\ntitle = \"Ball\"\nmethod = \"spheres\"\n[[materials]]\nname = \"m\"\ndensity = 1000.0\nyoungs_modulus = 1e7\n"
        "poisson_ratio = 0.2\n[contact]\nrestitution = 0.6\nfriction_coefficient = 0.4\n"
        "[[spheres]]\nname = \"ball\"\nmaterial = \"m\"\ncentre = [0.0, 0.0, 0.5]\nradius = 0.5\n" +
        wall + "[gravity]\nacceleration = [0.0, 0.0, -10.0]\n[time]\nend = 2.0\nhistory_interval = 0.01\n");
  };
  expect_words(with_wall(""), {"mass        523.6 kg, weight 5.135 kN",
                               "held        no wall and no held group: the bodies fall 20 m in the time of the run"});
  EXPECT_EQ(with_wall("[[walls]]\nname = \"floor\"\nmaterial = \"m\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n")
                .find("no wall"),
            std::string::npos);
}

std::string strip(std::vector<std::string> settings) {
  settings.emplace_back("time.end=2");
  return registry::check_case(registry::read_case("cases/two-mass-oscillator/mass.toml", settings));
}

TEST(second_look_fem, tells_the_weight_and_what_holds) {
  expect_words(strip({}), {"kg/m, weight ", "held        4 nodes\n"});
  expect_words(strip({"boundaries.0.kind=roller", "boundaries.0.axes=[\"x\"]"}),
               {"held        4 nodes along x; nothing is held along y\n"});
  expect_words(strip({"boundaries=[]", "gravity.acceleration=[0,-10,0]"}),
               {"held        0 nodes; nothing holds the body, which falls 20 m in the time of the run"});
}

}  // namespace
}  // namespace sazare::runs
