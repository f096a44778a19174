#include <gtest/gtest.h>

#include <vector>

#include "sazare/levels/terms/work.hpp"

namespace sazare::terms {
namespace {

TEST(work, of_loads_comes_in_and_all_other_is_taken) {
  EnergySums energies;
  add_work(Cause::load, 3, energies);
  add_work(Cause::joint_dashpot, -1, energies);
  add_work(Cause::contact_dashpot, -0.5, energies);
  add_work(Cause::friction, -0.25, energies);
  add_work(Cause::boundary, -0.125, energies);
  const EnergyBalance balance = energies.balance();
  EXPECT_EQ(balance[EnergyKind::work], 3);
  EXPECT_EQ(balance[EnergyKind::joint_dashpot], 1);
  EXPECT_EQ(balance[EnergyKind::contact_dashpot], 0.5);
  EXPECT_EQ(balance[EnergyKind::friction], 0.25);
  EXPECT_EQ(balance[EnergyKind::boundary], 0.125);
}

TEST(work, on_several_bodies_is_that_on_each_of_them) {
  std::vector<CauseWork> works(21);
  for (std::size_t body = 0; body < works.size(); ++body)
    for (std::size_t cause = 0; cause < cause_count; ++cause)
      if ((body + cause) % 3 > 0) works[body][cause] = 0.1 * static_cast<Real>(body) - static_cast<Real>(cause);
  EnergySums together, apart;
  add_work(works, together);
  for (const CauseWork& work : works)
    for (std::size_t cause = 0; cause < cause_count; ++cause) add_work(static_cast<Cause>(cause), work[cause], apart);
  EXPECT_EQ(together.balance().joules, apart.balance().joules);
}

}  // namespace
}  // namespace sazare::terms
