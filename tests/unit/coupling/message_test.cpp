#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "sazare/coupling/message.hpp"
#include "support.hpp"

namespace sazare::coupling {
namespace {

using test::words_of;

Message example() {
  Message message;
  message.from = Side::bodies;
  message.kind = Kind::force;
  message.run = "00112233aabbccdd";
  message.sequence = 17;
  message.window = 16;
  message.pass = 2;
  message.time = 0.1 + 0.2;
  message.tables = {{"mean", 2, "N/m", {1.5, -0.0, 5e-324, 1e308}}, {"last", 1, "N/m", {}}};
  return message;
}

TEST(message, has_the_bytes_of_the_reference) {
  const std::string bytes = encode(example());
  const std::string head =
      "sazare-coupling 1\nfrom bodies\nkind force\nrun 00112233aabbccdd\nsequence 17\nwindow 16\npass 2\n"
      "time 0.30000000000000004\ntable mean 2 2 N/m\ntable last 0 1 N/m\ndata\n";
  EXPECT_EQ(bytes.substr(0, head.size()), head);
  EXPECT_EQ(bytes.size(), head.size() + 4 * 8 + 18);
  EXPECT_EQ(bytes.substr(head.size(), 8), std::string("\0\0\0\0\0\0\xf8\x3f", 8));  // 1.5
  EXPECT_EQ(bytes.substr(bytes.size() - 18, 9), "checksum ");
  EXPECT_EQ(bytes.back(), '\n');
}

TEST(message, every_bit_comes_back) {
  Message message = example();
  message.tables[0].values = {std::numeric_limits<Real>::denorm_min(), -0.0, std::nextafter(1.0, 2.0), -1.0 / 3};
  const Message got = decode(encode(message), "file");
  EXPECT_EQ(got.from, message.from);
  EXPECT_EQ(got.kind, message.kind);
  EXPECT_EQ(got.run, message.run);
  EXPECT_EQ(got.sequence, 17);
  EXPECT_EQ(got.window, 16);
  EXPECT_EQ(got.pass, 2);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(got.time), std::bit_cast<std::uint64_t>(message.time));
  ASSERT_EQ(got.tables.size(), 2u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(got.tables[0].values[i]), std::bit_cast<std::uint64_t>(message.tables[0].values[i]));
  EXPECT_EQ(got.tables[1].name, "last");
  EXPECT_TRUE(got.tables[1].values.empty());
}

TEST(message, cut_off_anywhere_is_half_written) {
  const std::string bytes = encode(example());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_WORDS(words_of<DamagedFile>([&] { decode(bytes.substr(0, length), "file"); }), "file: is half written");
}

TEST(message, every_changed_bit_is_seen) {
  const std::string bytes = encode(example());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
      EXPECT_THROW(decode(changed, "file"), std::runtime_error) << "byte " << i << " bit " << bit;
    }
  }
}

TEST(message, checksum_is_the_one_of_zlib_and_of_python) {
  Message message;
  message.kind = Kind::farewell;
  message.run = "r";
  const std::string bytes = encode(message);
  EXPECT_EQ(bytes,
            "sazare-coupling 1\nfrom continuum\nkind farewell\nrun r\nsequence 0\nwindow 0\npass 0\ntime 0\ndata\n"
            "checksum a6bfae41\n")
      << "the value stands in python/tests/test_partner.py as well";
}

TEST(message, too_long_is_damaged) {
  EXPECT_WORDS(words_of<DamagedFile>([] { decode(encode(example()) + "x", "file"); }), "is damaged");
}

TEST(message, other_version_and_other_protocol) {
  std::string bytes = encode(example());
  EXPECT_WORDS(words_of<UserError>([&] { decode("some text of somebody else\n", "file"); }), "file: is not a coupling file");
  bytes.replace(0, 17, "sazare-coupling 2");
  const std::string words = words_of<UserError>([&] { decode(bytes, "file"); });
  EXPECT_WORDS(words, "the partner speaks version 2 of the protocol, and this program version 1");
}

TEST(message, head_that_makes_no_sense) {
  std::string bytes = encode(example());
  bytes.replace(bytes.find("mean 2 2"), 8, "mean -1 2");
  EXPECT_WORDS(words_of<DamagedFile>([&] { decode(bytes, "file"); }), "'table mean -1 2 N/m' in its head is not a table");
  bytes = encode(example());
  bytes.replace(bytes.find("mean 2 2"), 8, "mean 99999999999 2");
  EXPECT_WORDS(words_of<DamagedFile>([&] { decode(bytes, "file"); }), "half written");
}

/// Sizes that wrap around, or that no file has: no room is taken for them.
TEST(message, tables_get_no_room_that_the_file_does_not_fill) {
  std::string bytes = encode(example());
  const std::string row = "table mean 2 2 N/m\n";
  std::string huge;
  for (int i = 0; i < 5000; ++i) huge += "table t 1099511627776 1000 N\n";
  bytes.replace(bytes.find(row), row.size(), huge);
  EXPECT_WORDS(words_of<DamagedFile>([&] { decode(bytes, "file"); }), "its tables have");
  bytes = encode(example());
  huge.clear();
  for (int i = 0; i < 60; ++i) huge += "table t 1000000000 1 N\n";  // each as large as memory, none of them there
  bytes.replace(bytes.find(row), row.size(), huge);
  EXPECT_WORDS(words_of<DamagedFile>([&] { decode(bytes, "file"); }), "half written");
  bytes = encode(example());
  bytes.replace(bytes.find("pass 2\n"), 7, "pass 4294967298\n");
  EXPECT_WORDS(words_of<DamagedFile>([&] { decode(bytes, "file"); }), "'pass 4294967298' in its head is out of range");
}

TEST(message, table_of_another_unit) {
  Message message = example();
  EXPECT_EQ(message.table("mean", 2, "N/m").values.size(), 4u);
  EXPECT_WORDS(words_of<UserError>([&] { message.table("mean", 2, "N"); }),
               "has 2 numbers in [N/m] per row, but 2 in [N] are expected");
  EXPECT_WORDS(words_of<UserError>([&] { message.table("rest", 2, "N"); }), "has no table 'rest'");
}

}  // namespace
}  // namespace sazare::coupling
