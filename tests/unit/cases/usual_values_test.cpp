/// Numbers that are right for a computer and wrong for an engineer: the unit that would explain them is named.

#include "sazare/cases/format/usual_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sazare::cases {
namespace {

/// What is said of this value of a key.
std::string said(std::string_view name, std::string_view unit, const UsualRange& usual, Real number) {
  Problems problems;
  problems.add_source({"case.toml", {"key = value"}});
  Value value;
  value.place = {0, 1, 1, 3};
  warn_of_unusual({.name = name, .unit = unit, .usual = usual, .sentence = ""}, value, number, problems);
  return problems.warning_text();
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

TEST(usual_values, name_the_unit_that_was_meant) {
  const std::string light = said("density", "kg/m3", usual::density, 2.39);
  EXPECT_SAYS(light, "density = 2.39 kg/m3 is unusual: it is below 100");
  EXPECT_SAYS(light, "2.39 g/cm3 would be 2390");
  const std::string soft = said("youngs_modulus", "Pa", usual::elastic_modulus, 40);
  EXPECT_SAYS(soft, "40 MPa would be 40e6, 40 GPa would be 40e9");
  EXPECT_SAYS(said("youngs_modulus", "Pa", usual::rock_modulus, 36000), "36000 MPa would be 36e9");
  EXPECT_SAYS(said("peak_pressure", "Pa", usual::blast_pressure, 575), "575 MPa would be 575e6");
  EXPECT_SAYS(said("cohesion", "Pa", usual::strength, 20), "20 kPa would be 20000");
  EXPECT_SAYS(said("delay", "s", usual::delay, 42), "42 ms would be 0.042");
  EXPECT_SAYS(said("friction_angle", "deg", usual::friction_angle, 0.6), "0.6 rad would be 34.3775");
  EXPECT_SAYS(said("s_wave_velocity", "m/s", usual::wave_velocity, 2.5), "2.5 km/s would be 2500");
  EXPECT_SAYS(said("contact_stiffness", "N/m", usual::contact_stiffness, 1.5),
              "contact_stiffness = 1.5 N/m is unusual: it is below 1000");
  EXPECT_SAYS(said("acceleration", "m/s2", usual::gravity, -981), "-981 cm/s2 would be -9.81");
}

TEST(usual_values, of_no_known_unit_are_told_as_well) {
  EXPECT_SAYS(said("density", "kg/m3", usual::density, 2.39e9), "it is above 25000");
  EXPECT_SAYS(said("density", "kg/m3", usual::density, 2.39e9), "check the unit and the power of ten");
}

TEST(usual_values, of_a_ratio_may_have_been_meant_in_per_cent) {
  const std::string words = said("damping_ratio", "", usual::damping_ratio, 2);
  EXPECT_SAYS(words, "damping_ratio = 2 is unusual: it is above 1");
  EXPECT_SAYS(words, "2 % would be 0.02");
}

TEST(usual_values, are_those_of_a_magnitude) {
  EXPECT_EQ(said("amplitude", "", {}, -0.5), "");
  EXPECT_SAYS(said("dilation", "Pa", usual::strength, -20), "-20 kPa would be -20000");
}

TEST(usual_values, that_are_usual_none_or_without_limit_are_left_alone) {
  for (const Real number : {0.0, 100.0, 2400.0, 25e3, std::numeric_limits<Real>::infinity()})
    EXPECT_EQ(said("density", "kg/m3", usual::density, number), "") << number;
}

}  // namespace
}  // namespace sazare::cases
