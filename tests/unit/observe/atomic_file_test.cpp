#include "sazare/observe/atomic_file.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sazare/core/error.hpp"
#include "support.hpp"

namespace sazare::observe {
namespace {

using test::read_text;
using test::SmallDisk;
using test::TemporaryFolder;
using test::words_of;
using Names = std::vector<std::string>;

TEST(atomic_file, writes_and_replaces) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.txt", "first");
  EXPECT_EQ(read_text(folder.path() / "a.txt"), "first");
  write_file(folder.path() / "a.txt", "second, longer");
  EXPECT_EQ(read_text(folder.path() / "a.txt"), "second, longer");
  EXPECT_EQ(folder.files(), Names{"a.txt"});
}

TEST(atomic_file, links_are_replaced_and_what_they_lead_to_stays) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / "precious.txt", "precious");
  for (const char* name : {"a.txt", ".a.txt.part"}) std::filesystem::create_symlink("precious.txt", folder.path() / name);
  write_file(folder.path() / "a.txt", "new");
  EXPECT_EQ(read_text(folder.path() / "precious.txt"), "precious");
  EXPECT_EQ(read_text(folder.path() / "a.txt"), "new");
}

TEST(atomic_file, nothing_under_the_name_before_the_commit) {
  const TemporaryFolder folder;
  AtomicFile file(folder.path() / "a.txt");
  file.write("content");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.txt"));
  EXPECT_EQ(file.temporary().parent_path(), folder.path());
  file.commit();
  EXPECT_EQ(folder.files(), Names{"a.txt"});
}

TEST(atomic_file, without_commit_the_former_file_stays) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.txt", "former");
  {
    AtomicFile file(folder.path() / "a.txt");
    file.write("new");
  }
  EXPECT_EQ(read_text(folder.path() / "a.txt"), "former");
  EXPECT_EQ(folder.files(), Names{"a.txt"});
}

TEST(atomic_file, left_over_temporary_of_a_killed_run_is_no_obstacle) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / ".a.txt.part", "half of something much longer");
  write_file(folder.path() / "a.txt", "whole");
  EXPECT_EQ(read_text(folder.path() / "a.txt"), "whole");
  EXPECT_EQ(folder.files(), Names{"a.txt"});
}

TEST(atomic_file, file_grown_too_large_leaves_the_former_one) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.txt", "former");
  const SmallDisk small(10000);
  const std::string words = words_of<MachineError>([&] { write_file(folder.path() / "a.txt", std::string(100000, 'x')); });
  EXPECT_WORDS(words, "a.txt: cannot be written: File too large. Files there may not become so large (ulimit -f)");
  EXPECT_EQ(read_text(folder.path() / "a.txt"), "former");
  EXPECT_EQ(folder.files(), Names{"a.txt"});
}

TEST(atomic_file, words_for_a_full_disk) {
  const std::string words = words_of<MachineError>([] { fail_to_write("out/a.txt", ENOSPC); });
  EXPECT_WORDS(words, "a.txt: cannot be written: No space left on device. Free space there");
}

TEST(atomic_file, missing_folder) {
  const TemporaryFolder folder;
  const std::string words = words_of<MachineError>([&] { write_file(folder.path() / "no" / "a.txt", "x"); });
  EXPECT_WORDS(words, "No such file or directory. The folder does not exist: create it");
}

TEST(atomic_file, file_in_place_of_the_folder) {
  const TemporaryFolder folder;
  write_file(folder.path() / "file", "x");
  const std::string words = words_of<MachineError>([&] { write_file(folder.path() / "file" / "a.txt", "x"); });
  EXPECT_WORDS(words, "Not a directory. The folder does not exist: create it");
}

TEST(atomic_file, folder_in_place_of_the_file) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "a.txt");
  EXPECT_WORDS(words_of<MachineError>([&] { write_file(folder.path() / "a.txt", "x"); }), "Is a directory");
  EXPECT_EQ(folder.files(), Names{"a.txt"});
}

TEST(atomic_file, words_for_a_folder_that_may_not_be_written) {
  const std::string words = words_of<MachineError>([] { fail_to_write("out/a.txt", EACCES); });
  EXPECT_EQ(words,
            "out/a.txt: cannot be written: Permission denied. Choose an output folder that you may write to "
            "(--out)");
}

TEST(atomic_file, name_without_folder_lies_in_the_current_one) {
  const AtomicFile file("only-a-name.txt");
  EXPECT_EQ(file.temporary(), "./.only-a-name.txt.part");
}

}  // namespace
}  // namespace sazare::observe
