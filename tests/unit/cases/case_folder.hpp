#pragma once

#include <filesystem>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sazare::cases {

/// A folder of its own for a test, with a mesh file, a geometry and a pressure table for cases to name;
/// removed at the end.
class CaseFolder {
public:
  CaseFolder();

  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
  CaseFile read(const std::string& text, const std::vector<std::string>& overrides = {}) const;
  /// The message with which the text is refused; fails the test when it is not.
  std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) const;

private:
  test::TemporaryFolder folder_;
};

/// The smallest case: only keys without a default.
std::string smallest_case();

/// A case in which every key of the schema but those of water is given (friction as an angle) or stands for one that cannot be
/// beside it.
std::string full_case();

/// `text` with the first `from` replaced; fails the test when there is none.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace sazare::cases
