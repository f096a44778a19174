#include "sazare/runs/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "sazare/core/error.hpp"
#include "sazare/observe/atomic_file.hpp"

namespace sazare::runs {

namespace fs = std::filesystem;

namespace {

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) observe::fail_to_write(folder, error.value());
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) observe::fail_to_write(file, error.value());
}

/// Files of a run or a study, of whatever method, by their names; the manifest is none of them.
constexpr std::array file_names = {"case.toml",     "history.csv",    "gauges.csv",          "gauge_peaks.csv", "walls.csv",
                                   "fragments.csv", "holes.csv",      "half_casts.csv",      "timing.csv",      "ranks.csv",
                                   "mesh.msh",      "report.html",    "ground_motion.csv",   "study.csv",       "study.id",
                                   "profiles.csv",  "structures.csv",  "regression.csv", "regression_lines.csv"};
constexpr std::array folder_names = {"snapshots", "checkpoint", "continuum", "bodies", "trials"};
constexpr std::array side_names = {"continuum", "bodies"};
constexpr std::array series_names = {"elements", "joints", "particles", "finite_elements", "rectangles", "walls"};

/// Snapshots, their lists, and parts of them that a killed run has left: NAME_00000.vtkhdf, NAME.vtkhdf.series.
bool is_snapshot(const fs::path& file) {
  const std::string name = file.filename().string();
  std::string_view visible = name;
  if (visible.starts_with('.') && visible.ends_with(".part")) visible = visible.substr(1, visible.size() - 6);
  return std::ranges::any_of(series_names, [&](std::string_view series) {
    if (!visible.starts_with(series)) return false;
    std::string_view rest = visible.substr(series.size());
    if (rest == ".vtkhdf.series" || rest == ".hdf.series") return true;
    if (!rest.starts_with('_') || !rest.ends_with(".vtkhdf")) return false;
    rest = rest.substr(1, rest.size() - 8);
    return rest.size() >= 5 && rest.find_first_not_of("0123456789") == std::string_view::npos;
  });
}

bool is_link(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(path, ignored));
}

std::vector<fs::path> snapshots_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "snapshots", ignored))
    if (is_snapshot(entry.path())) found.push_back(entry.path());
  return found;
}

void remove_files_of(const fs::path& folder) {
  for (const char* name : file_names) remove_file(folder / name);
  if (is_link(folder / "snapshots")) return;
  for (const fs::path& file : snapshots_in(folder)) remove_file(file);
}

/// Files of a kind in a folder that has no others: pictures of the report, tables of the trials of a study.
void remove_files_in(const fs::path& folder, std::string_view kind) {
  if (is_link(folder)) return;
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == kind) found.push_back(entry.path());
  for (const fs::path& file : found) remove_file(file);
  fs::remove(folder, ignored);  // where nothing of others is left
}

}  // namespace

std::string run_status(const fs::path& folder) {
  std::error_code unknown;
  if (!fs::is_regular_file(folder / "manifest.json", unknown)) return {};
  std::ifstream stream(folder / "manifest.json");
  if (!stream) return {};
  const nlohmann::json manifest = nlohmann::json::parse(stream, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("status") || !manifest["status"].is_string()) return {};
  return manifest["status"].get<std::string>();
}

RunFolder::RunFolder(fs::path folder, Begin begin) : RunFolder(std::move(folder), begin, Kind::run) {}

