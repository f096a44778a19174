#pragma once

/// The folder of a run: its names, and who may write there.

#include <filesystem>
#include <string>
#include <utility>

namespace sazare::runs {

/// How a run begins in its folder.
enum class Begin {
  fresh,      ///< only where no run is yet
  overwrite,  ///< replaces the run that is there, once the new one can begin
  resume,     ///< goes on from its checkpoint
};

/// One process at a time writes a run: the folder is held until the object goes.
class RunFolder {
public:
  /// Makes the folder. Throws UserError when it holds a run and `begin` does not say what to do with it, when the run
  /// to be resumed is done, when files with the names of a run's are there that belong to none, when a folder of the run is a
  /// symbolic link, or when another process is at work there; MachineError when it cannot be written.
  RunFolder(std::filesystem::path folder, Begin begin);
  /// For a process that helps another one with its run: only the names. The folder must have been made.
  static RunFolder of_another(std::filesystem::path folder, Begin begin);
  /// The folder of a side of a coupled run, within that of the whole.
  static RunFolder of_side(const RunFolder& whole, const std::string& name, Begin begin);
  ~RunFolder();
  RunFolder(RunFolder&& other) noexcept;
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path case_file() const { return path_ / "case.toml"; }
  std::filesystem::path manifest() const { return path_ / "manifest.json"; }
  std::filesystem::path history() const { return path_ / "history.csv"; }
  std::filesystem::path gauges() const { return path_ / "gauges.csv"; }
  std::filesystem::path gauge_peaks() const { return path_ / "gauge_peaks.csv"; }
  std::filesystem::path walls() const { return path_ / "walls.csv"; }
  std::filesystem::path fragments() const { return path_ / "fragments.csv"; }
  std::filesystem::path holes() const { return path_ / "holes.csv"; }
  std::filesystem::path half_casts() const { return path_ / "half_casts.csv"; }
  std::filesystem::path ranks() const { return path_ / "ranks.csv"; }
  std::filesystem::path timing() const { return path_ / "timing.csv"; }
  /// The mesh that is made for the run; until the run begins it stands beside what is there.
  std::filesystem::path mesh() const { return path_ / (replaces_ ? "mesh.new.msh" : "mesh.msh"); }
  std::filesystem::path snapshots() const { return path_ / "snapshots"; }
  std::filesystem::path checkpoint() const { return path_ / "checkpoint" / "state.h5"; }

  /// Whether there is a checkpoint to go on from.
  bool resumes() const { return resumes_; }

  /// Removes the run that is to be replaced: to be called when the new one is ready to begin.
  void clear();

  void remove_checkpoint() const;

private:
  enum class Kind { run, side };

  RunFolder(std::filesystem::path folder, Begin begin, Kind kind);
  explicit RunFolder(std::filesystem::path folder) : path_(std::move(folder)) {}
  std::filesystem::path checkpoint_folder() const { return checkpoint().parent_path(); }
  void hold();
  void refuse_links() const;
  void refuse_unless_free() const;
  void refuse_files_of_others() const;
  void refuse_when_done() const;
  void remove_run() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  bool resumes_ = false;
  bool replaces_ = false;  ///< what is there, and has not done so yet
};

/// `status` of the run in a folder; empty when there is no run, or no readable manifest.
std::string run_status(const std::filesystem::path& folder);

}  // namespace sazare::runs
