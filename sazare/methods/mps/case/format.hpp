#pragma once

#include "sazare/cases/case_format.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/methods/mps/case/case.hpp"

/// Cases of method mps as the reader and the writer of cases know them.
namespace sazare::cases {

/// All tables and keys, in the order of the reference page.
std::span<const Table> mps_schema();

CaseFormat mps_format();

/// All checks of a case after types and ranges; reads the files that it names.
void check_mps(const CheckContext& context, MpsCase& mps);

/// The case as TOML with every key and default written out and its unit beside it; reading it gives the same case. Files are
/// written relative to `folder`, where the text will be saved, or as full paths when it is empty.
std::string write_resolved(const MpsCase& mps, const std::filesystem::path& folder = {});

/// The case in words, with what follows from its numbers: what `sazare check` prints.
std::string explain(const MpsCase& mps);

}  // namespace sazare::cases
