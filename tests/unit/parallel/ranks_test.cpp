#include "sazare/parallel/ranks.hpp"

#include <gtest/gtest.h>

namespace sazare::parallel {
namespace {

TEST(ranks, one_process_is_first_and_alone) {
  const Ranks ranks;
  EXPECT_EQ(ranks.rank(), 0);
  EXPECT_EQ(ranks.size(), 1);
  EXPECT_TRUE(ranks.is_first());
  ranks.barrier();
}

TEST(ranks, abort_ends_the_process_with_the_code) { EXPECT_EXIT(Ranks().abort(4), testing::ExitedWithCode(4), ""); }

}  // namespace
}  // namespace sazare::parallel
