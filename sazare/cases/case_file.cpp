#include "sazare/cases/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "sazare/cases/case_format.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/cases/format/case_text.hpp"
#include "sazare/cases/format/shell_word.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/method_choice.hpp"
#include "sazare/core/error.hpp"

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_characters = 64'000'000;

std::string read_text(const fs::path& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure))
    throw UserError(fmt::format("{} is a folder; name the case file in it, such as {}", path.string(),
                                (path / "case.toml").lexically_normal().string()));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  const int error = errno;
  std::string text;
  std::array<char, 65536> part{};
  while (text.size() <= most_characters && (stream.read(part.data(), part.size()) || stream.gcount() > 0))
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most_characters)
    throw UserError(fmt::format("{} has more than {} million characters, and so is no case file", path.string(),
                                most_characters / 1'000'000));
  if (!stream.eof())
    throw UserError(fmt::format("cannot read the case file {}: {}", path.string(),
                                error == 0 || error == ENOENT ? "is the path right?" : std::generic_category().message(error)));
  return text;
}

/// Whether a setting is one of a side's case.
bool is_of_side(const std::string& setting) { return setting.starts_with("continuum.") || setting.starts_with("bodies."); }

/// Name of the method as the file gives it; empty where it does not.
std::string method_name(const Value& root) {
  const Value* head = root.find("case");
  const Value* method = head == nullptr || !head->is_table() ? nullptr : head->find("method");
  return method == nullptr || method->text() == nullptr ? "" : *method->text();
}

/// The format of a method; the first one where there is no such method, which the check of the structure reports.
const CaseFormat& format_of(CaseFormats formats, std::string_view method) {
  const auto found = std::ranges::find(formats, method, &CaseFormat::method);
  return found == formats.end() ? formats.front() : *found;
}

/// The tables of all methods, for a case whose method is not known yet.
std::vector<Table> all_tables(CaseFormats formats) {
  std::vector<Table> all;
  for (const CaseFormat& format : formats) all.insert(all.end(), format.tables.begin(), format.tables.end());
  return all;
}

void refuse_study(const Value& root, const fs::path& path, Problems& problems) {
  const Value* study = root.find("study");
  if (study == nullptr || root.find("case") != nullptr) return;
  problems.error(study->place, "this is a study, not a case",
                 fmt::format("use it with: sazare study {}; its families name the cases", shell_word(path.string())));
  problems.throw_if_errors();
}

/// The place of "joints.0.cohesion", or of as much of it as the file gives.
Place find_place(const Value& root, std::string_view key) {
  const Value* at = &root;
  Place place{};
  while (!key.empty() && at != nullptr) {
    const std::size_t dot = key.find('.');
    const std::string part(key.substr(0, dot));
    key = dot == std::string_view::npos ? std::string_view{} : key.substr(dot + 1);
    const bool is_index = at->is_list() && part.find_first_not_of("0123456789") == std::string::npos;
    const auto index = is_index && part.size() < 10 ? std::stoul(part) : 0;
    if (at->is_list())
      at = is_index && index < at->items()->size() ? &(*at->items())[index] : nullptr;
    else
      at = at->find(part);
    if (at != nullptr) place = at->place;
  }
  return place;
}

}  // namespace

std::vector<Entry> CheckContext::entries_of(std::string_view table) const { return entries(root, *find_table(schema, table)); }

CaseFile read_case(CaseFormats formats, const fs::path& path, std::span<const std::string> overrides, const std::string& side) {
  return read_case_text(formats, read_text(path), path, overrides, side);
}

CaseFile read_case_text(CaseFormats formats, const std::string& content, const fs::path& path,
                        std::span<const std::string> overrides, const std::string& side) {
  auto text = std::make_shared<CaseText>();
  Problems& problems = text->problems;
  const int source = problems.add_source(source_from_text(path.string(), content));
  auto root = parse_document(content, source, problems, all_tables(formats));
  problems.throw_if_errors();
  text->root = std::move(*root);
  refuse_study(text->root, path, problems);
  const bool has_sides = format_of(formats, method_name(text->root)).has_sides;
  for (const std::string& setting : overrides)
    if (!has_sides || !is_of_side(setting)) apply_override(text->root, setting, problems, side);
  const CaseFormat& format = format_of(formats, method_name(text->root));
  if (format.has_sides && !side.empty()) {
    problems.error(find_place(text->root, "case.method"),
                   fmt::format("a side of a hybrid case is of method {} itself", format.method),
                   "give [case] the method with which this side is solved");
    problems.throw_if_errors();
  }
  check_structure(text->root, TablesWithChoice(formats, format.tables).tables(), problems);

  const ReadSide read_side = [formats](const fs::path& of, std::span<const std::string> own, const std::string& key) {
    return read_case(formats, of, own, key);
  };
  CaseFile file{{path, text}, std::string(format.method), {}, ""};
  format.read({text->root, format.tables, path.parent_path(), problems, fs::absolute(path).parent_path(), overrides, read_side},
              file);
  problems.throw_if_errors();
  file.warnings = problems.warning_text();
  return file;
}

std::string warning(const CaseSource& source, const std::string& key, std::string what, std::string help) {
  Problems problems;
  for (int i = 0; i < source.text->problems.source_count(); ++i) problems.add_source(source.text->problems.source(i));
  problems.warning(find_place(source.text->root, key), std::move(what), std::move(help));
  return problems.warning_text();
}

void refuse(const CaseSource& source, const std::string& key, std::string what, std::string help) {
  Problems problems = source.text->problems;
  problems.error(find_place(source.text->root, key), std::move(what), std::move(help));
  throw UserError(problems.error_text());
}

void refuse_outside_histories(const CaseFile& file) {
  for (const OutsideHistory& history : file.histories)
    refuse(file, history.key,
           fmt::format("the {} \"{}\" is a function, which a case file cannot contain", history.what, history.name),
           fmt::format("run the case from Python with functions={{\"{}\": ...}}, or give a table", history.name));
}

}  // namespace sazare::cases
