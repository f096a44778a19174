#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "sazare/coupling/file_exchange.hpp"
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

/// A run of windows from one to another, both ends in this process; the bodies' answer depends on all motions so far.
struct Walk {
  const TemporaryFolder& folder;
  ExchangeMark marks[2] = {};  ///< of continuum and bodies
  Real seen = 0;

  void go(std::int64_t first_of_continuum, std::int64_t first_of_bodies, std::int64_t end) {
    auto led = std::async(std::launch::async, [&] {
      FileContinuumChannel continuum(options_of(folder, Side::continuum, marks[0]));
      if (first_of_continuum == 0)
        continuum.open(two_segments());
      else
        continuum.reopen(two_segments());
      for (std::int64_t window = first_of_continuum; window < end; ++window) {
        const SurfaceForce force = continuum.exchange(motion_of(window));
        EXPECT_EQ(force.mean, force_of(window).mean);
      }
      marks[0] = {continuum.files().run(), continuum.files().next()};
      continuum.files().part(Farewell::stopped, end);
    });
    FileBodyChannel bodies(options_of(folder, Side::bodies, marks[1]));
    bodies.open();
    if (first_of_bodies == 0) bodies.answer(force_of(-1));
    try {
      for (std::int64_t window = first_of_bodies;; ++window) {
        marks[1] = {bodies.files().run(), bodies.files().next()};
        const auto motion = bodies.receive();
        ASSERT_TRUE(motion.has_value());
        EXPECT_EQ(motion->window, window);
        EXPECT_EQ(motion->displacement, motion_of(window).displacement);
        bodies.answer(force_of(window));
      }
    } catch (const Stopped& stopped) {
      EXPECT_TRUE(stopped.by_partner);
      EXPECT_EQ(stopped.window, end);
      bodies.files().part(Farewell::stopped, end);
    }
    led.get();
  }
};

TEST(file_exchange, stopped_run_goes_on) {
  const TemporaryFolder folder;
  Walk walk{folder};
  walk.go(0, 0, 3);
  EXPECT_EQ(walk.marks[0].next, 4);
  EXPECT_EQ(walk.marks[1].next, 4);
  walk.go(3, 3, 6);
}

TEST(file_exchange, side_that_is_behind_catches_up_from_the_messages_that_are_kept) {
  for (const Side behind : {Side::continuum, Side::bodies}) {
    const TemporaryFolder folder;
    Walk walk{folder};
    walk.go(0, 0, 2);
    const auto old_marks = walk.marks[static_cast<int>(behind)];
    walk.go(2, 2, 7);
    walk.marks[static_cast<int>(behind)] = old_marks;
    walk.go(behind == Side::continuum ? 2 : 7, behind == Side::bodies ? 2 : 7, 9);
  }
}

TEST(file_exchange, side_that_lost_everything_catches_up_too) {
  const TemporaryFolder folder;
  Walk walk{folder};
  walk.go(0, 0, 4);
  walk.marks[1] = {};
  walk.go(4, 0, 6);
}

TEST(file_exchange, messages_that_both_have_behind_them_are_removed) {
  Pair pair;
  for (std::int64_t window = 0; window < 10; ++window) {
    auto asked = std::async(std::launch::async, [&] { pair.continuum.exchange(motion_of(window)); });
    pair.bodies.receive();
    pair.bodies.answer(force_of(window));
    asked.get();
  }
  pair.continuum.files().keep_from(11);
  EXPECT_TRUE(std::filesystem::exists(pair.file(Side::continuum, 1))) << "the bodies have no checkpoint yet";
  pair.bodies.files().keep_from(8);
  EXPECT_FALSE(std::filesystem::exists(pair.file(Side::bodies, 7)));
  EXPECT_TRUE(std::filesystem::exists(pair.file(Side::bodies, 8)));
  pair.continuum.files().keep_from(11);
  EXPECT_FALSE(std::filesystem::exists(pair.file(Side::continuum, 7)));
  EXPECT_TRUE(std::filesystem::exists(pair.file(Side::continuum, 8)));
  EXPECT_TRUE(std::filesystem::exists(pair.file(Side::continuum, 0))) << "the shape stays";
}

TEST(file_exchange, without_checkpoints_few_files_lie_there) {
  const TemporaryFolder folder;
  ExchangeOptions of_continuum = options_of(folder, Side::continuum), of_bodies = options_of(folder, Side::bodies);
  of_continuum.keeps_checkpoints = of_bodies.keeps_checkpoints = false;
  auto led = std::async(std::launch::async, [&] {
    FileContinuumChannel continuum(of_continuum);
    continuum.open(two_segments());
    for (std::int64_t window = 0; window < 50; ++window) continuum.exchange(motion_of(window));
    continuum.close();
  });
  FileBodyChannel bodies(of_bodies);
  bodies.open();
  bodies.answer(force_of(-1));
  while (const auto motion = bodies.receive()) {
    EXPECT_LE(folder.files().size(), 14u);
    bodies.answer(force_of(motion->window));
  }
  led.get();
}

