/// One process alone; that several give the same bits is tested with processes (tests/regression/test_ranks.py).

#include <gtest/gtest.h>

#include "sazare/levels/distribute/replicas.hpp"
#include "tests/support/networks.hpp"

namespace sazare::distribute {
namespace {

TEST(replicas, alone_owns_all_and_brings_nothing) {
  const parallel::Ranks ranks;
  auto network = test::ladder<2>();
  std::vector<std::unique_ptr<terms::Term<2>>> terms;
  terms.push_back(std::make_unique<terms::Springs<2>>(network.springs, network.bodies));
  Replicas<2> replicas(ranks, network.bodies, terms);
  const std::vector<Index> all = {0, 1, 2};
  for (const Index body : all) EXPECT_TRUE(replicas.owns(body));
  std::vector<Index> own, seen;
  replicas.share_out(all, own, seen);
  EXPECT_EQ(own, all);
  EXPECT_TRUE(seen.empty());
  const auto before = network.bodies.motion;
  std::vector<terms::CauseWork> work(before.size());
  replicas.fetch_all();
  replicas.collect(work, parallel::To::all);
  for (std::size_t body = 0; body < before.size(); ++body) EXPECT_EQ(network.bodies.motion[body].position, before[body].position);
}

TEST(replicas, lists_become_rising_and_each_number_once) {
  const parallel::Ranks ranks;
  auto network = test::ladder<2>();
  const std::vector<std::unique_ptr<terms::Term<2>>> terms;
  const Replicas<2> replicas(ranks, network.bodies, terms);
  std::vector<Index> list = {5, 1, 5, 3};
  replicas.unite(list);
  EXPECT_EQ(list, (std::vector<Index>{1, 3, 5}));
}

}  // namespace
}  // namespace sazare::distribute
