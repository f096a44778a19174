#pragma once

/// Memory that will be needed soon, asked for line by line while other work is done. A core reads what it asks for one after the
/// other from memory much faster than what it comes upon, and computes meanwhile.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare {

inline constexpr std::size_t line_bytes = 64;

/// Whether what comes next of a table is worth asking for: of a smaller one most is in the cache of a core, and asking costs more
/// than it saves.
template <class T>
bool is_large(const std::vector<T>& table) {
  return table.size() * sizeof(T) > std::size_t{1} << 20;
}

/// Asks for a line to come into the second cache: the first one is too small for what comes early. The empty statement is there
/// because GCC leaves out calls of a function that does nothing but ask.
inline void ask_early(const char* line) {
  __builtin_prefetch(line, 0, 2);
  __asm__ volatile("");
}

/// Asks for one record, or for what its first bytes lie on.
template <class T>
void ask_for(const T& record, std::size_t bytes = sizeof(T)) {
  for (std::size_t byte = 0; byte < bytes; byte += line_bytes) ask_early(reinterpret_cast<const char*>(&record) + byte);
}

/// Whether the processor by itself reads ahead what stands in a row, far enough and to where it stays. Those with a second cache
/// of 2 MiB were measured to, and to wait where they are asked for it besides; those with up to 1 MiB gain from being asked.
inline bool reads_rows_ahead() {
  static const bool reads = sysconf(_SC_LEVEL2_CACHE_SIZE) >= 2L << 20;
  return reads;
}

class ComingLines {
public:
  /// A part of a table; what is added beyond `most` parts is left out.
  template <class T>
  void add(std::span<const T> part) {
    add({reinterpret_cast<const char*>(part.data()), line_bytes, nullptr, (part.size_bytes() + line_bytes - 1) / line_bytes});
  }

  /// Adds a row, unless the processor prefetches rows by itself.
  template <class T>
  void add_row(std::span<const T> part) {
    if (!reads_rows_ahead()) add(part);
  }

  /// Single records of a table, each within one line.
  template <class T>
  void add(std::span<const T> table, std::span<const Index> places) {
    static_assert(line_bytes % sizeof(T) == 0 && alignof(T) == sizeof(T));
    add({reinterpret_cast<const char*>(table.data()), sizeof(T), places.data(), places.size()});
  }

  /// Lines of the cache in all parts.
  std::size_t lines() const { return lines_; }

  /// Number of lines that have not been asked for yet.
  std::size_t left() const {
    std::size_t left = 0;
    for (std::size_t n = now_; n < count_; ++n) left += parts_[n].lines;
    return left;
  }

  /// Asks for the next lines, so many at most.
  void fetch(std::size_t lines) {
    while (lines > 0 && now_ < count_) {
      Part& part = parts_[now_];
      const std::size_t some = std::min(lines, part.lines);
      if (part.places == nullptr)
        for (std::size_t n = 0; n < some; ++n, part.table += part.stride) ask_early(part.table);
      else
        for (std::size_t n = 0; n < some; ++n) ask_early(part.table + part.stride * static_cast<std::size_t>(*part.places++));
      lines -= some;
      part.lines -= some;
      if (part.lines == 0) ++now_;
    }
  }

private:
  static constexpr std::size_t most = 12;

  struct Part {
    const char* table = nullptr;
    std::size_t stride = 0;
    const Index* places = nullptr;  // of single records
    std::size_t lines = 0;          // that are left
  };

  void add(const Part& part) {
    if (part.lines == 0 || count_ == most) return;
    parts_[count_++] = part;
    lines_ += part.lines;
  }

  std::array<Part, most> parts_;
  std::size_t count_ = 0, now_ = 0, lines_ = 0;
};

}  // namespace sazare
