#pragma once

#include "sazare/cases/case_format.hpp"
#include "sazare/cases/checks.hpp"
#include "sazare/methods/fem/case/case.hpp"

/// Cases of method fem as the reader and the writer of cases know them.
namespace sazare::cases {

/// All tables and keys, in the order of the reference page.
std::span<const Table> fem_schema();

CaseFormat fem_format();

/// All checks of a case after types and ranges; reads the files that it names.
void check_fem(const CheckContext& context, FemCase& fem);

/// Checks of sand that contracts under cycles of shear.
void check_contraction(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemMaterial& material);

/// Checks of ground with a water table.
void check_pore_water(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemMaterial& material);

void check_members(const CheckContext& context, const FemCase& fem);

/// Checks of still water on faces and in joints.
void check_water(const CheckContext& context, const FemCase& fem);

/// Checks of a wave that comes in at an angle.
void check_incident_wave(const CheckContext& context, const FemCase& fem);

/// The case as TOML with every key and default written out and its unit beside it; reading it gives the same case. Files are
/// written relative to `folder`, where the text will be saved, or as full paths when it is empty.
std::string write_resolved(const FemCase& fem, const std::filesystem::path& folder = {});

/// The case in words, with what follows from its numbers: what `sazare check` prints.
std::string explain(const FemCase& fem);

}  // namespace sazare::cases
