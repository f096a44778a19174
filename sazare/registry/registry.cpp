#include "sazare/registry/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "sazare/core/error.hpp"
#include "sazare/runs/folder_page.hpp"

namespace sazare::registry {

namespace {

cases::CaseFormats formats() {
  static const std::vector<cases::CaseFormat> all = [] {
    std::vector<cases::CaseFormat> found;
    for (const runs::Method& method : methods()) found.push_back(method.format);
    return found;
  }();
  return all;
}

}  // namespace

const runs::Method& method(std::string_view name) {
  const auto found = std::ranges::find(methods(), name, [](const runs::Method& one) { return one.format.method; });
  if (found == methods().end()) throw std::out_of_range(fmt::format("there is no method {}", name));
  return *found;
}

cases::CaseFile read_case(const std::filesystem::path& path, std::span<const std::string> overrides) {
  return cases::read_case(formats(), path, overrides);
}

cases::CaseFile read_case_text(const std::string& content, const std::filesystem::path& path,
                               std::span<const std::string> overrides) {
  return cases::read_case_text(formats(), content, path, overrides);
}

std::string write_resolved(const cases::CaseFile& file, const std::filesystem::path& folder) {
  return method(file.method).format.write(file, folder);
}

std::unique_ptr<runs::LiveRun> open_case(const cases::CaseFile& file, const runs::RunOptions& options) {
  return method(file.method).open(file, options);
}

runs::RunOutcome run_case(const cases::CaseFile& file, const runs::RunOptions& options) {
  cases::refuse_outside_histories(file);
  return open_case(file, options)->run();
}

std::string check_case(const cases::CaseFile& file) { return method(file.method).check(file); }

runs::StudyOutcome run_study(const cases::Study& study, const runs::StudyOptions& options) {
  const auto read = [](const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_case(path, overrides);
  };
  return runs::run_study(study, options, {read, methods()});
}

std::string schema_json() { return cases::schema_json(formats()); }
std::string schema_markdown() { return cases::schema_markdown(formats()); }

std::string folder_markdown() {
  std::vector<runs::FolderTables> tables;
  for (const runs::Method& method : methods()) tables.push_back(method.tables());
  return runs::folder_markdown(tables);
}

}  // namespace sazare::registry
