#pragma once

#include <cstddef>

#include "tests/support/temporary_folder.hpp"

namespace sazare::observe::test {

using sazare::test::read_text;
using sazare::test::TemporaryFolder;
using sazare::test::words_of;
using sazare::test::write_text;

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

}  // namespace sazare::observe::test

#define EXPECT_WORDS(words, part) EXPECT_NE((words).find(part), std::string::npos) << "words: " << (words)
