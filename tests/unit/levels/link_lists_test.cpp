#include <gtest/gtest.h>

#include <random>

#include "sazare/levels/link_lists.hpp"

namespace sazare::levels {
namespace {

std::vector<LinkOf> list_of(const LinkLists& lists, Index body) {
  const auto links = lists.of(body);
  return {links.begin(), links.end()};
}

TEST(link_lists, keep_their_order) {
  const std::vector<Index> room = {2, 0, 1};
  LinkLists lists(room);
  for (const Index link : {5, 3, 9}) lists.add(0, {0, link});
  lists.add(2, {1, 3});
  EXPECT_EQ(list_of(lists, 0), (std::vector<LinkOf>{{0, 5}, {0, 3}, {0, 9}}));
  EXPECT_EQ(list_of(lists, 1), std::vector<LinkOf>{});
  lists.remove(0, {1, 3});  // of another term
  lists.remove(0, {0, 5});
  EXPECT_EQ(list_of(lists, 0), (std::vector<LinkOf>{{0, 3}, {0, 9}}));
  EXPECT_EQ(list_of(lists, 2), (std::vector<LinkOf>{{1, 3}}));
  lists.clear();
  EXPECT_EQ(list_of(lists, 2), std::vector<LinkOf>{});
}

TEST(link_lists, are_those_of_vectors_whatever_comes_and_goes) {
  constexpr Index bodies = 40;
  std::vector<std::vector<LinkOf>> expected(bodies);
  LinkLists lists(std::vector<Index>(bodies, 1));
  std::mt19937 random(3);
  for (int change = 0; change < 20000; ++change) {
    const auto body = static_cast<Index>(random() % bodies);
    auto& own = expected[static_cast<std::size_t>(body)];
    const bool grows = change % 4000 < 2500;  // in waves, so that places are left behind and gathered
    if (own.empty() || (random() % 3 == 0) != grows) {
      const LinkOf link{static_cast<Index>(random() % 3), change};
      own.push_back(link);
      lists.add(body, link);
    } else {
      const LinkOf link = own[random() % own.size()];
      std::erase(own, link);
      lists.remove(body, link);
    }
    ASSERT_EQ(list_of(lists, body), own) << change;
  }
  for (Index body = 0; body < bodies; ++body) EXPECT_EQ(list_of(lists, body), expected[static_cast<std::size_t>(body)]);
}

}  // namespace
}  // namespace sazare::levels
