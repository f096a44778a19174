#pragma once

/// How memory of large tables is handled.

#include <cstdint>
#include <cstdlib>  // says whether the C library is glibc
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

/// Moves a table that is there already.
template <class T>
void put_on_large_pages(std::vector<T>& table) {
  if (!fills_large_pages<T>(table.size())) return;
  std::vector<T> moved;
  reserve_on_large_pages(moved, table.size());
  moved.assign(table.begin(), table.end());
  table.swap(moved);
}

}  // namespace sazare
