#include <gtest/gtest.h>

#include <random>

#include "sazare/levels/schedule/link_clock.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::schedule {
namespace {

/// Ticks of one second, so that all times are whole numbers and sums are exact.
Instant at(Tick tick) { return {tick, 1.0}; }

std::vector<Due> collect(LinkClock& clock, Tick tick) {
  const std::span<const Due> due = clock.collect(at(tick));
  return {due.begin(), due.end()};
}

TEST(link_clock, at_one_level_the_first_window_is_half_a_step_and_the_others_whole) {
  LinkClock clock;
  clock.add(0, 3, 0);
  const auto step = static_cast<Real>(stride(3));
  for (int i = 0; i < 10; ++i) {
    const auto due = collect(clock, i * stride(3));
    ASSERT_EQ(due.size(), 1u);
    EXPECT_EQ(due[0].acting, i == 0 ? step / 2 : step);
    EXPECT_EQ(due[0].ahead, step / 2);
  }
  EXPECT_TRUE(collect(clock, 10 * stride(3) + stride(4)).empty());
}

TEST(link_clock, a_link_that_begins_later_acts_from_then_on) {
  LinkClock clock;
  const Tick now = 5 * stride(4);
  clock.add(7, 4, now);
  EXPECT_EQ(clock.level(7), 4);
  EXPECT_TRUE(clock.holds(7));
  const auto due = collect(clock, now + stride(4));
  ASSERT_EQ(due.size(), 1u);
  EXPECT_EQ(due[0].link, 7);
  EXPECT_EQ(due[0].acting, 1.5 * static_cast<Real>(stride(4)));
}

TEST(link_clock, only_what_is_due_is_collected) {
  LinkClock clock;
  for (Index link = 0; link < 5; ++link) clock.add(link, static_cast<int>(link), 0);
  EXPECT_EQ(collect(clock, 0).size(), 5u);
  EXPECT_EQ(collect(clock, stride(4)).size(), 1u);
  EXPECT_EQ(collect(clock, stride(3)).size(), 2u);
  clock.remove(4);
  EXPECT_EQ(collect(clock, stride(4) * 3).size(), 0u);
}

/// A walk of one link through random changes of level. A level is refined whenever the link is due (its bodies step),
/// or in between (a body is woken) to a level in phase; it is coarsened at base steps only.
class Walk {
public:
  explicit Walk(unsigned seed) : random_(seed) { clock_.add(0, 0, 0); }

  void run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      check(collect(clock_, now_));
      const int level = clock_.level(0);
      if (level < 8 && random_() % 4 == 0) clock_.set_level(0, level + 1 + static_cast<int>(random_() % 2));
      now_ = next_due();
      if (random_() % 5 == 0) wake();
      if (now_ % base_stride == 0) clock_.set_level(0, static_cast<int>(random_() % 4));
    }
  }

  int windows() const { return windows_; }

private:
  Tick next_due() const { return now_ - now_ % stride(clock_.level(0)) + stride(clock_.level(0)); }

  /// Goes back to a moment before the link is due, at which a finer level is in phase.
  void wake() {
    const int finer = std::min(clock_.level(0) + 3, 12);
    const Tick early = now_ - 3 * stride(finer);
    if (early <= last_ || !due_at(finer, early)) return;
    now_ = early;
    clock_.set_level(0, finer);
  }

  void check(const std::vector<Due>& due) {
    ASSERT_EQ(due.size(), 1u) << "at " << now_;
    EXPECT_GE(due[0].acting, 0);
    const Real begin = until_, end = static_cast<Real>(now_) + due[0].ahead;
    EXPECT_EQ(begin + due[0].acting, end) << "gap or overlap at " << now_;
    EXPECT_GE(end, static_cast<Real>(now_)) << "a force must act at least until now";
    EXPECT_LE(end, static_cast<Real>(now_ + base_stride / 2));
    until_ = end;
    last_ = now_;
    ++windows_;
  }

  std::mt19937_64 random_;
  LinkClock clock_;
  Tick now_ = 0, last_ = 0;
  Real until_ = 0;
  int windows_ = 0;
};

TEST(link_clock, windows_join_without_gap_or_overlap_over_any_changes_of_level) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Walk walk(seed);
    walk.run(500);
    EXPECT_EQ(walk.windows(), 500);
  }
}

TEST(link_clock, goes_on_from_a_checkpoint) {
  LinkClock clock, copy;
  for (Index link = 0; link < 4; ++link) clock.add(link, static_cast<int>(link), 0);
  clock.remove(2);
  collect(clock, 0);
  collect(clock, stride(3));
  test::MemoryArchive saved;
  clock.columns(saved);
  saved.turn_round();
  copy.columns(saved);
  EXPECT_EQ(copy.size(), 3u);
  EXPECT_FALSE(copy.holds(2));
  for (Tick tick = 2 * stride(3); tick <= 2 * base_stride; tick += stride(3)) {
    const auto one = collect(clock, tick), other = collect(copy, tick);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].link, other[i].link);
      EXPECT_EQ(one[i].acting, other[i].acting);
      EXPECT_EQ(one[i].ahead, other[i].ahead);
    }
  }
}

}  // namespace
}  // namespace sazare::schedule
