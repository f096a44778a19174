#include "sazare/observe/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::observe {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

std::string_view advice_for(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "Free space there, or choose another output folder (--out)";
    case EFBIG:
      return "Files there may not become so large (ulimit -f): raise the limit, or choose another output "
             "folder (--out)";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Choose an output folder that you may write to (--out)";
    case ELOOP:
      return "It is a symbolic link, which is not followed: remove it";
    case ENOENT:
    case ENOTDIR:
      return "The folder does not exist: create it, or choose another (--out)";
    default:
      return "Check the disk, or choose another output folder (--out)";
  }
}

}  // namespace

void fail_to_write(const fs::path& file, int error) {
  throw MachineError(
      fmt::format("{}: cannot be written: {}. {}", file.string(), std::generic_category().message(error), advice_for(error)));
}

int make_file(const fs::path& file, int access) {
  unlink(file.c_str());
  return open(file.c_str(), access | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

AtomicFile::AtomicFile(fs::path file) : file_(std::move(file)) {
  temporary_ = folder_of(file_) / fmt::format(".{}.part", file_.filename().string());
  descriptor_ = make_file(temporary_, O_RDWR);
  if (descriptor_ < 0) fail_to_write(file_, errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = ::write(descriptor_, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_write(file_, errno);
    content.remove_prefix(static_cast<std::size_t>(count));
  }
}

void AtomicFile::commit(Sync sync) {
  if (sync == Sync::disk && fsync(descriptor_) != 0) fail_to_write(file_, errno);
  if (rename(temporary_.c_str(), file_.c_str()) != 0) fail_to_write(file_, errno);
  close(std::exchange(descriptor_, -1));
  if (sync == Sync::disk) sync_folder(folder_of(file_));
}

void write_file(const fs::path& file, std::string_view content, Sync sync) {
  AtomicFile atomic(file);
  atomic.write(content);
  atomic.commit(sync);
}

void sync_file(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(file, errno);
  const int error = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  if (error != 0) fail_to_write(file, error);
}

void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace sazare::observe
