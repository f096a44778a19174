/// A message stays readable whatever a file holds.

#include "sazare/cases/format/problems.hpp"

#include <gtest/gtest.h>

namespace sazare::cases {
namespace {

std::string many(std::size_t count, char letter) {
  std::string text;
  while (text.size() < count) text += letter;
  return text;
}

std::string said(const std::string& line, int column, const std::string& what, const std::string& help = "") {
  Problems problems;
  problems.add_source({"case.toml", {line}});
  problems.warning({0, 1, column, 3}, what, help);
  return problems.warning_text();
}

TEST(problems, of_a_very_long_line_show_what_is_about_their_place) {
  const std::string line = many(50000, 'a') + "bad" + many(50000, 'c');
  const std::string words = said(line, 50001, "no number");
  EXPECT_LT(words.size(), 800U);
  const std::string around = "..." + many(100, 'a') + "bad" + many(97, 'c') + "...";
  EXPECT_NE(words.find("    1 | " + around + "\n      | " + many(103, ' ') + "^~~\n"), std::string::npos) << words;
  EXPECT_NE(words.find("case.toml:1:50001: warning: no number"), std::string::npos) << words;
}

TEST(problems, at_the_ends_of_a_very_long_line_show_these) {
  const std::string line = "bad" + many(1000, 'c') + "end";
  EXPECT_NE(said(line, 1, "x").find("    1 | bad" + many(197, 'c') + "...\n      | ^~~\n"), std::string::npos)
      << said(line, 1, "x");
  EXPECT_NE(said(line, 1004, "x").find("cend\n      | " + many(103, ' ') + "^~~\n"), std::string::npos) << said(line, 1004, "x");
  EXPECT_NE(said(many(1000, 'c'), 5000, "x").find('^'), std::string::npos);
}

TEST(problems, that_name_a_very_long_word_leave_out_its_middle) {
  const std::string words = said("a = 1", 1, "unknown key \"" + many(100000, 'k') + "\"", many(100000, 'h') + "end");
  EXPECT_LT(words.size(), 4000U);
  EXPECT_NE(words.find("bytes more"), std::string::npos);
  EXPECT_NE(words.find("k\"\n"), std::string::npos);
  EXPECT_NE(words.find("hend\n"), std::string::npos);
}

TEST(problems, cut_no_letter_of_several_bytes_and_bear_bytes_that_are_none) {
  std::string letters;
  const std::string none = many(5000, '\x81');
  for (int n = 0; n < 2000; ++n) letters += "あ";
  const std::string words = said(letters, 900, letters);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (static_cast<unsigned char>(words[i]) == 0xe3) {
      EXPECT_EQ(words.substr(i, 3), "あ");
    }
  EXPECT_LT(said(none, 4000, none, none).size(), 6000U);
}

}  // namespace
}  // namespace sazare::cases