TEST(file_exchange, partner_who_never_comes) {
  const TemporaryFolder folder;
  FileContinuumChannel continuum(options_of(folder, Side::continuum, {}, 0.05));
  const std::string words = words_of<MachineError>([&] { continuum.open(two_segments()); });
  EXPECT_WORDS(words, "the bodies' program did not come within 0.05 s");
  EXPECT_WORDS(words, folder.path().string());
}

TEST(file_exchange, what_an_older_run_has_left_is_nobody) {
  const TemporaryFolder folder;
  Walk{folder}.go(0, 0, 2);
  FileBodyChannel bodies(options_of(folder, Side::bodies, {}, 0.2));
  EXPECT_WORDS(words_of<MachineError>([&] { bodies.open(); }), "the continuum's program did not come within 0.2 s");
}

TEST(file_exchange, partner_who_is_silent) {
  const TemporaryFolder folder;
  FileBodyChannel bodies(options_of(folder, Side::bodies));
  auto met = std::async(std::launch::async, [&] { bodies.files().meet(); });
  FileContinuumChannel continuum(options_of(folder, Side::continuum, {}, 0.3));
  EXPECT_WORDS(words_of<MachineError>([&] { continuum.open(two_segments()); }), "the bodies' program has sent nothing for 0.3 s");
  met.get();
}

TEST(file_exchange, partner_who_is_killed) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    FileBodyChannel bodies(options_of(folder, Side::bodies));
    bodies.open();
    raise(SIGKILL);
  }
  FileContinuumChannel continuum(options_of(folder, Side::continuum));
  auto reaped = std::async(std::launch::async, [&] { waitpid(child, nullptr, 0); });
  const std::string words = words_of<MachineError>([&] { continuum.open(two_segments()); });
  EXPECT_WORDS(words, "(process " + std::to_string(child) + " on ");
  EXPECT_WORDS(words, "died without notice. Resume both sides");
}

TEST(file_exchange, partner_without_a_lock_is_known_by_its_process) {
  const TemporaryFolder folder;
  const Seat seat(folder.path(), Side::continuum);
  Presence bodies;
  bodies.side = Side::bodies;
  bodies.locks = false;
  bodies.host = "another machine";
  EXPECT_EQ(seat.life_of(bodies), Seat::Life::unknown);
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  bodies.host = name.data();
  bodies.process = getpid();
  EXPECT_EQ(seat.life_of(bodies), Seat::Life::alive);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  bodies.process = child;
  EXPECT_EQ(seat.life_of(bodies), Seat::Life::gone);
}

TEST(file_exchange, partner_who_was_started_again) {
  auto pair = std::make_unique<Pair>();
  auto asked =
      std::async(std::launch::async, [&] { return words_of<MachineError>([&] { pair->continuum.exchange(motion_of(0)); }); });
  Presence again;
  again.session = "another";
  test::write_text(pair->folder.path() / "bodies.here", [&] {
    again.side = Side::bodies;
    again.host = "h";
    return again.written();
  }());
  EXPECT_WORDS(asked.get(), "the bodies' program died, and was started again");
}

TEST(file_exchange, partner_who_fails_says_why) {
  Pair pair;
  auto asked =
      std::async(std::launch::async, [&] { return words_of<MachineError>([&] { pair.continuum.exchange(motion_of(0)); }); });
  pair.bodies.receive();
  pair.bodies.files().part(Farewell::failed, 0, "a sphere\nflew away");
  EXPECT_WORDS(asked.get(), "the bodies' program failed: a sphere flew away");
}

TEST(file_exchange, side_that_goes_without_a_word_is_heard) {
  const TemporaryFolder folder;
  auto asked = std::async(std::launch::async, [&] {
    FileContinuumChannel continuum(options_of(folder, Side::continuum));
    return words_of<MachineError>([&] { continuum.open(two_segments()); });
  });
  {
    FileBodyChannel bodies(options_of(folder, Side::bodies));
    bodies.open();
  }
  EXPECT_WORDS(asked.get(), "the bodies' program failed: it ended before the run was complete");
}

TEST(file_exchange, second_program_on_the_same_side) {
  const TemporaryFolder folder;
  const FileExchange first(options_of(folder, Side::bodies));
  EXPECT_WORDS(words_of<UserError>([&] { FileExchange second(options_of(folder, Side::bodies)); }),
               "another program is the bodies in this folder");
}

