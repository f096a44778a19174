#pragma once

#include <string>
#include <vector>

#include "sazare/parallel/ranks.hpp"

namespace sazare::parallel {

/// What decides the bits of results in how this program was built: version, commit, compiler and the instructions it may use.
std::string build_identity();

/// Which ranks differ from the first one in how their program was built, in words; empty where none does.
std::string different_programs(const std::vector<std::string>& identity_by_rank);

/// Throws UserError in every rank where ranks run programs that were built differently: a link between two ranks is evaluated
/// by both, and must have the same bits. All call it.
void require_same_program(const Ranks& ranks);

}  // namespace sazare::parallel
