#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sazare::observe::test {

/// A folder that is removed with everything in it.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Names of the files in it, hidden ones included, in order.
  std::vector<std::string> files() const;

private:
  std::filesystem::path path_;
};

/// While it lives no file may grow beyond `bytes`: a full disk for anyone, root or not.
class SmallDisk {
public:
  explicit SmallDisk(std::size_t bytes);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

private:
  std::size_t former_limit_;
  void (*former_handler_)(int);
};

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// The words of the Error that `f` throws; empty when it throws none.
template <class Error, class F>
std::string words_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace sazare::observe::test

#define EXPECT_WORDS(words, part) EXPECT_NE((words).find(part), std::string::npos) << "words: " << (words)
