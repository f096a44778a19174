#include "support.hpp"

#include <sys/resource.h>

#include <csignal>

/// HDF5 1.10 loses some memory of its own when it refuses a damaged file; asked for by the leak detector, where there is one.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }

namespace sazare::observe::test {

SmallDisk::SmallDisk(std::size_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  former_limit_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &limit);
  former_handler_ = std::signal(SIGXFSZ, SIG_IGN);
}

SmallDisk::~SmallDisk() {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = former_limit_;
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, former_handler_);
}

}  // namespace sazare::observe::test
