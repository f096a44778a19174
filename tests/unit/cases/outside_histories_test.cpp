#include <gtest/gtest.h>

#include "case_folder.hpp"
#include "sazare/cases/case_file.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

const std::vector<std::string> own_wave = {"motions.0.type=\"function\"", "motions.0.quantity=\"velocity\""};

CaseFile column() {
  const CaseFolder folder;
  std::string text = write_resolved(registry::read_case("cases/column-ricker/case.toml").as<cases::MpsCase>());
  for (const char* key : {"frequency = ", "peak_time = "}) {
    const auto line = text.find(key);
    text.erase(line, text.find('\n', line) + 1 - line);
  }
  return registry::read_case_text(text, folder.path() / "case.toml", own_wave);
}

TEST(outside_histories, are_those_that_the_case_leaves_open) {
  EXPECT_TRUE(registry::read_case("cases/column-ricker/case.toml").histories.empty());
  const auto found = column().histories;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, column().as<MpsCase>().motions[0].name);
  EXPECT_EQ(found[0].begin, 0);
}

TEST(outside_histories, share_their_samples_with_the_case) {
  const CaseFile file = column();
  file.histories[0].add(0.5, std::vector<Real>{0, 2, 4});
  file.histories[0].add(0.5, std::vector<Real>{4});
  const laws::Record& samples = *file.as<cases::MpsCase>().motions[0].samples;
  EXPECT_EQ(samples.value, (std::vector<Real>{0, 2, 4, 4}));
  EXPECT_EQ(samples.first, (std::vector<Real>{0, 0.5, 2, 4}));
  EXPECT_TRUE(column().as<MpsCase>().motions[0].samples->value.empty());  // another case has its own
}

TEST(outside_histories, of_pressures_begin_with_the_delay) {
  const CaseFolder folder;
  const CaseFile file = folder.read(smallest_case() + "\n[[blasts]]\nsurface = \"hole\"\nfunction = true\ndelay = 1e-4\n");
  const auto found = file.histories;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].begin, 1e-4);
  found[0].add(1e-5, std::vector<Real>{0, 3e6});
  const auto& samples = *std::get<PressureFunction>(file.as<cases::BlocksCase>().blasts.back().pressure).samples;
  EXPECT_EQ(samples.time, (std::vector<Real>{0, 1e-5}));
  EXPECT_EQ(laws::table_pressure(samples, 0.5e-5), 1.5e6);
  EXPECT_NE(write_resolved(file.as<cases::BlocksCase>()).find("function = true"), std::string::npos);
}

TEST(outside_histories, cannot_be_given_by_who_has_no_program) {
  try {
    refuse_outside_histories(column());
    FAIL() << "not refused";
  } catch (const UserError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("is a function, which a case file cannot contain"), std::string::npos) << text;
    EXPECT_NE(text.find("functions={"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace sazare::cases
