#include "sazare/runs/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
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

/// Snapshots, their lists, and parts of them that a killed run has left.
bool is_snapshot(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string_view visible = std::string_view(name).substr(name.starts_with('.') ? 1 : 0);
  const bool ours = visible.starts_with("elements") || visible.starts_with("joints") || visible.starts_with("particles") ||
                    visible.starts_with("finite_elements");
  return ours && (name.ends_with(".vtkhdf") || name.ends_with(".series") || name.ends_with(".part"));
}

}  // namespace

std::string run_status(const fs::path& folder) {
  std::ifstream stream(folder / "manifest.json");
  if (!stream) return {};
  const nlohmann::json manifest = nlohmann::json::parse(stream, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("status") || !manifest["status"].is_string()) return {};
  return manifest["status"].get<std::string>();
}

RunFolder::RunFolder(fs::path folder, Begin begin) : path_(std::move(folder)) {
  if (fs::exists(path_) && !fs::is_directory(path_))
    throw UserError(fmt::format("{}: is a file, and should be the folder of a run. Choose another (--out)", path_.string()));
  make_folder(path_);
  hold();
  try {
    if (begin == Begin::fresh) refuse_unless_free();
    if (begin == Begin::resume) refuse_when_done();
    replaces_ = begin == Begin::overwrite;
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
  names.replaces_ = begin == Begin::overwrite;
  names.resumes_ = begin == Begin::resume && fs::exists(names.checkpoint());
  return names;
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
  throw UserError(
      fmt::format("{}: another sazare process is using this folder. Wait for it, or choose another folder (--out)",
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
  std::vector<fs::path> files = {history(),
                                 gauges(),
                                 walls(),
                                 fragments(),
                                 timing(),
                                 ranks(),
                                 mesh(),
                                 case_file(),
                                 path_ / "report.html",
                                 path_ / "study.csv",
                                 path_ / "study.id",
                                 path_ / "regression.csv",
                                 path_ / "regression_lines.csv"};
  for (const auto& entry : fs::directory_iterator(snapshots(), ignored))
    if (is_snapshot(entry.path())) files.push_back(entry.path());
  files.push_back(manifest());
  for (const fs::path& file : files) remove_file(file);
}

}  // namespace sazare::runs
