#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "sazare/cases/case_file.hpp"

/// A checked case of method hybrid, as plain data. All values in SI units; every member is one key of the case file, but for the
/// two cases that it names.
namespace sazare::cases {

enum class HybridScheme { automatic, lagged, impulse, iterative };

struct HybridSides {
  std::filesystem::path continuum;  // of finite elements
  std::filesystem::path bodies;     // of method spheres, rectangles, blocks or mps
};

struct HybridSurface {
  std::string group;     // of the continuum's mesh
  std::string material;  // of the bodies' case, of method spheres
  Real width = 0;        // m, of the slab of spheres or blocks on a continuum in the plane
  std::optional<Real> friction_coefficient;  // with ground of method mps
};

struct HybridCoupling {
  HybridScheme scheme = HybridScheme::automatic;
  Real tolerance = 0;
  int passes = 0;
};

struct HybridCase {
  std::string title;
  HybridSides sides;
  HybridSurface surface;
  HybridCoupling coupling;
  Output output;
  std::shared_ptr<const CaseFile> continuum, bodies;  // as read and checked
};

}  // namespace sazare::cases
