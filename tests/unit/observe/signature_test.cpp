/// A checkpoint that somebody else made is not read unless its user says so.

#include "sazare/observe/signature.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "sazare/core/error.hpp"
#include "sazare/observe/checkpoint.hpp"
#include "support.hpp"

namespace sazare::observe {
namespace {

using test::TemporaryFolder;
using test::words_of;

/// Sets a variable of the environment, and puts it back at the end.
class Setting {
public:
  Setting(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
  }
  ~Setting() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

private:
  const char* name_;
  std::optional<std::string> before_;
};

/// The values that the authors of SipHash published for the key 00 01 ... 0f and the input 00 01 ... .
TEST(signature, is_siphash_2_4) {
  const SignatureKey key{0x0706050403020100ULL, 0x0f0e0d0c0b0a0908ULL};
  std::vector<std::byte> input;
  EXPECT_EQ(siphash(key, input), 0x726fdb47dd0e0e31ULL);
  input.push_back(std::byte{0});
  EXPECT_EQ(siphash(key, input), 0x74f839c593dc67fdULL);
  for (unsigned n = 1; n < 15; ++n) input.push_back(static_cast<std::byte>(n));
  EXPECT_EQ(siphash(key, input), 0xa129ca6149be45e5ULL);
}

TEST(signature, of_a_user_is_drawn_once_and_kept_for_his_eyes) {
  const TemporaryFolder home;
  const Setting data("XDG_DATA_HOME", home.path().c_str());
  const SignatureKey first = signature_key();
  EXPECT_EQ(signature_key(), first);
  namespace fs = std::filesystem;
  const fs::path file = home.path() / "sazare" / "checkpoint-key";
  EXPECT_EQ(fs::file_size(file), 16U);
  EXPECT_EQ(fs::status(file).permissions() & fs::perms::all, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator()), 1);
  const TemporaryFolder other;
  const Setting of_other("XDG_DATA_HOME", other.path().c_str());
  EXPECT_NE(signature_key(), first);
}

TEST(signature, is_there_where_no_file_can_be_kept) {
  const Setting data("XDG_DATA_HOME", nullptr), home("HOME", nullptr);
  EXPECT_EQ(signature_key(), signature_key());
  const Setting nowhere("HOME", "/proc/none");
  EXPECT_EQ(signature_key(), signature_key());
}

TEST(signature, of_somebody_else_is_refused_until_the_user_trusts_it) {
  const TemporaryFolder folder, mine, other;
  const std::vector<std::byte> bytes(100, std::byte{7});
  {
    const Setting data("XDG_DATA_HOME", other.path().c_str());
    CheckpointWriter writer(folder.path() / "state.h5");
    writer.add("bodies", bytes);
    writer.commit();
    EXPECT_EQ(CheckpointReader(folder.path() / "state.h5").read("bodies"), bytes);
  }
  const Setting data("XDG_DATA_HOME", mine.path().c_str());
  const auto read = [&] { return CheckpointReader(folder.path() / "state.h5").read("bodies"); };
  const std::string words = words_of<UserError>(read);
  EXPECT_NE(words.find("was not written by you on this machine"), std::string::npos) << words;
  EXPECT_NE(words.find("add --trust-checkpoint"), std::string::npos) << words;
  const Setting trust("SAZARE_TRUST_CHECKPOINT", "1");
  EXPECT_EQ(read(), bytes);
}

TEST(signature, belongs_to_a_name) {
  const std::vector<std::byte> bytes(3, std::byte{1});
  EXPECT_NE(signature_of({1, 2}, "first", bytes), signature_of({1, 2}, "second", bytes));
}

}  // namespace
}  // namespace sazare::observe
