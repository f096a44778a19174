#include <gtest/gtest.h>

#include <fstream>

#include "case_folder.hpp"
#include "sazare/cases/study_file.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

TEST(mps_case, resolved_text_reads_as_the_same_case) {
  const CaseFolder folder;
  for (const char* name : {"column-ricker/case.toml", "soil-column-el-centro/case.toml", "stability-study/column-p.toml"}) {
    const CaseFile first = registry::read_case(std::filesystem::path("cases") / name);
    const std::string text = write_resolved(first.as<cases::MpsCase>());
    const CaseFile second = folder.read(text);
    EXPECT_EQ(write_resolved(second.as<cases::MpsCase>()), text) << name;
    ASSERT_EQ(first.as<cases::MpsCase>().motions.size(), second.as<cases::MpsCase>().motions.size());
    for (std::size_t i = 0; i < first.as<cases::MpsCase>().motions.size(); ++i)
      EXPECT_EQ(first.as<cases::MpsCase>().motions[i].record.value, second.as<cases::MpsCase>().motions[i].record.value);
  }
}

TEST(mps_case, third_velocity_follows_from_the_other_two) {
  const std::vector<std::string> by_ratio = {"materials.0.s_wave_velocity=100"};
  const MpsCase mps = registry::read_case("cases/stability-study/column-s.toml", by_ratio).as<cases::MpsCase>();
  EXPECT_NEAR(mps.materials[0].p_wave_velocity, 200, 1e-9);
  const MpsCase other =
      registry::read_case("cases/stability-study/column-p.toml", std::vector<std::string>{"materials.0.p_wave_velocity=400"})
          .as<cases::MpsCase>();
  EXPECT_NEAR(other.materials[0].s_wave_velocity, 200, 1e-9);
}

TEST(mps_case, is_explained_with_the_drift_of_its_record) {
  const std::string text = explain(registry::read_case("cases/soil-column-el-centro/case.toml").as<cases::MpsCase>());
  EXPECT_NE(text.find("el-centro: el-centro-1940-ns.AT2, acceleration of 1560 samples every 0.02 s, times 0.5"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("baseline linear: velocity at the end of the record -0.004338 m/s, displacement -0.02754 m"), std::string::npos) << text;
  EXPECT_NE(text.find("peaks 1.563 m/s2 (156.3 gal), "), std::string::npos) << text;  // half of the record
  const std::string raw = explain(
      registry::read_case("cases/soil-column-el-centro/case.toml", std::vector<std::string>{"motions.0.baseline=\"none\""})
          .as<cases::MpsCase>());
  EXPECT_NE(raw.find("baseline none: velocity at the end of the record"), std::string::npos) << raw;
}

TEST(study_file, has_every_combination_of_every_family) {
  const Study study = read_study("cases/stability-study/study.toml");
  EXPECT_EQ(study.size(), 320);
  EXPECT_EQ(study.family(159).name, "S");
  EXPECT_EQ(study.family(160).name, "P");
  EXPECT_EQ(study.values(0), (std::vector<Real>{0.5, 100, 0.001}));
  EXPECT_EQ(study.values(319), (std::vector<Real>{3.2, 800, 1}));
  EXPECT_EQ(study.overrides(160).at(1), "materials.0.p_wave_velocity=100.0");
}

TEST(study_file, says_what_is_wrong) {
  const CaseFolder folder;
  const auto words = [&](const std::string& text) -> std::string {
    try {
      read_study(folder.write("study.toml", text));
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  };
  const std::string text = words(R"([study]
title = "s"
[[families]]
name = "a"
case = "nowhere.toml"
[[parameters]]
name = "p"
keys = ["time.end", "time.step", "time.strict"]
values = [1.0]
)");
  EXPECT_NE(text.find("study.toml:5:8: error: case file not found: nowhere.toml"), std::string::npos) << text;
  EXPECT_NE(text.find("study.toml:8:8: error: there are 3 keys and 1 families"), std::string::npos) << text;
  const std::string values = words(
      "[study]\ntitle = \"s\"\n[[families]]\nname = \"a\"\ncase = \"x\"\n[[parameters]]\nname = \"p\"\n"
      "keys = [\"time.end\"]\nvalues = [\"1 m\"]\n");
  EXPECT_NE(values.find("error: values: a number was expected, found the string \"1 m\""), std::string::npos) << values;
}

}  // namespace
}  // namespace sazare::cases
