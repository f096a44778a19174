#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sazare/cases/blocks_case.hpp"
#include "sazare/cases/fem_case.hpp"
#include "sazare/cases/hybrid_case.hpp"
#include "sazare/cases/rectangles_case.hpp"
#include "sazare/cases/spheres_case.hpp"

namespace sazare::cases {

struct CaseText;

/// A case of any method.
using MethodCase = std::variant<BlocksCase, MpsCase, RectanglesCase, SpheresCase, FemCase, HybridCase>;

/// A case that was read and checked, with its text for messages about what only the mesh can show.
struct CaseFile {
  std::filesystem::path path;
  MethodCase content;
  std::string warnings;  // ready to print; empty when there are none
  std::shared_ptr<const CaseText> text;

  const BlocksCase& blocks() const { return std::get<BlocksCase>(content); }
  const MpsCase& mps() const { return std::get<MpsCase>(content); }
  const RectanglesCase& rectangles() const { return std::get<RectanglesCase>(content); }
  const SpheresCase& spheres() const { return std::get<SpheresCase>(content); }
  const FemCase& fem() const { return std::get<FemCase>(content); }
  const HybridCase& hybrid() const { return std::get<HybridCase>(content); }
};

/// Reads and checks a case. `overrides` are texts such as "time.end=1e-3" or "joints.0.cohesion=5e6". Throws
/// a UserError that lists everything that is wrong, in file order. Those of a side of a hybrid case begin with its key:
/// "bodies.time.step=1e-5".
/// `side`, such as "bodies.", is what messages say before overrides of a case that is itself a side.
CaseFile read_case(const std::filesystem::path& path, std::span<const std::string> overrides = {}, const std::string& side = "");

/// The same of a text that need not stand in a file: messages call it `path`, and its files are relative to the folder of `path`.
CaseFile read_case_text(const std::string& content, const std::filesystem::path& path,
                        std::span<const std::string> overrides = {}, const std::string& side = "");

/// A physical surface group of a mesh: its triangles on the outside of the body and those between two
/// elements.
struct MeshSurface {
  std::string name;
  long outer_faces = 0;
  long inner_faces = 0;
  std::vector<std::string> regions = {};  ///< of the elements behind its outer faces
};

/// What a case may refer to in its mesh.
struct MeshGroups {
  std::vector<std::string> regions;
  std::vector<MeshSurface> surfaces;
};

/// Checks every region and surface that the case names against the mesh, and that each region has exactly one
/// material. Throws a UserError like `read_case`.
void check_against_mesh(const CaseFile& file, const MeshGroups& groups);

/// Throws a UserError that points at a key of the case, for what only the engine finds out. `key` is written
/// as for overrides: "gauges.2.point", or "time" for the table; the nearest place that exists is shown.
[[noreturn]] void refuse(const CaseFile& file, const std::string& key, std::string what, std::string help);

/// The text of a warning at the same place; with `time.strict` use `refuse` instead.
std::string warning(const CaseFile& file, const std::string& key, std::string what, std::string help);

}  // namespace sazare::cases
