#pragma once

/// How much memory a benchmark takes, as the system counts it.

#include <fstream>
#include <string>

#include "sazare/core/time.hpp"

namespace sazare::benchmarks {

/// A line of /proc/self/status, such as "VmRSS:" (resident now) or "VmHWM:" (at the most), in bytes; 0 where there is none. That
/// is this program alone: getrusage counts what the program that started it held as well.
inline Real memory_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return 1024 * std::stod(line.substr(name.size()));
  return 0;
}

inline Real resident_bytes() { return memory_bytes("VmRSS:"); }
inline Real largest_resident_bytes() { return memory_bytes("VmHWM:"); }

}  // namespace sazare::benchmarks
