#include "sazare/observe/csv_writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>

#include "sazare/core/error.hpp"
#include "support.hpp"

namespace sazare::observe {
namespace {

using test::read_text;
using test::SmallDisk;
using test::TemporaryFolder;
using test::words_of;

const std::vector<std::string> columns = {"time [s]", "speed [m/s]"};

TEST(csv_writer, header_is_there_at_once_and_rows_after_a_flush) {
  const TemporaryFolder folder;
  CsvWriter writer(folder.path() / "a.csv", columns);
  EXPECT_EQ(read_text(folder.path() / "a.csv"), "time [s],speed [m/s]\n");
  writer.add_row(std::vector<Real>{0.5, -1e-7});
  EXPECT_EQ(read_text(folder.path() / "a.csv"), "time [s],speed [m/s]\n");
  writer.flush(true);
  EXPECT_EQ(read_text(folder.path() / "a.csv"), "time [s],speed [m/s]\n0.5,-1e-07\n");
  EXPECT_EQ(writer.rows(), 1u);
}

TEST(csv_writer, a_link_is_replaced_and_what_it_leads_to_stays) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / "precious.txt", "precious");
  std::filesystem::create_symlink(folder.path() / "precious.txt", folder.path() / "a.csv");
  { CsvWriter(folder.path() / "a.csv", columns).add_row(std::vector<Real>{1, 2}); }
  EXPECT_EQ(read_text(folder.path() / "precious.txt"), "precious");
  EXPECT_FALSE(std::filesystem::is_symlink(folder.path() / "a.csv"));
  std::filesystem::rename(folder.path() / "a.csv", folder.path() / "b.csv");
  std::filesystem::create_symlink(folder.path() / "b.csv", folder.path() / "a.csv");
  EXPECT_WORDS(words_of<MachineError>([&] { CsvWriter::resume(folder.path() / "a.csv", columns, 0); }), "It is a symbolic link");
}

TEST(csv_writer, destruction_flushes) {
  const TemporaryFolder folder;
  { CsvWriter(folder.path() / "a.csv", columns).add_row(std::vector<Real>{1, 2}); }
  EXPECT_EQ(read_text(folder.path() / "a.csv"), "time [s],speed [m/s]\n1,2\n");
}

TEST(csv_writer, numbers_read_back_to_the_same_bits) {
  const TemporaryFolder folder;
  std::mt19937_64 random(5);
  std::vector<Real> values = {0.1, 1.0 / 3, 5e-324, std::numeric_limits<Real>::max(), 1e22, 123456789012345678.0, -0.0};
  while (values.size() < 3000) {
    const Real value = std::bit_cast<Real>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  {
    CsvWriter writer(folder.path() / "a.csv", {"value [-]"});
    for (const Real value : values) writer.add_row(std::span(&value, 1));
  }
  const std::string text = read_text(folder.path() / "a.csv");
  const char* at = text.c_str() + text.find('\n') + 1;
  for (const Real value : values) {
    char* end = nullptr;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(at, &end)), std::bit_cast<std::uint64_t>(value));
    ASSERT_EQ(*end, '\n');
    at = end + 1;
  }
}

TEST(csv_writer, resumed_file_equals_an_uninterrupted_one) {
  const TemporaryFolder folder;
  const auto add = [](CsvWriter& writer, int from, int to) {
    for (int i = from; i < to; ++i) writer.add_row(std::vector<Real>{i * 0.1, std::sin(i)});
  };
  {
    CsvWriter whole(folder.path() / "whole.csv", columns);
    add(whole, 0, 100);
    CsvWriter interrupted(folder.path() / "resumed.csv", columns);
    add(interrupted, 0, 57);
  }
  {
    CsvWriter resumed = CsvWriter::resume(folder.path() / "resumed.csv", columns, 40);
    EXPECT_EQ(resumed.rows(), 40u);
    add(resumed, 40, 100);
    EXPECT_EQ(resumed.rows(), 100u);
  }
  EXPECT_EQ(read_text(folder.path() / "resumed.csv"), read_text(folder.path() / "whole.csv"));
}

