#pragma once

/// What a validation program prints: one line per row, `row,ours` or, where the expected value is computed by other means
/// than the engine's, `row,ours,expected`. validation/run.py puts it beside expected.csv.

#include <cstdio>

#include "sazare/core/vector.hpp"

namespace sazare::validation {

inline void print_row(const char* row, Real ours) { std::printf("%s,%.10g\n", row, ours); }
inline void print_row(const char* row, Real ours, Real expected) { std::printf("%s,%.10g,%.10g\n", row, ours, expected); }

}  // namespace sazare::validation