TEST(file_exchange, stop_while_waiting) {
  const TemporaryFolder folder;
  std::atomic<bool> stop{false};
  ExchangeOptions options = options_of(folder, Side::continuum);
  options.stop = &stop;
  FileExchange exchange(options);
  auto met = std::async(std::launch::async, [&] { exchange.meet(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  stop = true;
  EXPECT_THROW(met.get(), Stopped);
}

TEST(file_exchange, half_written_file_is_waited_for_and_then_told) {
  Pair pair;
  auto answered = std::async(std::launch::async, [&] { return pair.continuum.exchange(motion_of(0)); });
  pair.bodies.receive();
  pair.bodies.answer(force_of(0));
  answered.get();
  const std::string whole = test::read_text(pair.file(Side::bodies, 1));
  const auto with_sequence_2 = [&] {
    Message message = decode(whole, "file");
    message.details = {};
    message.sequence = 2;
    message.window = 1;
    return encode(message);
  }();

  auto asked = std::async(std::launch::async, [&] { return pair.continuum.exchange(motion_of(1)); });
  test::write_text(pair.file(Side::bodies, 2), with_sequence_2.substr(0, 200));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  test::write_text(pair.file(Side::bodies, 2), with_sequence_2);
  EXPECT_EQ(asked.get().window, 1) << "a partner may be slow in writing";

  auto refused =
      std::async(std::launch::async, [&] { return words_of<DamagedFile>([&] { pair.continuum.exchange(motion_of(2)); }); });
  test::write_text(pair.file(Side::bodies, 3), with_sequence_2.substr(0, 200));
  const std::string words = refused.get();
  EXPECT_WORDS(words, "bodies-000000000003.message: is half written: 200 of");
  EXPECT_WORDS(words, "written under a temporary name and then renamed");
}

TEST(file_exchange, stale_files) {
  Pair pair;
  Message message;
  message.from = Side::bodies;
  message.run = "0000";
  message.sequence = 1;
  test::write_text(pair.file(Side::bodies, 1), encode(message));
  EXPECT_WORDS(words_of<MachineError>([&] { pair.continuum.exchange(motion_of(0)); }),
               "is stale: it belongs to run 0000, and this is run");

  Pair other;
  message.run = other.continuum.files().run();
  message.sequence = 7;
  test::write_text(other.file(Side::bodies, 1), encode(message));
  EXPECT_WORDS(words_of<MachineError>([&] { other.continuum.exchange(motion_of(0)); }),
               "is stale: it has message 7, but 1 is expected");
  message.sequence = 2;
  message.from = Side::continuum;
  test::write_text(other.file(Side::bodies, 2), encode(message));
  EXPECT_WORDS(words_of<MachineError>([&] { other.continuum.exchange(motion_of(1)); }),
               "has data of the continuum, but those of the bodies are expected");
}

TEST(file_exchange, partner_of_another_version) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / "bodies.here", "sazare-coupling 3\nside bodies\n");
  FileExchange exchange(options_of(folder, Side::continuum));
  EXPECT_WORDS(words_of<UserError>([&] { exchange.meet(); }),
               "the partner speaks version 3 of the protocol, and this program version 1");
}

TEST(file_exchange, resumed_side_and_new_one_do_not_go_together) {
  const TemporaryFolder folder;
  Walk walk{folder};
  walk.go(0, 0, 2);
  FileExchange bodies(options_of(folder, Side::bodies, walk.marks[1]));
  FileExchange continuum(options_of(folder, Side::continuum));
  auto met = std::async(std::launch::async, [&] { return words_of<UserError>([&] { continuum.meet(); }); });
  EXPECT_WORDS(words_of<UserError>([&] { bodies.meet(); }), "the continuum's program belongs to another run");
  EXPECT_WORDS(met.get(), "the bodies' program belongs to another run");
}

TEST(file_exchange, messages_that_are_gone_cannot_be_gone_through_again) {
  const TemporaryFolder folder;
  Walk walk{folder};
  walk.go(0, 0, 4);
  std::filesystem::remove(folder.path() / file_name(Side::continuum, 1));
  FileExchange bodies(options_of(folder, Side::bodies, {walk.marks[1].run, 1}));
  FileExchange continuum(options_of(folder, Side::continuum, walk.marks[0]));
  auto met = std::async(std::launch::async, [&] { continuum.meet(); });
  EXPECT_WORDS(words_of<UserError>([&] { bodies.meet(); }), "its message 1 is no longer there, so this side cannot catch up");
  met.get();
}

TEST(file_exchange, resumed_surface_must_be_that_of_the_run) {
  const TemporaryFolder folder;
  Walk walk{folder};
  walk.go(0, 0, 1);
  FileContinuumChannel continuum(options_of(folder, Side::continuum, walk.marks[0]));
  FileExchange bodies(options_of(folder, Side::bodies, walk.marks[1]));
  auto met = std::async(std::launch::async, [&] { bodies.meet(); });
  SurfaceShape shape = two_segments();
  shape.nodes[0] = 1e-9;
  EXPECT_WORDS(words_of<UserError>([&] { continuum.reopen(shape); }), "the resumed case: the surfaces do not match");
  met.get();
}

}  // namespace
}  // namespace sazare::coupling
