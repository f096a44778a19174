#include "sazare/cases/case_file.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "sazare/cases/case_text.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/cases/fem_fields.hpp"
#include "sazare/cases/field_reader.hpp"
#include "sazare/cases/hybrid_fields.hpp"
#include "sazare/cases/rectangles_fields.hpp"
#include "sazare/cases/spheres_fields.hpp"
#include "sazare/cases/structure_check.hpp"
#include "sazare/core/error.hpp"

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure))
    throw UserError(fmt::format("{} is a folder; name the case file in it, such as {}", path.string(),
                                (path / "case.toml").lexically_normal().string()));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  const int error = errno;
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
    throw UserError(fmt::format("cannot read the case file {}: {}", path.string(),
                                error == 0 || error == ENOENT ? "is the path right?" : std::generic_category().message(error)));
  return text.str();
}

/// Fills a case from the document; the visitor of `visit_tables`.
class CaseReader {
public:
  CaseReader(const Value& root, std::span<const Table> schema, const fs::path& folder)
      : root_(root), schema_(schema), folder_(folder) {}

  template <class Case>
  Case read() {
    Case result;
    const Entry head = entries_of("case").front();
    FieldReader(head, folder_)("title", result.title);
    visit_tables(*this, result);
    return result;
  }

  template <class Item>
  void one(std::string_view table, Item& item) {
    const Entry entry = entries_of(table).front();
    FieldReader reader(entry, folder_);
    visit_fields(reader, item);
  }

  template <class Item>
  void list(std::string_view table, std::vector<Item>& items) {
    for (const Entry& entry : entries_of(table)) {
      FieldReader reader(entry, folder_);
      visit_fields(reader, items.emplace_back());
    }
  }

private:
  std::vector<Entry> entries_of(std::string_view table) const { return entries(root_, *find_table(schema_, table)); }

  const Value& root_;
  std::span<const Table> schema_;
  const fs::path& folder_;
};

void check_meaning(const CheckContext& context, BlocksCase& blocks) {
  check_mesh_file(context, blocks.mesh);
  check_names(context, blocks);
  check_joints(context, blocks);
  check_contact(context);
  check_blasts(context, blocks);
  check_constraints(context, blocks);
  resolve_clocks(context, blocks.time);
}

void check_meaning(const CheckContext& context, MpsCase& mps) {
  check_mps(context, mps);
  resolve_clocks(context, mps.time);
}

void check_meaning(const CheckContext& context, RectanglesCase& rectangles) {
  check_rectangles(context, rectangles);
  resolve_clocks(context, rectangles.time);
}

void check_meaning(const CheckContext& context, SpheresCase& spheres) {
  check_spheres(context, spheres);
  resolve_clocks(context, spheres.time);
}

void check_meaning(const CheckContext& context, FemCase& fem) {
  check_fem(context, fem);
  resolve_clocks(context, fem.time);
}

template <class Case>
MethodCase read_method(const CheckContext& context, const fs::path& folder) {
  Case result = CaseReader(context.root, context.schema, folder).read<Case>();
  check_meaning(context, result);
  if (result.time.strict) context.problems.turn_warnings_into_errors();
  return result;
}

MethodCase read_hybrid(const CheckContext& context, const fs::path& folder, std::span<const std::string> overrides) {
  HybridCase result = CaseReader(context.root, context.schema, folder).read<HybridCase>();
  check_hybrid(context, result, overrides);
  return result;
}

/// Whether a setting is one of a side's case.
bool is_of_side(const std::string& setting) { return setting.starts_with("continuum.") || setting.starts_with("bodies."); }

/// Name of the method as the file gives it; empty where it does not.
std::string method_name(const Value& root) {
  const Value* head = root.find("case");
  const Value* method = head == nullptr || !head->is_table() ? nullptr : head->find("method");
  return method == nullptr || method->text() == nullptr ? "" : *method->text();
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

CaseFile read_case(const fs::path& path, std::span<const std::string> overrides, const std::string& side) {
  return read_case_text(read_text(path), path, overrides, side);
}

CaseFile read_case_text(const std::string& content, const fs::path& path, std::span<const std::string> overrides,
                        const std::string& side) {
  auto text = std::make_shared<CaseText>();
  Problems& problems = text->problems;
  const int source = problems.add_source(source_from_text(path.string(), content));
  auto root = parse_document(content, source, problems);
  problems.throw_if_errors();
  text->root = std::move(*root);
  const bool has_sides = method_name(text->root) == "hybrid";
  for (const std::string& setting : overrides)
    if (!has_sides || !is_of_side(setting)) apply_override(text->root, setting, problems, side);
  const std::string method = method_name(text->root);
  const std::span<const Table> schema = schema_of(method);
  check_structure(text->root, schema, problems);

  const fs::path folder = fs::absolute(path).parent_path();
  const CheckContext context{text->root, schema, path.parent_path(), problems};
  MethodCase checked = method == "mps"          ? read_method<MpsCase>(context, folder)
                       : method == "rectangles" ? read_method<RectanglesCase>(context, folder)
                       : method == "spheres"    ? read_method<SpheresCase>(context, folder)
                       : method == "fem"        ? read_method<FemCase>(context, folder)
                       : method == "hybrid"     ? read_hybrid(context, folder, overrides)
                                                : read_method<BlocksCase>(context, folder);
  problems.throw_if_errors();
  return {path, std::move(checked), problems.warning_text(), text};
}

std::string warning(const CaseFile& file, const std::string& key, std::string what, std::string help) {
  Problems problems;
  for (int i = 0; i < file.text->problems.source_count(); ++i) problems.add_source(file.text->problems.source(i));
  problems.warning(find_place(file.text->root, key), std::move(what), std::move(help));
  return problems.warning_text();
}

void refuse(const CaseFile& file, const std::string& key, std::string what, std::string help) {
  Problems problems = file.text->problems;
  problems.error(find_place(file.text->root, key), std::move(what), std::move(help));
  throw UserError(problems.error_text());
}

}  // namespace sazare::cases
