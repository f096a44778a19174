#include <gtest/gtest.h>

#include "sazare/levels/terms/energy_balance.hpp"

namespace sazare::terms {
namespace {

TEST(energy_balance, the_residual_is_the_work_that_is_neither_stored_nor_dissipated) {
  EnergyBalance balance;
  balance[EnergyKind::work] = 100;
  balance[EnergyKind::kinetic] = 40;
  balance[EnergyKind::friction] = 30;
  balance[EnergyKind::boundary] = 25;
  EXPECT_EQ(balance.residual(), 5);
}

}  // namespace
}  // namespace sazare::terms
