#pragma once

#include "sazare/cases/case_format.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/methods/hybrid/case/case.hpp"

/// Cases of method hybrid as the reader and the writer of cases know them.
namespace sazare::cases {

/// All tables and keys, in the order of the reference page.
std::span<const Table> hybrid_schema();

CaseFormat hybrid_format();

/// All checks of a case after types and ranges; reads the cases of its two sides with their overrides.
void check_hybrid(const CheckContext& context, HybridCase& hybrid);

/// The case as TOML with every key and default written out and its unit beside it; reading it gives the same case. Files are
/// written relative to `folder`, where the text will be saved, or as full paths when it is empty.
std::string write_resolved(const HybridCase& hybrid, const std::filesystem::path& folder = {});

/// The case in words, with what follows from its numbers: what `sazare check` prints. Without its two sides.
std::string explain(const HybridCase& hybrid);

}  // namespace sazare::cases
