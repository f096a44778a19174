#pragma once

#include <filesystem>
#include <string>

#include "sazare/cases/fem_case.hpp"
#include "sazare/cases/hybrid_case.hpp"
#include "sazare/cases/rectangles_case.hpp"
#include "sazare/cases/spheres_case.hpp"

namespace sazare::cases {

/// The case as TOML with every key and default written out and its unit beside it; reading it gives the same
/// case. Files are written relative to `folder`, where the text will be saved, or as full paths when it is
/// empty.
std::string write_resolved(const BlocksCase& blocks, const std::filesystem::path& folder = {});
std::string write_resolved(const MpsCase& mps, const std::filesystem::path& folder = {});
std::string write_resolved(const RectanglesCase& rectangles, const std::filesystem::path& folder = {});
std::string write_resolved(const SpheresCase& spheres, const std::filesystem::path& folder = {});
std::string write_resolved(const FemCase& fem, const std::filesystem::path& folder = {});
std::string write_resolved(const HybridCase& hybrid, const std::filesystem::path& folder = {});

/// The case in words, with what follows from its numbers: what `sazare check` prints.
std::string explain(const BlocksCase& blocks);
std::string explain(const MpsCase& mps);
std::string explain(const RectanglesCase& rectangles);
std::string explain(const SpheresCase& spheres);
std::string explain(const FemCase& fem);
/// Without its two sides.
std::string explain(const HybridCase& hybrid);

}  // namespace sazare::cases
