#include "sazare/laws/block_elasticity.hpp"

#include <gtest/gtest.h>

namespace sazare::laws {
namespace {

constexpr std::array ratios{0.0, 0.05, 0.1, 0.2, 0.25, 0.3, 0.4, most_poisson_ratio};

TEST(block_elasticity, springs_tell_the_body_for_which_they_were_made) {
  for (const Real poisson : ratios) {
    const auto body = elastic_moduli(spring_moduli({50e9, poisson}));
    EXPECT_NEAR(body.young, 50e9, 1e-12 * 50e9);
    EXPECT_NEAR(body.poisson, poisson, 1e-14);
  }
}

TEST(block_elasticity, springs_are_proportional_to_youngs_modulus) {
  const auto soft = spring_moduli({1e9, 0.3}), stiff = spring_moduli({7e9, 0.3});
  EXPECT_DOUBLE_EQ(stiff.normal, 7 * soft.normal);
  EXPECT_DOUBLE_EQ(stiff.shear, 7 * soft.shear);
}

/// Without a Poisson's ratio all springs are alike; with it those along the face weaken and those across become stiffer.
TEST(block_elasticity, the_springs_along_faces_weaken_with_poissons_ratio) {
  const auto alike = spring_moduli({1, 0});
  EXPECT_DOUBLE_EQ(alike.shear, alike.normal);
  SpringModuli before = alike;
  for (const Real poisson : ratios) {
    if (poisson == 0) continue;
    const auto springs = spring_moduli({1, poisson});
    EXPECT_GT(springs.normal, before.normal);
    EXPECT_LT(springs.shear / springs.normal, before.shear / before.normal);
    EXPECT_TRUE(is_fitted(springs.shear / springs.normal));
    before = springs;
  }
}

/// Under uniform compression faces are pressed and not sheared, up to what lies askew between elements.
TEST(block_elasticity, three_bulk_moduli_are_the_modulus_across_the_face_up_to_a_twentieth) {
  for (const Real poisson : ratios) {
    const Real bulk = 1 / (3 * (1 - 2 * poisson)), share = 3 * bulk / spring_moduli({1, poisson}).normal;
    EXPECT_GE(share, 1);
    EXPECT_LT(share, 1.06);
  }
}

TEST(block_elasticity, moduli_of_a_body_belong_together) {
  const ElasticModuli body{10e9, 0.25};
  EXPECT_DOUBLE_EQ(body.shear(), 4e9);
  EXPECT_DOUBLE_EQ(body.confined(), 12e9);
}

}  // namespace
}  // namespace sazare::laws
