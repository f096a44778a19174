#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "sazare/observe/atomic_file.hpp"

namespace sazare::runs {

/// A folder that goes when the object does.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sazare-check-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) observe::fail_to_write(name, errno);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

}  // namespace sazare::runs
