#pragma once

#include <future>

#include "sazare/coupling/file_channel.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sazare::coupling::test {

using sazare::test::read_text;
using sazare::test::TemporaryFolder;
using sazare::test::words_of;
using sazare::test::write_text;

inline ExchangeOptions options_of(const TemporaryFolder& folder, Side side, ExchangeMark mark = {}, Real time_out = 10) {
  return {folder.path(), side, std::move(mark), true, time_out, nullptr};
}

/// Two segments in the plane.
inline SurfaceShape two_segments() { return {2, 0.4, 1e-3, {0, 0, 1, 0, 1, 1}, {0, 1, 1, 2}}; }

inline SurfaceMotion motion_of(std::int64_t window, std::int32_t pass = 0) {
  const Real at = static_cast<Real>(window + 1) / 3;
  return {window, pass, at, {at, 0, -0.0, 5e-324, 1.7976931348623157e308, at * at}, {1, 2, 3, 4, 5, 6}};
}

inline SurfaceForce force_of(std::int64_t window, std::int32_t pass = 0) {
  const Real at = static_cast<Real>(window + 1) / 3;
  return {window, pass, at, {at, 1, 2, 3, 4, 5}, {-at, 1, 2, 3, 4, 5}};
}

/// Two ends that have met.
struct Pair {
  TemporaryFolder folder;
  FileContinuumChannel continuum{options_of(folder, Side::continuum)};
  FileBodyChannel bodies{options_of(folder, Side::bodies)};

  Pair() {
    auto opened = std::async(std::launch::async, [this] { return continuum.open(two_segments()); });
    bodies.open();
    bodies.answer(force_of(-1));
    opened.get();
  }
  std::filesystem::path file(Side side, std::int64_t sequence) const { return folder.path() / file_name(side, sequence); }
};

#define EXPECT_WORDS(words, part) EXPECT_NE((words).find(part), std::string::npos) << "words: " << (words)

}  // namespace sazare::coupling::test
