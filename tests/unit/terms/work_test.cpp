#include <gtest/gtest.h>

#include <vector>

#include "sazare/levels/terms/work.hpp"

namespace sazare::terms {
namespace {

TEST(work, of_loads_comes_in_and_all_other_is_taken) {
  Books books;
  book(Cause::load, 3, books);
  book(Cause::joint_dashpot, -1, books);
  book(Cause::contact_dashpot, -0.5, books);
  book(Cause::friction, -0.25, books);
  book(Cause::boundary, -0.125, books);
  const Ledger ledger = books.ledger();
  EXPECT_EQ(ledger[Account::work], 3);
  EXPECT_EQ(ledger[Account::joint_dashpot], 1);
  EXPECT_EQ(ledger[Account::contact_dashpot], 0.5);
  EXPECT_EQ(ledger[Account::friction], 0.25);
  EXPECT_EQ(ledger[Account::boundary], 0.125);
}

TEST(work, on_several_bodies_is_that_on_each_of_them) {
  std::vector<CauseWork> works(21);
  for (std::size_t body = 0; body < works.size(); ++body)
    for (std::size_t cause = 0; cause < cause_count; ++cause)
      if ((body + cause) % 3 > 0) works[body][cause] = 0.1 * static_cast<Real>(body) - static_cast<Real>(cause);
  Books together, apart;
  book(works, together);
  for (const CauseWork& work : works)
    for (std::size_t cause = 0; cause < cause_count; ++cause) book(static_cast<Cause>(cause), work[cause], apart);
  EXPECT_EQ(together.ledger().joules, apart.ledger().joules);
}

}  // namespace
}  // namespace sazare::terms
