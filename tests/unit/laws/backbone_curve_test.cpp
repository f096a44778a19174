#include "sazare/laws/soil/backbone_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sazare::laws {
namespace {

constexpr Real modulus = 4e7, reference = 1e-3, strength = modulus * reference;
constexpr int corners = 30;

Real hyperbola(Real strain) { return modulus * strain / (1 + strain / reference); }

TEST(backbone_curve, passes_through_the_hyperbola_at_its_points_and_ends_in_the_strength) {
  const BackboneCurve curve = hyperbolic_curve(modulus, reference, strength, corners);
  ASSERT_EQ(curve.corner_strain().size(), static_cast<std::size_t>(corners));
  for (const Real strain : spaced_strains(0.02 * reference, 50 * reference, corners))
    EXPECT_NEAR(curve.stress(strain), hyperbola(strain), 1e-12 * strength);
  EXPECT_EQ(curve.shear_modulus(), modulus);
  EXPECT_EQ(curve.stress(1e-9), modulus * 1e-9);
  EXPECT_NEAR(curve.stress(1), strength, 1e-12 * strength);
  EXPECT_NEAR(curve.strain_at_ratio(0.5), reference, 0.02 * reference);
  EXPECT_NEAR(curve.modulus_ratio(curve.strain_at_ratio(0.5)), 0.5, 1e-12);
}

TEST(backbone_curve, is_concave_and_odd) {
  const BackboneCurve curve = ramberg_osgood_curve(modulus, reference, 2.6, 3 * strength, corners);
  for (std::size_t i = 1; i < curve.slope().size(); ++i) {
    EXPECT_LT(curve.slope()[i], curve.slope()[i - 1]);
    EXPECT_GT(curve.corner_strain()[i], curve.corner_strain()[i - 1]);
  }
  EXPECT_EQ(curve.stress(-2e-3), -curve.stress(2e-3));
}

TEST(backbone_curve, gives_back_ramberg_and_osgood) {
  constexpr Real exponent = 2.6, limit = 2 * strength;
  const BackboneCurve curve = ramberg_osgood_curve(modulus, reference, exponent, limit, corners);
  EXPECT_NEAR(curve.modulus_ratio(reference), 0.5, 0.01);
  const Real end = limit / modulus * (1 + std::pow(2 * limit / strength, exponent - 1));
  for (const Real strain : spaced_strains(0.02 * reference, end, corners)) {
    const Real stress = curve.stress(strain);
    EXPECT_NEAR(stress / modulus * (1 + std::pow(2 * stress / strength, exponent - 1)), strain, 1e-9 * strain);
  }
  EXPECT_NEAR(curve.stress(10 * end), limit, 1e-9 * limit);
}

TEST(backbone_curve, of_the_general_hyperbolic_equation_is_the_hyperbola_where_all_its_coefficients_are_1) {
  const BackboneCurve curve = general_hyperbolic_curve(modulus, {}, strength, corners);
  for (const Real strain : spaced_strains(0.02 * reference, 50 * reference, corners))
    EXPECT_NEAR(curve.stress(strain), hyperbola(strain), 1e-12 * strength);
}

/// With coefficients of sand: y = x/(1/c_1 + x/c_2) up to the strength, and concave.
TEST(backbone_curve, of_the_general_hyperbolic_equation_begins_with_g0_and_ends_in_the_strength) {
  const GeneralHyperbola sand{0.17, 0.83, 2.5, 2.86, 3.229};
  const BackboneCurve curve = general_hyperbolic_curve(modulus, sand, strength, 100);
  EXPECT_EQ(curve.shear_modulus(), modulus);
  EXPECT_NEAR(curve.stress(1), strength, 1e-9 * strength);
  const Real end = sand.strain_at(1);
  EXPECT_GT(end, 4.5);
  EXPECT_LT(end, 5.5);
  EXPECT_NEAR(sand.stress(end), 1, 1e-9);
  for (const Real x : {0.05, 0.3, 1.0, 2.86, 4.5}) {
    const Real c1 = 0.585 + 0.415 * std::cos(std::numbers::pi / (2.86 / x + 1)),
               c2 = 1.665 - 0.835 * std::cos(std::numbers::pi / (3.229 / x + 1));
    EXPECT_NEAR(curve.stress(x * reference), strength * x / (1 / c1 + x / c2), 0.005 * strength) << x;
  }
  for (std::size_t i = 1; i < curve.slope().size(); ++i) EXPECT_LT(curve.slope()[i], curve.slope()[i - 1]);
}

TEST(backbone_curve, is_cut_off_at_a_lower_strength) {
  const BackboneCurve curve = hyperbolic_curve(modulus, reference, 0.5 * strength, corners);
  EXPECT_NEAR(curve.stress(reference), 0.5 * strength, 1e-12 * strength);
  EXPECT_NEAR(curve.stress(100 * reference), 0.5 * strength, 1e-12 * strength);
}

/// D = 4/pi (1 + 1/x)(1 - ln(1 + x)/x) - 2/pi with x = g/g_r, of the hyperbola.
TEST(backbone_curve, has_the_damping_of_the_hyperbola) {
  const BackboneCurve curve = hyperbolic_curve(modulus, reference, strength, corners);
  for (Real x = 0.3; x < 30; x *= 1.05) {
    const Real exact = 4 / std::numbers::pi * (1 + 1 / x) * (1 - std::log1p(x) / x) - 2 / std::numbers::pi;
    EXPECT_NEAR(curve.masing_damping(x * reference), exact, 0.02 * exact) << x;
  }
  EXPECT_EQ(curve.masing_damping(1e-3 * reference), 0);
}

/// D = 2/pi (r - 1)/(r + 1) (1 - G/G0), of Ramberg and Osgood's curve.
TEST(backbone_curve, has_the_damping_of_ramberg_and_osgood) {
  constexpr Real exponent = 2.6;
  const BackboneCurve curve = ramberg_osgood_curve(modulus, reference, exponent, 10 * strength, 200);
  for (Real x = 0.3; x < 10; x *= 1.3) {
    const Real exact = 2 / std::numbers::pi * (exponent - 1) / (exponent + 1) * (1 - curve.modulus_ratio(x * reference));
    EXPECT_NEAR(curve.masing_damping(x * reference), exact, 2e-3 * exact) << x;
  }
}

TEST(backbone_curve, of_a_table_passes_through_all_points_of_a_concave_one) {
  const std::vector<CurvePoint> points{{1e-5, 390}, {1e-4, 3.4e3}, {1e-3, 15e3}, {1e-2, 30e3}};
  const BackboneCurve curve(modulus, points, 32e3);
  for (const CurvePoint& point : points) EXPECT_NEAR(curve.stress(point.strain), point.stress, 1e-9 * point.stress);
  EXPECT_NEAR(curve.stress(1), 32e3, 1e-6);
  EXPECT_EQ(curve.shear_modulus(), modulus);
}

TEST(backbone_curve, lifts_a_point_that_is_dented_to_the_chord_of_its_neighbours) {
  const std::vector<CurvePoint> points{{1e-4, 4e3}, {1e-3, 15e3}, {2e-3, 16e3}, {3e-3, 20e3}};
  const BackboneCurve curve(modulus, points, 20e3);
  EXPECT_NEAR(curve.stress(2e-3), 17.5e3, 1e-6);
  EXPECT_NEAR(curve.stress(3e-3), 20e3, 1e-6);
}

TEST(backbone_curve, of_one_point_is_elastic_and_perfectly_plastic) {
  const std::vector<CurvePoint> points{{1e-3, 20e3}};
  const BackboneCurve curve(modulus, points, 20e3);
  ASSERT_EQ(curve.corner_strain().size(), 1u);
  EXPECT_NEAR(curve.corner_strain()[0], 5e-4, 1e-15);
  EXPECT_NEAR(curve.strain_at_ratio(0.5), 1e-3, 1e-15);
  EXPECT_NEAR(curve.masing_damping(1e-3), 1 / std::numbers::pi, 1e-12);  // 2/pi (1 - g_y/g)
}

}  // namespace
}  // namespace sazare::laws
