#pragma once

#include <cstddef>
#include <vector>

#include "sazare/parallel/ranks.hpp"

namespace sazare::parallel {

/// Gives each rank the bytes meant for it, by rank. Returns what each has given to this one; what a rank gives to itself comes
/// back. All call it.
std::vector<std::vector<std::byte>> give(const Ranks& ranks, std::vector<std::vector<std::byte>> to_each, Topic topic);

}  // namespace sazare::parallel
