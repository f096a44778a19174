#include "sazare/cases/study_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/format/field_reader.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/shell_word.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/core/error.hpp"

namespace sazare::cases {
namespace {

template <class Visitor>
void visit_fields(Visitor& visit, StudyFamily& family) {
  visit("name", family.name);
  visit("case", family.file);
}

template <class Visitor>
void visit_fields(Visitor& visit, StudyParameter& parameter) {
  visit("name", parameter.name);
  visit("unit", parameter.unit);
  visit("keys", parameter.keys);
  visit("values", parameter.values);
}

template <class Visitor>
void visit_fields(Visitor& visit, StudyLimit& limit) {
  visit("ratio", limit.ratio);
  visit("steps", limit.steps);
  visit("divergence", limit.divergence);
}

template <class Item>
std::vector<Item> read_list(const CheckContext& context, std::string_view table, const std::filesystem::path& folder) {
  std::vector<Item> items;
  std::vector<std::string> names;
  for (const Entry& entry : context.entries_of(table)) {
    FieldReader reader(entry, folder);
    visit_fields(reader, items.emplace_back());
    names.push_back(items.back().name);
  }
  check_unique_names(context, table, names);
  return items;
}

void check_study(const CheckContext& context, const Study& study) {
  const auto families = context.entries_of("families");
  for (std::size_t i = 0; i < families.size(); ++i)
    if (families[i].gives("case"))
      check_file(context, families[i].place("case"), "case file", study.families[i].file,
                 *families[i].value->find("case")->text());
  const auto parameters = context.entries_of("parameters");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::size_t keys = study.parameters[i].keys.size();
    if (!parameters[i].gives("keys") || keys == 1 || keys == study.families.size()) continue;
    context.problems.error(parameters[i].place("keys"),
                           fmt::format("there are {} keys and {} families", keys, study.families.size()),
                           "give one key for all families, or one for each, in their order");
  }
}

}  // namespace

std::size_t Study::size() const {
  std::size_t count = families.size();
  for (const StudyParameter& parameter : parameters) count *= parameter.values.size();
  return count;
}

const StudyFamily& Study::family(std::size_t number) const { return families[number / (size() / families.size())]; }

std::vector<Real> Study::values(std::size_t number) const {
  std::vector<Real> result(parameters.size());
  for (std::size_t i = parameters.size(); i-- > 0; number /= parameters[i].values.size())
    result[i] = parameters[i].values[number % parameters[i].values.size()];
  return result;
}

std::vector<std::string> Study::overrides(std::size_t number) const {
  const std::size_t which = number / (size() / families.size());
  const std::vector<Real> chosen = values(number);
  std::vector<std::string> settings;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& keys = parameters[i].keys;
    settings.push_back(fmt::format("{}={}", keys.size() == 1 ? keys.front() : keys[which], number_text(chosen[i])));
  }
  return settings;
}

namespace {

void refuse_case(const Value& root, const std::filesystem::path& path, Problems& problems) {
  const Value* found = root.find("case");
  if (found == nullptr || root.find("study") != nullptr) return;
  problems.error(found->place, "this is a case, not a study",
                 fmt::format("use it with: sazare run {}", shell_word(path.string())));
  problems.throw_if_errors();
}

}  // namespace

Study read_study(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw UserError(fmt::format("cannot read the study file {}: is the path right?", path.string()));
  Problems problems;
  const int source = problems.add_source(source_from_text(path.string(), text.str()));
  auto root = parse_document(text.str(), source, problems);
  problems.throw_if_errors();
  refuse_case(*root, path, problems);
  check_structure(*root, study_schema(), problems);
  problems.throw_if_errors();
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  const CheckContext context{*root, study_schema(), path.parent_path(), problems, folder};
  Study study;
  study.path = path;
  study.title = *context.entries_of("study").front().value->find("title")->text();
  study.families = read_list<StudyFamily>(context, "families", folder);
  study.parameters = read_list<StudyParameter>(context, "parameters", folder);
  const Entry limit = context.entries_of("limit").front();
  FieldReader reader(limit, folder);
  visit_fields(reader, study.limit);
  check_study(context, study);
  problems.throw_if_errors();
  return study;
}

}  // namespace sazare::cases
