#include <gtest/gtest.h>

#include "sazare/parallel/same_program.hpp"

namespace sazare::parallel {
namespace {

TEST(same_program, equal_builds_need_no_words) {
  EXPECT_EQ(different_programs({build_identity(), build_identity(), build_identity()}), "");
  EXPECT_EQ(different_programs({"a"}), "");
  require_same_program(Ranks());
}

TEST(same_program, the_build_of_each_rank_that_differs_is_told) {
  const std::string words = different_programs({"vectors of 8", "vectors of 8", "vectors of 4"});
  EXPECT_NE(words.find("rank 0: vectors of 8"), std::string::npos);
  EXPECT_EQ(words.find("rank 1"), std::string::npos);
  EXPECT_NE(words.find("rank 2: vectors of 4"), std::string::npos);
}

TEST(same_program, the_identity_names_what_decides_bits) {
  for (const char* part : {"version", "commit", "compiler", "vectors of", "fused multiplication"})
    EXPECT_NE(build_identity().find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace sazare::parallel
