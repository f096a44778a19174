#include <gtest/gtest.h>

#include "sazare/levels/terms/ledger.hpp"

namespace sazare::terms {
namespace {

TEST(ledger, the_residual_is_the_work_that_is_found_nowhere) {
  Ledger ledger;
  ledger[Account::work] = 100;
  ledger[Account::kinetic] = 40;
  ledger[Account::friction] = 30;
  ledger[Account::boundary] = 25;
  EXPECT_EQ(ledger.residual(), 5);
}

}  // namespace
}  // namespace sazare::terms
