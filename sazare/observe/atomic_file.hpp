#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sazare::observe {

/// How far a file is brought. `system`: it survives the end of the process, however it comes. `disk`: it
/// survives the end of the machine as well, which takes milliseconds and more.
enum class Sync { system, disk };

/// A file that appears under its name all at once: it is written to a temporary name in the same folder,
/// brought to the disk and renamed. Under its own name there is the former content or the new, never a part.
/// The temporary is removed when the object goes without a commit.
class AtomicFile {
public:
  /// Throws MachineError when the folder is missing or not writable.
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// The name that is written to.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// The temporary, open for reading and writing.
  int descriptor() const { return descriptor_; }

  /// Appends to the temporary. Throws MachineError, as when the disk is full.
  void write(std::string_view content);

  /// Gives the file its name. Throws MachineError; then the former file is still there.
  void commit(Sync sync = Sync::disk);

private:
  std::filesystem::path file_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
};

/// Writes a whole file; see AtomicFile.
void write_file(const std::filesystem::path& file, std::string_view content, Sync sync = Sync::disk);

/// Brings what a file holds that was written with Sync::system to the disk. Throws MachineError.
void sync_file(const std::filesystem::path& file);

/// Writes the names in a folder through to the disk. A file system that cannot do so is left as it is.
void sync_folder(const std::filesystem::path& folder);

/// Opens a new file for writing (`access` is O_WRONLY or O_RDWR). What had the name goes: a link itself, not what it leads to.
/// Returns -1 and sets errno where it cannot.
int make_file(const std::filesystem::path& file, int access);

/// Throws MachineError with the file, the words of `error` (an errno) and what to do.
[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error);

}  // namespace sazare::observe
