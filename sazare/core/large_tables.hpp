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

/// Moves a table of some megabytes to large pages where the system grants them: a processor knows the places of few pages.
template <class T>
void put_on_large_pages(std::vector<T>& table) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = 4096, large_page = 2 << 20;
  if (table.size() * sizeof(T) < 2 * large_page) return;
  std::vector<T> moved;
  moved.reserve(table.size());
  const auto address = reinterpret_cast<std::uintptr_t>(moved.data());
  const std::size_t before = address % page;
  madvise(reinterpret_cast<void*>(address - before), before + table.size() * sizeof(T), MADV_HUGEPAGE);
  moved.assign(table.begin(), table.end());
  table.swap(moved);
#endif
}

}  // namespace sazare
