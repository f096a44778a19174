#include "sazare/observe/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <stdexcept>

#include "sazare/core/error.hpp"
#include "support.hpp"

namespace sazare::observe {
namespace {

using test::SmallDisk;
using test::TemporaryFolder;
using test::words_of;
using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Bytes bytes(count);
  for (auto& byte : bytes) byte = static_cast<std::byte>(random() & 255);
  return bytes;
}

void write_example(const std::filesystem::path& file, std::size_t count = 100000) {
  CheckpointWriter writer(file);
  writer.add("bodies.position", bytes_of(count, 1));
  writer.add("joints", bytes_of(17, 2));
  writer.add("empty", {});
  writer.commit();
}

TEST(checkpoint, blobs_come_back) {
  const TemporaryFolder folder;
  write_example(folder.path() / "state.h5");
  const CheckpointReader reader(folder.path() / "state.h5");
  EXPECT_EQ(reader.read("bodies.position"), bytes_of(100000, 1));
  EXPECT_EQ(reader.read("joints"), bytes_of(17, 2));
  EXPECT_EQ(reader.read("empty"), Bytes{});
  EXPECT_TRUE(reader.has("joints"));
  EXPECT_FALSE(reader.has("contacts"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"state.h5"});
}

TEST(checkpoint, former_one_stays_until_the_new_one_is_whole) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  write_example(file);
  {
    CheckpointWriter writer(file);
    writer.add("other", bytes_of(1000, 3));
    EXPECT_TRUE(CheckpointReader(file).has("joints"));
  }
  EXPECT_TRUE(CheckpointReader(file).has("joints"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"state.h5"});
  CheckpointWriter writer(file);
  writer.add("other", bytes_of(1000, 3));
  writer.commit();
  EXPECT_EQ(CheckpointReader(file).read("other"), bytes_of(1000, 3));
  EXPECT_FALSE(CheckpointReader(file).has("joints"));
}

TEST(checkpoint, full_disk_leaves_the_former_one) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  write_example(file);
  for (const std::size_t limit : {100, 3000, 50000, 99999, 100500}) {
    const SmallDisk small(limit);
    const std::string words = words_of<MachineError>([&] { write_example(file, 200000); });
    EXPECT_WORDS(words, "state.h5: cannot be written: File too large");
  }
  EXPECT_EQ(CheckpointReader(file).read("bodies.position"), bytes_of(100000, 1));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"state.h5"});
  write_example(file, 200000);  // and with room again all is well
  EXPECT_EQ(CheckpointReader(file).read("bodies.position"), bytes_of(200000, 1));
}

TEST(checkpoint, missing_file) {
  const std::string words = words_of<UserError>([] { CheckpointReader("no/state.h5"); });
  EXPECT_EQ(words, "no/state.h5: there is no such file. Start the run again with --overwrite");
}

TEST(checkpoint, foreign_file) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / "state.h5", "time [s]\n1\n");
  EXPECT_WORDS(words_of<UserError>([&] { CheckpointReader(folder.path() / "state.h5"); }), "cannot be read as an HDF5 file");
}

TEST(checkpoint, hdf5_file_of_another_kind) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  const auto words = [&] { return words_of<UserError>([&] { const CheckpointReader reader(file); }); };
  {
    Hdf5Writer writer(file);
    writer.make_group("/VTKHDF");
    writer.commit();
  }
  EXPECT_WORDS(words(), "state.h5: is not a checkpoint of Sazare");
  {
    Hdf5Writer writer(file);
    writer.make_group("/checkpoint");
    writer.set_attribute("/checkpoint", "format", "something-else");
    writer.commit();
  }
  EXPECT_WORDS(words(), "state.h5: is not a checkpoint of Sazare");
}

TEST(checkpoint, newer_format) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  Hdf5Writer writer(file);
  writer.make_group("/checkpoint");
  writer.set_attribute("/checkpoint", "format", "sazare-checkpoint");
  writer.set_attribute("/checkpoint", "version", std::vector<std::int64_t>{2});
  writer.commit();
  EXPECT_WORDS(words_of<UserError>([&] { const CheckpointReader reader(file); }),
               "state.h5: checkpoint format 2, this Sazare reads 1. Resume with the Sazare that wrote it");
}

TEST(checkpoint, missing_blob) {
  const TemporaryFolder folder;
  write_example(folder.path() / "state.h5");
  const CheckpointReader reader(folder.path() / "state.h5");
  EXPECT_WORDS(words_of<UserError>([&] { (void)reader.read("contacts"); }), "state.h5: has no 'contacts'");
}

TEST(checkpoint, one_changed_bit_is_found) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  write_example(file);
  std::string content = test::read_text(file);
  const Bytes blob = bytes_of(100000, 1);
  const auto at = content.find(std::string(reinterpret_cast<const char*>(blob.data()), 64));
  ASSERT_NE(at, std::string::npos);
  content[at + 54321] = static_cast<char>(content[at + 54321] ^ 4);
  test::write_text(file, content);
  const CheckpointReader reader(file);
  EXPECT_WORDS(words_of<UserError>([&] { (void)reader.read("bodies.position"); }),
               "state.h5: 'bodies.position' is damaged: its checksum does not match its data");
  EXPECT_EQ(reader.read("joints"), bytes_of(17, 2));
}

/// Reads everything; true when it came back as written, false when it was refused in words.
bool reads_back(const std::filesystem::path& file) {
  try {
    const CheckpointReader reader(file);
    EXPECT_EQ(reader.read("bodies.position"), bytes_of(2000, 1));
    EXPECT_EQ(reader.read("joints"), bytes_of(17, 2));
    EXPECT_EQ(reader.read("empty"), Bytes{});
    return true;
  } catch (const UserError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(file.string())) << error.what();
    return false;
  }
}

TEST(checkpoint, cut_anywhere_it_is_refused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  write_example(file, 2000);
  const std::string content = test::read_text(file);
  for (std::size_t length = 0; length < content.size(); length += 37) {
    test::write_text(file, content.substr(0, length));
    EXPECT_FALSE(reads_back(file)) << length;
  }
}

TEST(checkpoint, changed_bytes_never_pass_for_the_state) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state.h5";
  write_example(file, 2000);
  const std::string content = test::read_text(file);
  std::mt19937_64 random(9);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string changed = content;
    changed[random() % changed.size()] = static_cast<char>(random() & 255);
    test::write_text(file, changed);
    refused += reads_back(file) ? 0 : 1;
  }
  EXPECT_GT(refused, 300);
}

TEST(checkpoint, names_are_used_once_and_hold_no_slash) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder.path() / "state.h5");
  writer.add("a", {});
  EXPECT_THROW(writer.add("a", {}), std::invalid_argument);
  EXPECT_THROW(writer.add("a/b", {}), std::invalid_argument);
  EXPECT_THROW(writer.add("", {}), std::invalid_argument);
}

}  // namespace
}  // namespace sazare::observe
