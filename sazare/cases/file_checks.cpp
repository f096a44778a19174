#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/suggest.hpp"

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

/// Files of the same kind in the folder of a file, as a case writes them that names the file as `written`.
std::vector<std::string> files_beside(const fs::path& file, const fs::path& written) {
  std::vector<std::string> names;
  std::error_code failure;
  for (auto entry = fs::directory_iterator(file.parent_path(), failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure)) {
    const bool same_kind = entry->path().extension() == file.extension();
    if (same_kind && entry->is_regular_file(failure)) names.push_back(written.parent_path() / entry->path().filename());
  }
  std::ranges::sort(names);
  return names;
}

void report_missing_file(const CheckContext& context, const Place& place, std::string_view what, const fs::path& file,
                         const std::string& as_written) {
  std::error_code failure;
  if (fs::exists(file, failure)) {
    context.problems.error(place, fmt::format("{} is not a file: {}", what, as_written), "name a file");
    return;
  }
  const auto shown = (context.shown_folder / as_written).lexically_normal().string();
  const auto others = files_beside(file, as_written);
  const std::string other_files = others.empty() ? "" : fmt::format("; {}", suggestion(as_written, others, "files there"));
  context.problems.error(place, fmt::format("{} not found: {}", what, as_written),
                         fmt::format("paths are relative to the case file; looked for {}{}", shown, other_files));
}

bool is_file(const fs::path& file) {
  std::error_code failure;
  return fs::is_regular_file(file, failure);
}

}  // namespace

bool check_file(const CheckContext& context, const Place& place, std::string_view what, const fs::path& file,
                const std::string& as_written) {
  if (is_file(file)) return true;
  report_missing_file(context, place, what, file, as_written);
  return false;
}

void check_mesh_file(const CheckContext& context, const Mesh& mesh) {
  const Entry entry = context.entries_of("mesh").front();
  if (!entry.gives("file")) return;
  const std::string& as_written = *entry.value->find("file")->text();
  const std::string kind = mesh.file.extension().string();
  if (kind != ".msh" && kind != ".geo") {
    context.problems.error(entry.place("file"), fmt::format("{} is neither a .msh nor a .geo file", as_written),
                           "save the mesh by Gmsh as .msh, format 4.1, or name the geometry (.geo)");
    return;
  }
  if (!is_file(mesh.file)) report_missing_file(context, entry.place("file"), "mesh file", mesh.file, as_written);
  for (std::string_view key : {"size_factor", "parameters"}) {
    if (mesh.is_geometry() || !entry.has(key)) continue;
    context.problems.error(*entry.value->key_place(key), fmt::format("{} is only for a .geo file", key),
                           fmt::format("remove it: {} is meshed already", as_written));
  }
}

}  // namespace sazare::cases
