#include <gtest/gtest.h>

#include "sazare/levels/distribute/viewers.hpp"

namespace sazare::distribute {
namespace {

/// Six bodies in a row, each linked to the next one; the middle ones belong to the second of three ranks.
const Owners owners({0, 0, 1, 1, 2, 2}, 3);

Viewers row(bool looks_at_steps = false) {
  Viewers viewers;
  viewers.begin(6);
  for (Index body = 0; body < 5; ++body) viewers.add({body, body + 1}, looks_at_steps, owners);
  return viewers;
}

TEST(viewers, only_links_between_ranks_show_bodies) {
  Viewers viewers;
  viewers.begin(6);
  EXPECT_FALSE(viewers.add({0, 1}, false, owners));
  EXPECT_FALSE(viewers.add({1, Link::outside}, false, owners));
  EXPECT_TRUE(viewers.add({1, 2}, false, owners));
  ASSERT_EQ(viewers.of(1).size(), 1);
  EXPECT_EQ(viewers.of(1)[0].rank, 1);
  EXPECT_EQ(viewers.find(2, 0).rank, 0);
  EXPECT_TRUE(viewers.of(0).empty());
}

TEST(viewers, a_rank_sees_a_body_once_and_its_steps_where_one_link_looks_at_them) {
  Viewers viewers = row();
  viewers.add({1, 3}, true, owners);
  ASSERT_EQ(viewers.of(1).size(), 1);
  EXPECT_TRUE(viewers.of(1)[0].sees_steps);
  EXPECT_FALSE(viewers.of(2)[0].sees_steps);
  EXPECT_EQ(viewers.seen_of(1, owners), 2);
}

TEST(viewers, foretell_what_a_base_step_sends) {
  state::Bodies<3> rigid;
  const BorderBytes<3> bytes(rigid);
  EXPECT_EQ(bytes.always, 152);
  EXPECT_EQ(bytes.of_steps, 48);
  // The second rank shows a body at level 2 to the first one, four times in a base step, and one at level 0 to the third.
  const auto level = [](Index body) { return body == 2 ? 2 : 0; };
  const parallel::Sent motion = row().motion_of(1, owners, bytes, level);
  EXPECT_EQ(motion.bytes, 152 * 4 + 152);
  EXPECT_EQ(motion.messages, 4 + 1);
  EXPECT_EQ(row(true).motion_of(1, owners, bytes, level).bytes, 200 * 4 + 200);
  // What one rank sees goes in one message at a tick, whatever the levels of the bodies.
  Viewers more = row();
  more.add({0, 3}, false, owners);
  const parallel::Sent both = more.motion_of(1, owners, bytes, level);
  EXPECT_EQ(both.messages, 4 + 1);
  EXPECT_EQ(both.bytes, 152 * 4 + 2 * 152);
}

TEST(viewers, strained_bodies_send_their_strain) {
  state::Bodies<3> strained;
  strained.strain.resize(1);
  EXPECT_EQ(BorderBytes<3>(strained).always, 152 + sizeof(state::Strain));
}

}  // namespace
}  // namespace sazare::distribute
