#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "sazare/core/error.hpp"
#include "sazare/observe/atomic_file.hpp"

namespace sazare::runs {

/// A folder that goes when the object does.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (error)
      throw MachineError(
          fmt::format("the folder for temporary files is missing ({}): set TMPDIR to a folder that is there", error.message()));
    std::string name = (parent / "sazare-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) observe::fail_to_write(name, errno);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!is_kept_) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  void keep() { is_kept_ = true; }

private:
  std::filesystem::path path_;
  bool is_kept_ = false;
};

/// What `check` finds with a folder for the meshes that gmsh makes. They are gone afterwards, but where an error tells of one: it
/// then ends with where the mesh is.
inline std::string check_with_meshes(const std::function<std::string(const std::filesystem::path&)>& check) {
  TemporaryFolder folder;
  try {
    return check(folder.path());
  } catch (const UserError& error) {
    if (std::filesystem::is_empty(folder.path())) throw;
    folder.keep();
    throw UserError(
        fmt::format("{}\n  the mesh that gmsh generated for the case is kept in {}", error.what(), folder.path().string()));
  }
}

}  // namespace sazare::runs
