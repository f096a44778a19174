#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "case_folder.hpp"
#include "sazare/methods/fem/case/format.hpp"
#include "sazare/methods/mps/case/format.hpp"

namespace sazare::cases {
namespace {

/// A case of method fem whose soil has these keys; G0 is 4e7 Pa.
std::string soil_case(const std::string& keys) {
  return R"([case]
title = "Soil"
method = "fem"

[mesh]
file = "block.geo"
dimension = 3

[[materials]]
name = "soil"
regions = ["rock"]
density = 1800
youngs_modulus = 1e8
poisson_ratio = 0.25
)" + keys +
         R"(
[time]
end = 1
step = 0.1
)";
}

constexpr const char* table =
    "shear_strain [%],modulus_ratio [-],damping_ratio [%]\n0.001,1,1\n0.01,0.9,2\n0.1,0.5,10\n1,0.1,20\n";

laws::BackboneCurve curve_of(const CaseFolder& folder, const std::string& keys) {
  const FemMaterial material = folder.read(soil_case(keys)).as<FemCase>().materials[0];
  return backbone_of(material, material.shear_modulus());
}

constexpr const char* ghe =
    "backbone = \"general_hyperbolic\"\nshear_strength = 40e3\nghe_c1_end = 0.17\nghe_c2_begin = 0.83\nghe_c2_end = 2.5\n"
    "ghe_alpha = 2.86\nghe_beta = 3.229\n";

TEST(SoilCase, HasTheCurveOfItsKeys) {
  const CaseFolder folder;
  const auto hyperbola = curve_of(folder, "backbone = \"hyperbolic\"\nreference_strain = 1e-3\n");
  EXPECT_NEAR(hyperbola.strength(), 40e3, 1e-6);
  EXPECT_EQ(hyperbola.corner_strain().size(), 30u);
  const auto by_strength = curve_of(folder, "backbone = \"hyperbolic\"\nshear_strength = 40e3\nyield_surfaces = 12\n");
  EXPECT_EQ(by_strength.corner_strain().size(), 12u);
  EXPECT_NEAR(by_strength.strain_at_ratio(0.5), 1e-3, 1e-4);
  const auto power = curve_of(
      folder, "backbone = \"ramberg_osgood\"\nreference_strain = 1e-3\nramberg_osgood_exponent = 2.5\nshear_strength = 50e3\n");
  EXPECT_NEAR(power.strength(), 50e3, 1e-6);
  EXPECT_NEAR(power.stress(1e-3), 20e3, 400);
  const auto general = curve_of(folder, ghe);
  EXPECT_NEAR(general.strength(), 40e3, 1e-6);
  EXPECT_NEAR(
      general.stress(1e-3),
      40e3 / (1 / (0.585 + 0.415 * std::cos(std::numbers::pi / 3.86)) + 1 / (1.665 - 0.835 * std::cos(std::numbers::pi / 4.229))),
      400);
}

TEST(SoilCase, TakesATableInPercent) {
  const CaseFolder folder;
  folder.write("curve.csv", table);
  const auto curve = curve_of(folder, "backbone = \"table\"\nmodulus_reduction = \"curve.csv\"\n");
  EXPECT_NEAR(curve.stress(1e-3), 20e3, 1e-6);
  EXPECT_NEAR(curve.stress(0.1), 40e3, 1e-6);
  const auto stronger = curve_of(folder, "backbone = \"table\"\nmodulus_reduction = \"curve.csv\"\nshear_strength = 60e3\n");
  EXPECT_NEAR(stronger.stress(1e-2), 40e3, 1e-6);
  EXPECT_NEAR(stronger.stress(0.1), 60e3, 1e-6);
}

/// Keys of a soil with each backbone, and with either default of the hyperbola.
const std::array soils_of_each_backbone{
    "backbone = \"hyperbolic\"\nreference_strain = 1e-3\n",
    "backbone = \"hyperbolic\"\nshear_strength = 4e4\n",
    "backbone = \"ramberg_osgood\"\nreference_strain = 1e-3\nramberg_osgood_exponent = 2.5\nshear_strength = 50e3\n",
    "backbone = \"table\"\nmodulus_reduction = \"curve.csv\"\nshear_strength = 60e3\n",
    ghe,
};

TEST(SoilCase, ReadsBackToTheSameCase) {
  const CaseFolder folder;
  folder.write("curve.csv", table);
  for (const std::string keys : soils_of_each_backbone) {
    const std::string resolved = write_resolved(folder.read(soil_case(keys)).as<FemCase>());
    EXPECT_EQ(write_resolved(folder.read(resolved).as<FemCase>()), resolved);
  }
}

/// A case of method mps with the same soil.
std::string particle_case(const std::string& keys) {
  return R"([case]
title = "Soil"
method = "mps"

[particles]
spacing = 1

[[regions]]
name = "all"
lower = [0, 0, 0]
upper = [4, 4, 0]

[[materials]]
name = "soil"
regions = ["all"]
density = 1600
s_wave_velocity = 158.11388300841898
poisson_ratio = 0.25
)" + keys +
         R"(
[time]
end = 1
)";
}

TEST(SoilCase, IsTheSameOfParticles) {
  const CaseFolder folder;
  folder.write("curve.csv", table);
  for (const std::string keys : soils_of_each_backbone) {
    const MpsCase mps = folder.read(particle_case(keys)).as<MpsCase>();
    const auto curve = backbone_of(mps.materials[0], mps.materials[0].shear_modulus()), expected = curve_of(folder, keys);
    for (const Real strain : {1e-5, 1e-3, 1e-1}) EXPECT_NEAR(curve.stress(strain), expected.stress(strain), 1e-6);
    const std::string resolved = write_resolved(mps);
    EXPECT_EQ(write_resolved(folder.read(resolved).as<MpsCase>()), resolved);
    EXPECT_NE(explain(mps).find("damping by Masing's rules"), std::string::npos);
  }
}

/// Masing's damping of the hyperbola at its reference strain is 4/pi 2 (1 - ln 2) - 2/pi = 14.5 %.
TEST(SoilCase, IsExplained) {
  const CaseFolder folder;
  folder.write("curve.csv", table);
  const std::string text = explain(folder.read(soil_case("backbone = \"hyperbolic\"\nreference_strain = 1e-3\n")).as<FemCase>());
  EXPECT_NE(text.find("G0 40e6 Pa, shear strength 40000 Pa, G/G0 = 0.5 at a shear strain of "), std::string::npos) << text;
  EXPECT_NE(text.find("% at 100e-6, 14."), std::string::npos) << text;
  EXPECT_NE(text.find("real soil has less than what exceeds 25 %"), std::string::npos) << text;
  const std::string of_table =
      explain(folder.read(soil_case("backbone = \"table\"\nmodulus_reduction = \"curve.csv\"\n")).as<FemCase>());
  EXPECT_NE(of_table.find("(table 10 %)"), std::string::npos) << of_table;
}

}  // namespace
}  // namespace sazare::cases
