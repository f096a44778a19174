#include <gtest/gtest.h>

#include <random>

#include "case_folder.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/case/format.hpp"

/// A damaged case is read or refused in words; nothing else may happen to it.
namespace sazare::cases {
namespace {

/// True when the text was read; a refusal must say where and how many errors there are.
bool read_or_refused(const CaseFolder& folder, const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const CaseFile file = folder.read(text, overrides);
    EXPECT_NO_THROW(folder.read(write_resolved(file.as<cases::BlocksCase>()))) << text;
    return true;
  } catch (const UserError& failure) {
    const std::string message = failure.what();
    EXPECT_NE(message.find(": error: "), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with("nothing was run")) << message;
    return false;
  }
}

TEST(DamagedCase, CutAnywhere) {
  const CaseFolder folder;
  const std::string text = full_case();
  for (std::size_t length = 0; length < text.size(); length += 3) read_or_refused(folder, text.substr(0, length));
}

TEST(DamagedCase, WithoutAnyOneLine) {
  const CaseFolder folder;
  const std::string text = full_case();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    read_or_refused(folder, text.substr(0, begin) + text.substr(end));
    begin = end;
  }
}

TEST(DamagedCase, WithAnyOneLineTwice) {
  const CaseFolder folder;
  const std::string text = full_case();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    read_or_refused(folder, text.substr(0, end) + text.substr(begin));
    begin = end;
  }
}

TEST(DamagedCase, WithCharactersReplaced) {
  const CaseFolder folder;
  const std::string characters = "[]{}=\"'#.,-+eE0159xz_ \n\t\\\x80\xff";
  std::mt19937 random(20180917);
  int read = 0;
  for (int round = 0; round < 1500; ++round) {
    std::string text = full_case();
    const int changes = 1 + round % 3;
    for (int i = 0; i < changes; ++i) text[random() % text.size()] = characters[random() % characters.size()];
    read += read_or_refused(folder, text) ? 1 : 0;
  }
  EXPECT_GT(read, 0);
}

TEST(DamagedCase, WithValuesExchanged) {
  const CaseFolder folder;
  const std::vector<std::string> values{
      "0",          "-1",         "1e400",     "nan",        "-inf", "\"\"",   "\"450 GPa\"",
      "true",       "[]",         "{}",        "[[]]",       "[1]",  "1e-300", "9223372036854775807",
      "1979-05-27", "[\"x\", 1]", "{ a = 1 }", "\"\\u0000\""};
  const std::string text = full_case();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::size_t equals = text.find(" = ", begin);
    if (equals < end)
      for (const std::string& value : values) read_or_refused(folder, text.substr(0, equals + 3) + value + text.substr(end));
    begin = end + 1;
  }
}

TEST(DamagedCase, ByOverrides) {
  const CaseFolder folder;
  const std::vector<std::string> settings{"=",
                                          "a=",
                                          ".=1",
                                          "time=1",
                                          "joints=[]",
                                          "joints.0=3",
                                          "joints=\"x\"",
                                          "joints.0.between.0=5",
                                          "joints.99999999999999999999.cohesion=1",
                                          "mesh.parameters=3",
                                          "mesh.file=",
                                          "mesh={}",
                                          "case.method.x=1",
                                          "gauges.0.point.7=1",
                                          "time.end=[[[[[[[[[[",
                                          "time.end=\"",
                                          "time.end=#",
                                          "x.y.z.w=1",
                                          "0.0=1",
                                          "time.end=1 # x"};
  for (const std::string& setting : settings) read_or_refused(folder, full_case(), {setting});
}

TEST(DamagedTable, CutAndChanged) {
  const CaseFolder folder;
  const std::string table = "time [s],pressure [Pa]\n0,0\n1.33e-4,5.75e8\n5e-4,0\n";
  const std::string characters = ",.;e-+0n\" \n\r\t\xff";
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string text = table.substr(0, random() % table.size());
    if (!text.empty()) text[random() % text.size()] = characters[random() % characters.size()];
    folder.write("pressure.csv", text);
    read_or_refused(folder, full_case());
  }
}

}  // namespace
}  // namespace sazare::cases
