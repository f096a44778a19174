#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sazare/coupling/file_channel.hpp"
#include "sazare/coupling/surface_messages.hpp"
#include "support.hpp"

namespace sazare::coupling {
namespace {

using test::force_of;
using test::motion_of;
using test::options_of;
using test::Pair;
using test::TemporaryFolder;
using test::two_segments;
using test::words_of;

TEST(file_channel, messages_arrive_with_the_same_bits) {
  const TemporaryFolder folder;
  auto led = std::async(std::launch::async, [&] {
    FileContinuumChannel continuum(options_of(folder, Side::continuum));
    std::vector<SurfaceForce> forces = {continuum.open(two_segments())};
    for (const auto& [window, pass] : {std::pair{0, 0}, {0, 1}, {1, 0}})
      forces.push_back(continuum.exchange(motion_of(window, pass)));
    continuum.close();
    return forces;
  });
  FileBodyChannel bodies(options_of(folder, Side::bodies));
  const SurfaceShape shape = bodies.open();
  EXPECT_NO_THROW(check_same(two_segments(), shape, "test"));
  bodies.answer(force_of(-1));
  std::vector<std::pair<std::int64_t, std::int32_t>> seen;
  while (const auto motion = bodies.receive()) {
    const SurfaceMotion sent = motion_of(motion->window, motion->pass);
    EXPECT_EQ(motion->displacement, sent.displacement);
    EXPECT_TRUE(std::signbit(motion->displacement[2]));
    EXPECT_EQ(motion->velocity, sent.velocity);
    EXPECT_EQ(motion->time, sent.time);
    seen.emplace_back(motion->window, motion->pass);
    bodies.answer(force_of(motion->window, motion->pass));
  }
  EXPECT_EQ(seen, (std::vector<std::pair<std::int64_t, std::int32_t>>{{0, 0}, {0, 1}, {1, 0}}));
  const std::vector<SurfaceForce> forces = led.get();
  ASSERT_EQ(forces.size(), 4u);
  EXPECT_EQ(forces[0].window, -1);
  EXPECT_EQ(forces[2].pass, 1);
  EXPECT_EQ(forces[3].mean, force_of(1).mean);
  EXPECT_EQ(forces[3].last, force_of(1).last);
}

TEST(file_channel, surface_in_space_has_newtons) {
  SurfaceShape shape{3, 1, 0.5, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  EXPECT_EQ(to_message(SurfaceForce{}, shape).tables[0].unit, "N");
  EXPECT_EQ(to_message(SurfaceForce{}, two_segments()).tables[0].unit, "N/m");
  EXPECT_NO_THROW(check_same(shape, to_shape(decode(encode(to_message(shape)), "file")), "test"));
}

TEST(file_channel, shapes_that_are_none) {
  const auto words = [](const SurfaceShape& shape) { return words_of<UserError>([&] { check_shape(shape); }); };
  SurfaceShape shape = two_segments();
  shape.faces[3] = 3;
  EXPECT_WORDS(words(shape), "face 1 has node 3, and there are 3 nodes, counted from 0");
  shape.faces[3] = 1;
  EXPECT_WORDS(words(shape), "face 1 has node 1 twice");
  shape = two_segments();
  shape.window = 0;
  EXPECT_WORDS(words(shape), "its windows are 0 s long");
  shape.window = std::numeric_limits<Real>::infinity();
  EXPECT_WORDS(words(shape), "its windows are inf s long");
  shape = two_segments();
  shape.width = std::numeric_limits<Real>::infinity();
  EXPECT_WORDS(words(shape), "it is inf m wide");
  shape.nodes.clear();
  EXPECT_WORDS(words(shape), "it has no nodes, or no faces");
}

TEST(file_channel, surfaces_that_do_not_match) {
  const auto words = [](const SurfaceShape& shape) {
    return words_of<UserError>([&] { check_same(two_segments(), shape, "here"); });
  };
  SurfaceShape shape = two_segments();
  EXPECT_EQ(words(shape), "");
  shape.nodes[3] = 0.5;
  EXPECT_WORDS(words(shape), "here: the surfaces do not match: number 1 of the nodes has 0.5 in column 1, and 0 is expected");
  shape = two_segments();
  shape.faces.resize(2);
  EXPECT_WORDS(words(shape), "1 faces, and 2 are expected");
  shape = two_segments();
  shape.width = 2;
  EXPECT_WORDS(words(shape), "its width [m] is 2, and 0.4 is expected");
  shape = two_segments();
  shape.window = 2;
  EXPECT_WORDS(words(shape), "its window [s] is 2, and 0.001 is expected");
}

TEST(file_channel, forces_of_another_surface) {
  Pair pair;
  SurfaceForce force = force_of(0);
  force.mean.resize(4);
  auto asked =
      std::async(std::launch::async, [&] { return words_of<UserError>([&] { pair.continuum.exchange(motion_of(0)); }); });
  pair.bodies.receive();
  pair.bodies.answer(force);
  EXPECT_WORDS(asked.get(), "the surfaces do not match: 'mean' has 2 rows, and the surface has 3 nodes");
}

TEST(file_channel, answer_to_another_window) {
  Pair pair;
  auto asked =
      std::async(std::launch::async, [&] { return words_of<MachineError>([&] { pair.continuum.exchange(motion_of(0)); }); });
  pair.bodies.receive();
  pair.bodies.answer(force_of(1));
  EXPECT_WORDS(asked.get(), "is out of step: the bodies answer window 1, pass 0, and the motion was of window 0, pass 0");
}

TEST(file_channel, no_number_leaves_and_none_is_taken) {
  Pair pair;
  SurfaceMotion motion = motion_of(0);
  motion.velocity[3] = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_WORDS(words_of<PhysicsError>([&] { pair.continuum.exchange(motion); }), "this side: velocity of node 1 in window 0");
  Message message = to_message(motion, two_segments());
  message.run = pair.continuum.files().run();
  message.sequence = 1;
  test::write_text(pair.file(Side::continuum, 1), encode(message));
  EXPECT_WORDS(words_of<PhysicsError>([&] { pair.bodies.receive(); }), "the continuum's program: velocity of node 1 in window 0");
}

TEST(file_channel, message_of_another_kind) {
  Pair pair;
  pair.continuum.files().send(to_message(two_segments()));
  EXPECT_WORDS(words_of<UserError>([&] { pair.bodies.receive(); }),
               "is a message of kind 'shape', but one of kind 'motion' is expected");
}

}  // namespace
}  // namespace sazare::coupling
