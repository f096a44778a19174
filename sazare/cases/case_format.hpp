#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/schema.hpp"

/// What the reader of cases knows of a method. The list of all formats is handed to it: this module knows none by name.
namespace sazare::cases {

struct CheckContext;

/// The tables of a method's cases, and how a case is filled and checked once types and ranges are.
struct CaseFormat {
  std::string_view method;    ///< its name in a case file
  std::string_view sentence;  ///< "blocks (bonded tetrahedra that can break apart)": for the reference
  std::span<const Table> tables;
  /// Fills content and histories of the case from the document, and reports all that is wrong with it.
  void (*read)(const CheckContext& context, CaseFile& file);
  /// The case as TOML with every default written out. Files are relative to `folder`, or full paths where it is empty.
  std::string (*write)(const CaseFile& file, const std::filesystem::path& folder);
  /// Whether the case names two further cases, whose overrides begin with "continuum." and "bodies.".
  bool has_sides = false;
};

using CaseFormats = std::span<const CaseFormat>;

/// Reads and checks a case. `overrides` are texts such as "time.end=1e-3" or "joints.0.cohesion=5e6". Throws
/// a UserError that lists everything that is wrong, in file order. Those of a side of a hybrid case begin with its key:
/// "bodies.time.step=1e-5".
/// `side`, such as "bodies.", is what messages say before overrides of a case that is itself a side.
CaseFile read_case(CaseFormats formats, const std::filesystem::path& path, std::span<const std::string> overrides = {},
                   const std::string& side = "");

/// Reads and checks a text that need not stand in a file: messages call it `path`, and its files are relative to the folder of
/// `path`.
CaseFile read_case_text(CaseFormats formats, const std::string& content, const std::filesystem::path& path,
                        std::span<const std::string> overrides = {}, const std::string& side = "");

/// A JSON schema of the case file, for editors: one for each method.
std::string schema_json(CaseFormats formats);

/// The reference page of the case file.
std::string schema_markdown(CaseFormats formats);

}  // namespace sazare::cases
