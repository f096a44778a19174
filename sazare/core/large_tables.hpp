#pragma once

/// How memory of large tables is handled.

#include <cstdlib>  // says whether the C library is glibc
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
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

}  // namespace sazare
