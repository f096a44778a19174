#include "sazare/cases/case_file.hpp"

#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "sazare/cases/case_text.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/cases/field_reader.hpp"
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
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
    throw UserError(fmt::format("cannot read the case file {}: is the path right?", path.string()));
  return text.str();
}

class CaseReader {
public:
  CaseReader(const Value& root, const fs::path& folder) : root_(root), folder_(folder) {}

  BlocksCase read() {
    BlocksCase blocks;
    const Entry head = entries_of("case").front();
    FieldReader(head, folder_)("title", blocks.title);
    read_one("mesh", blocks.mesh);
    read_list("materials", blocks.materials);
    read_list("joints", blocks.joints);
    read_one("contact", blocks.contact);
    read_list("blasts", blocks.blasts);
    read_one("gravity", blocks.gravity);
    read_list("boundaries", blocks.boundaries);
    read_list("constraints", blocks.constraints);
    read_list("initial_velocities", blocks.initial_velocities);
    read_list("gauges", blocks.gauges);
    read_one("time", blocks.time);
    read_one("output", blocks.output);
    return blocks;
  }

private:
  std::vector<Entry> entries_of(std::string_view table) const {
    return entries(root_, *find_table(blocks_schema(), table));
  }

  template <class Item>
  void read_one(std::string_view table, Item& item) {
    const Entry entry = entries_of(table).front();
    FieldReader reader(entry, folder_);
    visit_fields(reader, item);
  }

  template <class Item>
  void read_list(std::string_view table, std::vector<Item>& items) {
    for (const Entry& entry : entries_of(table)) {
      FieldReader reader(entry, folder_);
      visit_fields(reader, items.emplace_back());
    }
  }

  const Value& root_;
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

std::vector<Entry> CheckContext::entries_of(std::string_view table) const {
  return entries(root, *find_table(blocks_schema(), table));
}

CaseFile read_case(const fs::path& path, std::span<const std::string> overrides) {
  const std::string content = read_text(path);
  auto text = std::make_shared<CaseText>();
  Problems& problems = text->problems;
  const int source = problems.add_source(source_from_text(path.string(), content));
  auto root = parse_document(content, source, problems);
  problems.throw_if_errors();
  text->root = std::move(*root);
  for (const std::string& setting : overrides) apply_override(text->root, setting, problems);
  check_structure(text->root, blocks_schema(), problems);

  const fs::path folder = fs::absolute(path).parent_path();
  BlocksCase blocks = CaseReader(text->root, folder).read();
  check_meaning({text->root, path.parent_path(), problems}, blocks);
  if (blocks.time.strict) problems.turn_warnings_into_errors();
  problems.throw_if_errors();
  return {path, std::move(blocks), problems.warning_text(), text};
}

std::string warning(const CaseFile& file, const std::string& key, std::string what, std::string help) {
  Problems problems;
  for (int i = 0; i < file.text->problems.source_count(); ++i)
    problems.add_source(file.text->problems.source(i));
  problems.warning(find_place(file.text->root, key), std::move(what), std::move(help));
  return problems.warning_text();
}

void refuse(const CaseFile& file, const std::string& key, std::string what, std::string help) {
  Problems problems = file.text->problems;
  problems.error(find_place(file.text->root, key), std::move(what), std::move(help));
  throw UserError(problems.error_text());
}

}  // namespace sazare::cases
