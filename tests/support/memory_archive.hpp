#pragma once

#include "sazare/core/memory_archive.hpp"

namespace sazare::test {

using sazare::MemoryArchive;

}  // namespace sazare::test