TEST(csv_writer, resume_drops_a_row_cut_in_the_middle) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / "a.csv", "time [s],speed [m/s]\n1,2\n3,4\n5,");
  { CsvWriter::resume(folder.path() / "a.csv", columns, 2).add_row(std::vector<Real>{7, 8}); }
  EXPECT_EQ(read_text(folder.path() / "a.csv"), "time [s],speed [m/s]\n1,2\n3,4\n7,8\n");
}

TEST(csv_writer, resume_refuses_what_is_not_its_file) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.csv";
  const auto resume = [&](std::size_t rows) { return words_of<UserError>([&] { CsvWriter::resume(file, columns, rows); }); };
  EXPECT_WORDS(resume(0), "a.csv: is missing, or its columns are not those of this run");
  test::write_text(file, "time [s],other [m]\n1,2\n");
  EXPECT_WORDS(resume(0), "its columns are not those of this run");
  test::write_text(file, "time [s],speed [m/s]\n1,2\n3,4");
  EXPECT_WORDS(resume(2), "has fewer than the 2 rows that the checkpoint counts");
  EXPECT_EQ(read_text(file), "time [s],speed [m/s]\n1,2\n3,4");
}

TEST(csv_writer, failed_flush_leaves_whole_rows_only) {
  const TemporaryFolder folder;
  CsvWriter writer(folder.path() / "a.csv", columns);
  writer.add_row(std::vector<Real>{1, 2});
  writer.flush();
  const std::string good = read_text(folder.path() / "a.csv");
  for (int i = 0; i < 1000; ++i) writer.add_row(std::vector<Real>{i * 0.1, 1.0 / 3});
  {
    const SmallDisk small(1000);
    EXPECT_WORDS(words_of<MachineError>([&] { writer.flush(); }), "a.csv: cannot be written: File too large");
    EXPECT_EQ(read_text(folder.path() / "a.csv"), good);
  }
  writer.flush();  // with room again nothing is lost
  EXPECT_EQ(writer.rows(), 1001u);
  const std::string text = read_text(folder.path() / "a.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1002);
}

TEST(csv_writer, folder_that_is_not_there) {
  EXPECT_WORDS(words_of<MachineError>([] { CsvWriter("no/such/a.csv", columns); }), "No such file or directory");
}

TEST(csv_writer, row_of_another_length_is_a_programming_error) {
  const TemporaryFolder folder;
  CsvWriter writer(folder.path() / "a.csv", columns);
  EXPECT_THROW(writer.add_row(std::vector<Real>{1}), std::invalid_argument);
}

TEST(csv_writer, numbers_that_are_not_finite_are_no_results) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.csv";
  {
    CsvWriter writer(file, columns);
    for (const Real value : {std::numeric_limits<Real>::quiet_NaN(), -std::numeric_limits<Real>::infinity()})
      EXPECT_WORDS(words_of<PhysicsError>([&] { writer.add_row(std::vector<Real>{0.5, value}); }), "a.csv: \"speed [m/s]\" is ");
    EXPECT_EQ(writer.rows(), 0U);
  }
  EXPECT_EQ(read_text(file), "time [s],speed [m/s]\n");
}

TEST(csv_writer, moved_writer_goes_on) {
  const TemporaryFolder folder;
  {
    CsvWriter first(folder.path() / "a.csv", columns);
    first.add_row(std::vector<Real>{1, 2});
    CsvWriter second(folder.path() / "b.csv", columns);
    second = std::move(first);
    second.add_row(std::vector<Real>{3, 4});
  }
  EXPECT_EQ(read_text(folder.path() / "a.csv"), "time [s],speed [m/s]\n1,2\n3,4\n");
}

TEST(csv_writer, whole_table_with_texts) {
  const TemporaryFolder folder;
  write_csv(folder.path() / "a.csv", {"part", "seconds [s]", "count [-]"},
            {{"joints", 0.25, std::int64_t{3}}, {"say \"a, b\"", 1e-9, std::int64_t{9007199254740993}}});
  EXPECT_EQ(read_text(folder.path() / "a.csv"),
            "part,seconds [s],count [-]\njoints,0.25,3\n\"say \"\"a, b\"\"\",1e-09,9007199254740993\n");
  EXPECT_THROW(write_csv(folder.path() / "a.csv", {"part"}, {{1.0, 2.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace sazare::observe
