#include "sazare/terms/ledger.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(ledger, every_account_has_its_own_name) {
  auto names = account_names;
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
  EXPECT_EQ(account_names[static_cast<std::size_t>(Account::work)], "work");
  EXPECT_EQ(account_names[static_cast<std::size_t>(Account::boundary)], "boundary");
}

}  // namespace
}  // namespace sazare::terms
