#include <gtest/gtest.h>

#include <filesystem>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/study_file.hpp"
#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

TEST(ExampleCases, AreAllValid) {
  int count = 0;
  for (const auto& folder : std::filesystem::directory_iterator("cases")) {
    if (!folder.is_directory()) continue;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "README.md")) << folder.path();
    for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
      if (file.path().extension() != ".toml") continue;
      if (file.path().filename() == "study.toml")
        EXPECT_NO_THROW(read_study(file.path())) << file.path();
      else
        EXPECT_NO_THROW(registry::read_case(file.path())) << file.path();
      ++count;
    }
  }
  EXPECT_GT(count, 0);
}

/// What a run leaves in its folder as its case is a case, and the same one.
TEST(ExampleCases, AreValidAsTheyAreResolved) {
  for (const auto& folder : std::filesystem::directory_iterator("cases"))
    for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
      if (file.path().extension() != ".toml" || file.path().filename() == "study.toml") continue;
      const std::string resolved = registry::write_resolved(registry::read_case(file.path()));
      try {
        EXPECT_EQ(registry::write_resolved(registry::read_case_text(resolved, file.path())), resolved) << file.path();
      } catch (const UserError& error) {
        ADD_FAILURE() << file.path() << "\n" << error.what();
      }
    }
}

}  // namespace
}  // namespace sazare::cases
