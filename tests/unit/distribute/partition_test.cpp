#include <gtest/gtest.h>

#include <algorithm>

#include "sazare/levels/distribute/partition.hpp"

namespace sazare::distribute {
namespace {

/// A row of chunks with as much work at level 0 each; the first sixteenth of them also has work at level 5, as around a hole.
ChunkWork row(Index chunks) {
  ChunkWork work{chunks * 4, 4, {std::vector<Real>(ChunkWork::place(chunks, 0), 0)}, {}};
  for (Index chunk = 0; chunk < chunks; ++chunk) {
    work.due[0][work.place(chunk, 0)] = 10;
    if (chunk < chunks / 16) work.due[0][work.place(chunk, 5)] = 3;
    if (chunk > 0) work.borders.push_back({chunk - 1, chunk, 1});
  }
  return work;
}

Index borders_cut(const ChunkWork& work, const std::vector<int>& owner) {
  return static_cast<Index>(
      std::ranges::count_if(work.borders, [&](const ChunkBorder& of) { return owner[at(of.first)] != owner[at(of.second)]; }));
}

TEST(partition, lock_step_is_the_mean_over_the_largest_work_of_each_tick) {
  ChunkWork work{2, 1, {std::vector<Real>(ChunkWork::place(2, 0), 0)}, {}};
  work.due[0][work.place(0, 0)] = 3;
  work.due[0][work.place(1, 1)] = 1;
  const ChunkCosts costs(work, {2});
  // One tick with 6 and 2 to do, and one with 0 and 2: as long as 6 + 2, where 4 + 1 would do.
  EXPECT_DOUBLE_EQ(lock_step(costs, {0, 1}, 2), 5.0 / 8);
  EXPECT_DOUBLE_EQ(lock_step(costs, {0, 0}, 2), 0.5);
  EXPECT_DOUBLE_EQ(lock_step(costs, {0, 0}, 1), 1);
}

TEST(partition, equal_work_in_all_is_not_equal_work_at_each_tick) {
  const ChunkWork work = row(256);
  const ChunkCosts costs(work, {1});
  std::vector<Real> all;
  for (Index chunk = 0; chunk < costs.chunks(); ++chunk) all.push_back(costs.in_base_step(chunk));
  const Owners ranges = cut_evenly(all, 4);
  std::vector<int> owner;
  for (Index chunk = 0; chunk < costs.chunks(); ++chunk) owner.push_back(ranges.owner(chunk));
  EXPECT_LT(lock_step(costs, owner, 4), 0.6);
  EXPECT_GT(lock_step(costs, partition_by_level(costs, 4), 4), 0.98);
}

TEST(partition, by_graph_shares_out_every_level_with_few_borders) {
  if (!has_graph_partition()) GTEST_SKIP() << "built without METIS";
  const ChunkWork work = row(256);
  const ChunkCosts costs(work, {1});
  for (const int ranks : {2, 4, 8}) {
    const std::vector<int> owner = partition_graph(costs, work.borders, ranks);
    EXPECT_GT(lock_step(costs, owner, ranks), 0.95) << ranks;
    EXPECT_LT(borders_cut(work, owner), borders_cut(work, partition_at_random(256, ranks, 0)) / 3) << ranks;
    EXPECT_EQ(owner, partition_graph(costs, work.borders, ranks));
  }
}

TEST(partition, by_graph_is_by_level_where_ranks_would_have_few_chunks) {
  if (!has_graph_partition()) GTEST_SKIP() << "built without METIS";
  const ChunkWork work = row(16);
  const ChunkCosts costs(work, {1});
  for (const int ranks : {5, 16, 40})
    EXPECT_EQ(partition_graph(costs, work.borders, ranks), partition_by_level(costs, ranks)) << ranks;
}

TEST(partition, at_random_gives_every_rank_something_and_another_seed_something_else) {
  const std::vector<int> owner = partition_at_random(1000, 8, 1);
  for (int rank = 0; rank < 8; ++rank) EXPECT_GT(std::ranges::count(owner, rank), 80);
  EXPECT_EQ(owner, partition_at_random(1000, 8, 1));
  EXPECT_NE(owner, partition_at_random(1000, 8, 2));
}

TEST(partition, parts_take_the_numbers_with_which_most_stays) {
  const std::vector<int> now = {0, 0, 0, 1, 1, 1, 2, 2, 2}, next = {2, 2, 2, 2, 0, 0, 1, 1, 1};
  EXPECT_EQ(keep_numbers(now, next, 3), (std::vector<int>{0, 0, 0, 0, 1, 1, 2, 2, 2}));
  // Rank 0 held all, so that the parts that it does not keep take the ranks that are free, in order.
  EXPECT_EQ(keep_numbers({0, 0, 0, 0, 0}, {3, 3, 1, 0, 3}, 4), (std::vector<int>{0, 0, 2, 1, 0}));
  EXPECT_EQ(keep_numbers({0, 0}, {999'999, 5}, 1'000'000), (std::vector<int>{999'999, 0}));
}

TEST(partition, chunks_become_smaller_where_ranks_would_have_too_few) {
  EXPECT_EQ(chunk_size_for(1'000'000, 24), 128);
  EXPECT_EQ(chunk_size_for(16'000, 8), 16);
  EXPECT_EQ(chunk_size_for(100, 8), 8);
}

TEST(partition, bodies_of_a_chunk_have_its_owner) {
  const ChunkWork work{10, 4, {}, {}};
  const Owners owners = owners_of_bodies(work, {1, 0, 1}, 2);
  EXPECT_EQ(owners.size(0), 4);
  EXPECT_EQ(owners.owner(9), 1);
  EXPECT_EQ(owners_of_chunks(work, owners), (std::vector<int>{1, 0, 1}));
}

}  // namespace
}  // namespace sazare::distribute
