#pragma once

/// The tables of soils as part of what a checkpoint belongs to, see run_identity.hpp.

#include <span>
#include <string>
#include <vector>

#include "sazare/cases/soil/backbone.hpp"

namespace sazare::runs {

/// Hash of the tables of soils, whose folders may change between the parts of a run: of their files only the names stay. Empty
/// where there are none.
std::string curves_hash(std::span<cases::SoilBackbone* const> soils);

template <class Material>
std::string curves_hash(std::vector<Material>& materials) {
  std::vector<cases::SoilBackbone*> soils;
  for (Material& material : materials) soils.push_back(&material);
  return curves_hash(std::span<cases::SoilBackbone* const>(soils));
}

}  // namespace sazare::runs
