#pragma once

#include <unistd.h>

#include "sazare/core/vector.hpp"

namespace sazare {

/// Memory of this machine [B].
inline Real machine_memory() { return static_cast<Real>(sysconf(_SC_PHYS_PAGES)) * static_cast<Real>(sysconf(_SC_PAGESIZE)); }

}  // namespace sazare
