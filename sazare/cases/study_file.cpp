#include "sazare/cases/study_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/format/enum_words.hpp"
#include "sazare/cases/format/field_reader.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/shell_word.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/core/error.hpp"

namespace sazare::cases {

template <>
struct EnumWords<Sought> {
  static constexpr std::array<std::string_view, 2> words{"time_step", "factor_of_safety"};
};

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

template <class Visitor>
void visit_fields(Visitor& visit, StudyFactor& factor) {
  visit("lower", factor.lower);
  visit("upper", factor.upper);
  visit("ratio", factor.ratio);
  visit("displacement_ratio", factor.displacement_ratio);
}

template <class Visitor>
void visit_fields(Visitor& visit, Study& study) {
  visit("title", study.title);
  visit("find", study.find);
}

template <class Item>
void read_table(const CheckContext& context, std::string_view table, Item& item) {
  const Entry entry = context.entries_of(table).front();
  FieldReader reader(entry, context.folder);
  visit_fields(reader, item);
}

template <class Item>
std::vector<Item> read_list(const CheckContext& context, std::string_view table) {
  std::vector<Item> items;
  std::vector<std::string> names;
  for (const Entry& entry : context.entries_of(table)) {
    FieldReader reader(entry, context.folder);
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

/// The table of what is not sought does nothing, and the bounds of a factor are in order.
void check_sought(const CheckContext& context, const Study& study) {
  const bool factor = study.find == Sought::factor_of_safety;
  const std::string_view foreign = factor ? "limit" : "factor";
  if (const Entry entry = context.entries_of(foreign).front(); entry.exists())
    context.problems.error(entry.header(),
                           fmt::format("[{}] is for find = \"{}\"", foreign, factor ? "time_step" : "factor_of_safety"),
                           fmt::format("remove it, or set find in [study]; this study finds \"{}\"",
                                       EnumWords<Sought>::words.at(static_cast<std::size_t>(study.find))));
  if (factor && !(study.factor.upper > study.factor.lower))
    context.problems.error(context.entries_of("factor").front().place("upper"),
                           fmt::format("upper must be above lower = {}, found {}", short_number(study.factor.lower),
                                       short_number(study.factor.upper)),
                           "give an upper at which the ground fails, above a lower at which it stands");
  else if (factor && !(study.factor.upper > study.factor.ratio * study.factor.lower))
    context.problems.error(
        context.entries_of("factor").front().place("upper"),
        fmt::format("the bounds {} and {} of the factor are closer than the ratio of {} at which the search ends",
                    short_number(study.factor.lower), short_number(study.factor.upper), short_number(study.factor.ratio)),
        "give an upper at which the ground fails, above a lower at which it stands");
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
  auto content = std::make_shared<CaseText>();
  Problems& problems = content->problems;
  const int source = problems.add_source(source_from_text(path.string(), text.str()));
  auto root = parse_document(text.str(), source, problems);
  problems.throw_if_errors();
  content->root = std::move(*root);
  refuse_case(content->root, path, problems);
  check_structure(content->root, study_schema(), problems);
  problems.throw_if_errors();
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  const CheckContext context{content->root, study_schema(), path.parent_path(), problems, folder};
  Study study;
  study.path = path;
  study.text = content;
  read_table(context, "study", study);
  study.families = read_list<StudyFamily>(context, "families");
  study.parameters = read_list<StudyParameter>(context, "parameters");
  read_table(context, "limit", study.limit);
  read_table(context, "factor", study.factor);
  check_study(context, study);
  check_sought(context, study);
  problems.throw_if_errors();
  return study;
}

}  // namespace sazare::cases
