#pragma once

/// Memory that will be needed soon, asked for line by line while other work is done. A core reads what it asks for one after the
/// other from memory much faster than what it comes upon, and computes meanwhile.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace sazare {

class ComingLines {
public:
  /// A part of a table; of more than `most` parts the last ones are left out.
  template <class T>
  void add(std::span<const T> part) {
    if (part.empty() || count_ == most) return;
    const auto* const begin = reinterpret_cast<const char*>(part.data());
    parts_[count_++] = {begin, begin + part.size_bytes()};
    lines_ += (part.size_bytes() + line_bytes - 1) / line_bytes;
  }

  /// Lines of the cache in all parts.
  std::size_t lines() const { return lines_; }

  /// Asks for the next lines, so many at most.
  void fetch(std::size_t lines) {
    while (lines > 0 && now_ < count_) {
      Part& part = parts_[now_];
      for (; lines > 0 && part.next < part.end; part.next += line_bytes, --lines) __builtin_prefetch(part.next, 0, second_cache);
      if (part.next >= part.end) ++now_;
    }
  }

private:
  static constexpr std::size_t line_bytes = 64, most = 8;
  static constexpr int second_cache = 2;  // the first one is too small for what comes this early

  struct Part {
    const char *next = nullptr, *end = nullptr;
  };

  std::array<Part, most> parts_;
  std::size_t count_ = 0, now_ = 0, lines_ = 0;
};

}  // namespace sazare
