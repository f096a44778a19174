#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/case/mesh_check.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// What the comments `#: ...` at the head of a case ask for.
struct Instructions {
  std::vector<std::string> overrides;
  MeshGroups groups;
  bool with_mesh = false;
};

Instructions read_instructions(const fs::path& path) {
  Instructions result;
  std::ifstream stream(path);
  std::string line, word;
  while (std::getline(stream, line) && line.starts_with("#: ")) {
    std::istringstream words(line.substr(3));
    words >> word;
    if (word == "--set") {
      result.overrides.push_back(line.substr(std::string("#: --set ").size()));
    } else if (word == "regions") {
      result.with_mesh = true;
      while (words >> word) result.groups.regions.push_back(word);
    } else if (word == "surface") {
      MeshSurface surface;
      words >> surface.name >> surface.outer_faces >> surface.inner_faces;
      while (words >> word) surface.regions.push_back(word);
      result.groups.surfaces.push_back(surface);
    } else if (word == "normal") {  // of the last surface
      words >> word;
      result.groups.surfaces.back().area[word.front() - 'x'] = 1;
    }
  }
  return result;
}

std::string message_of(const fs::path& path) {
  const Instructions instructions = read_instructions(path);
  try {
    const CaseFile file = registry::read_case(path, instructions.overrides);
    if (instructions.with_mesh) check_against_mesh(file, instructions.groups);
    return file.warnings + "no errors\n";
  } catch (const UserError& failure) {
    return std::string(failure.what()) + "\n";
  }
}

/// By subject, as `subject/name`.
std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& subject : fs::directory_iterator(SAZARE_MESSAGES_FOLDER)) {
    if (!subject.is_directory()) continue;
    for (const auto& entry : fs::directory_iterator(subject))
      if (entry.path().extension() == ".toml") names.push_back(subject.path().filename() / entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

class Messages : public testing::TestWithParam<std::string> {};

TEST_P(Messages, AreExactly) {
  const fs::path place = fs::path(SAZARE_MESSAGES_FOLDER) / (GetParam() + ".toml");
  fs::current_path(place.parent_path());  // so that messages show the file name alone
  const fs::path path = place.filename();
  const std::string message = message_of(path);
  const fs::path expected = fs::path(path).replace_extension(".txt");
  if (std::getenv("SAZARE_WRITE_MESSAGES") != nullptr) std::ofstream(expected, std::ios::binary) << message;
  EXPECT_EQ(message, read_file(expected));
}

INSTANTIATE_TEST_SUITE_P(Case, Messages, testing::ValuesIn(case_names()), [](const auto& tested) {
  std::string name = tested.param;
  std::ranges::replace(name, '/', '_');
  return name;
});

}  // namespace
}  // namespace sazare::cases