RunFolder::RunFolder(fs::path folder, Begin begin, Kind kind) : path_(std::move(folder)) {
  std::error_code unknown;
  if (fs::exists(path_, unknown) && !fs::is_directory(path_, unknown))
    throw UserError(fmt::format("{}: is a file, and should be the folder of a run. Choose another (--out)", path_.string()));
  make_folder(path_);
  hold();
  try {
    refuse_links();
    if (begin == Begin::fresh) refuse_unless_free();
    if (begin == Begin::resume) refuse_when_done();
    if (kind == Kind::run) refuse_files_of_others();
    replaces_ = begin != Begin::resume;
    if (replaces_) remove_file(mesh());  // of a run that could not begin
    resumes_ = begin == Begin::resume && fs::exists(checkpoint());
    make_folder(checkpoint_folder());
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

RunFolder RunFolder::of_another(fs::path folder, Begin begin) {
  RunFolder names(std::move(folder));
  names.replaces_ = begin != Begin::resume;
  names.resumes_ = begin == Begin::resume && fs::exists(names.checkpoint());
  return names;
}

RunFolder RunFolder::of_side(const RunFolder& whole, const std::string& name, Begin begin) {
  const fs::path folder = whole.path() / name;
  return begin == Begin::resume ? of_another(folder, begin) : RunFolder(folder, begin, Kind::side);
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      resumes_(other.resumes_),
      replaces_(other.replaces_) {}

RunFolder::~RunFolder() {
  if (descriptor_ >= 0) close(descriptor_);
}

/// The lock goes with the process, however it ends.
void RunFolder::hold() {
  descriptor_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) observe::fail_to_write(path_, errno);
  if (access(path_.c_str(), W_OK) != 0) {
    const int error = errno;
    close(descriptor_);
    observe::fail_to_write(path_, error);
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw UserError(fmt::format("{}: another sazare process is using this folder. Wait for it, or choose another folder (--out)",
                              path_.string()));
}

void RunFolder::refuse_unless_free() const {
  if (!fs::exists(manifest()) && !fs::exists(history()) && !fs::exists(checkpoint())) return;
  const std::string status = run_status(path_);
  const bool done = status == "done";
  throw UserError(
      fmt::format("{}: this folder already contains a run{}. {}--overwrite to replace it, or another folder "
                  "(--out)",
                  path_.string(),
                  done             ? ", which is complete"
                  : status.empty() ? ""
                                   : ", which is not complete",
                  done ? "Use " : "Use --resume to continue it, "));
}

/// A folder may come from a stranger: a link in it would lead what is written, or removed, to some other place.
void RunFolder::refuse_links() const {
  for (const char* name : folder_names)
    if (is_link(path_ / name))
      throw UserError(fmt::format(
          "{}: is a symbolic link: a run would write, and remove files, where it leads. Remove it, or choose another folder "
          "(--out)",
          (path_ / name).string()));
  for (const char* name : file_names) {
    std::error_code unknown;
    const fs::file_status status = fs::status(path_ / name, unknown);
    if (fs::exists(status) && !fs::is_regular_file(status))
      throw UserError(fmt::format("{}: is no file, as a run writes it. Remove it, or choose another folder (--out)",
                                  (path_ / name).string()));
  }
}

/// Files with the names of a run's where no run is are somebody's own.
void RunFolder::refuse_files_of_others() const {
  if (fs::exists(manifest()) || fs::exists(checkpoint()) || fs::exists(path_ / "study.id")) return;
  std::vector<fs::path> found = snapshots_in(path_);
  for (const char* name : file_names)
    if (fs::exists(fs::symlink_status(path_ / name))) found.push_back(path_ / name);
  const bool only_mesh = found.size() == 1 && found.front() == path_ / "mesh.msh";
  if (found.empty() || (only_mesh && fs::is_directory(checkpoint_folder())))
    return;  // a run that was killed at its beginning leaves these
  throw UserError(fmt::format(
      "{}: is there already, and belongs to no run: a run in this folder would replace it. Choose another folder (--out)",
      found.back().string()));
}

void RunFolder::refuse_when_done() const {
  if (run_status(path_) != "done") return;
  throw UserError(
      fmt::format("{}: the run in this folder is complete, there is nothing to resume. Its figures are in manifest.json; use "
                  "--overwrite to run the case again",
                  path_.string()));
}

void RunFolder::clear() {
  if (!replaces_) return;
  const fs::path made = mesh();
  replaces_ = false;
  remove_run();
  make_folder(path_);
  make_folder(checkpoint_folder());
  std::error_code error;
  if (fs::exists(made)) fs::rename(made, mesh(), error);
  if (error) observe::fail_to_write(mesh(), error.value());
}

void RunFolder::remove_checkpoint() const {
  std::error_code ignored;
  fs::remove_all(checkpoint_folder(), ignored);
}

/// The manifest goes last: until then the folder still counts as one of a run.
void RunFolder::remove_run() const {
  std::error_code ignored;
  remove_checkpoint();
  for (const char* side : side_names) {
    if (is_link(path_ / side)) continue;
    remove_files_of(path_ / side);
    remove_file(path_ / side / "manifest.json");
    fs::remove(path_ / side / "checkpoint", ignored);
    fs::remove(path_ / side / "snapshots", ignored);
    fs::remove(path_ / side, ignored);  // where nothing of others is left
  }
  remove_files_in(path_ / "report", ".png");
  remove_files_in(path_ / "trials", ".csv");
  remove_files_of(path_);
  remove_file(manifest());
}

}  // namespace sazare::runs
