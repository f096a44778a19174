#pragma once

/// How memory of large tables is handled.

#include <algorithm>
#include <cstdint>
#include <cstdlib>  // says whether the C library is glibc
#include <span>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sazare {

/// Tables of a megabyte or more are given back to the system as soon as they are freed. The C library otherwise keeps what is
/// freed for what may come: searches for pairs would leave holes as large as the spheres themselves.
inline void give_back_large_tables() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 20);
#endif
}

/// Frees a table; one that is assigned {} keeps its memory.
template <class T>
void release(std::vector<T>& table) {
  std::vector<T>().swap(table);
}

/// Gives the memory of a table back but keeps its room: its records are no longer known, and what is written to it from now on
/// takes memory again, page by page. So a table may have room for all records where a process knows some.
template <class T>
void forget([[maybe_unused]] std::vector<T>& table) {
#ifdef __linux__
  constexpr std::uintptr_t page = 4096;
  const auto begin = reinterpret_cast<std::uintptr_t>(table.data()), end = begin + table.size() * sizeof(T);
  const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
  if (first >= last) return;
  madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
  madvise(reinterpret_cast<void*>(first), last - first, MADV_NOHUGEPAGE);  // a large page takes its memory for a single record
#endif
}

inline constexpr std::size_t large_page = 2 << 20;

/// Whether a table of so many is sure to have a large page of its own.
template <class T>
constexpr bool fills_large_pages(std::size_t count) {
  return count * sizeof(T) >= 2 * large_page;
}

/// Room for a table that is empty as yet, from some megabytes on on large pages where the system grants them: a processor knows
/// the places of few pages.
template <class T>
void reserve_on_large_pages(std::vector<T>& table, std::size_t count) {
  table.reserve(count);
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = 4096;
  if (!fills_large_pages<T>(count)) return;
  const auto address = reinterpret_cast<std::uintptr_t>(table.data());
  const std::size_t before = address % page;
  madvise(reinterpret_cast<void*>(address - before), before + count * sizeof(T), MADV_HUGEPAGE);
#endif
}

/// Large pages for tables that are there already: those of which such tables use five eighths or more, since what is on a page
/// takes memory whether somebody uses it or not. What comes to stand beside them lies on the same pages.
class LargePages {
public:
  template <class T>
  void add(const std::vector<T>& table) {
    add(std::span(table));
  }
  /// A part of one.
  template <class T>
  void add(std::span<const T> table) {
    const auto begin = reinterpret_cast<std::uintptr_t>(table.data()), end = begin + table.size() * sizeof(T);
    for (std::uintptr_t from = begin; from < end;) {
      const std::uintptr_t page = from / large_page, to = std::min(end, (page + 1) * large_page);
      parts_.emplace_back(page, to - from);
      from = to;
    }
  }

  /// Moves what is on them, where the system grants them.
  void ask() {
    std::ranges::sort(parts_);
    for (auto part = parts_.begin(); part != parts_.end();) {
      const std::uintptr_t page = part->first;
      std::size_t used = 0;
      for (; part != parts_.end() && part->first == page; ++part) used += part->second;
      if (used >= large_page / 8 * 5) ask(page);
    }
    parts_.clear();
  }

private:
  static void ask([[maybe_unused]] std::uintptr_t page) {
#ifdef MADV_HUGEPAGE
    constexpr int collapse = 25;  // MADV_COLLAPSE since Linux 6.1, which an older C library does not name
    const auto address = reinterpret_cast<void*>(page * large_page);
    if (madvise(address, large_page, MADV_HUGEPAGE) == 0) madvise(address, large_page, collapse);
#endif
  }

  std::vector<std::pair<std::uintptr_t, std::size_t>> parts_;  ///< the number of a page, and how much of it a table uses [B]
};

}  // namespace sazare
