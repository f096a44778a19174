#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/hybrid/agreement.hpp"

namespace sazare::methods::hybrid {
namespace {

TEST(agreement, solves_a_linear_coupling_of_n_forces_in_n_plus_2_tries) {
  Eigen::Matrix3d matrix;
  matrix << -8, 1, 0.5, 2, -30, 1, 0, 3, 0.2;  // plain iteration would grow 30-fold with every try
  const Eigen::Vector3d constant(1, -2, 5);
  Agreement agreement;
  std::vector<Real> tried = {0, 0, 0};
  for (int pass = 0; pass < 4; ++pass) {
    const Eigen::Vector3d found = matrix * Eigen::Map<Eigen::Vector3d>(tried.data()) + constant;
    tried = agreement.next(tried, {found.begin(), found.end()});
  }
  const Eigen::Vector3d exact = (Eigen::Matrix3d::Identity() - matrix).inverse() * constant;
  EXPECT_LT((Eigen::Map<Eigen::Vector3d>(tried.data()) - exact).norm(), 1e-9 * exact.norm());
}

TEST(agreement, finds_a_curved_one) {
  Agreement agreement;
  std::vector<Real> tried = {0};
  for (int pass = 0; pass < 8; ++pass) tried = agreement.next(tried, {3 * std::cos(tried[0])});
  EXPECT_NEAR(tried[0], 3 * std::cos(tried[0]), 1e-9);
}

TEST(agreement, stays_where_force_and_motion_agree) {
  Agreement agreement;
  EXPECT_EQ(agreement.next({2, 3}, {2, 3}), (std::vector<Real>{2, 3}));
  EXPECT_EQ(agreement.next({2, 3}, {2, 3}), (std::vector<Real>{2, 3}));
}

}  // namespace
}  // namespace sazare::methods::hybrid
