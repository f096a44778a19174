#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "sazare/methods/fem/case/format.hpp"
#include "sazare/methods/fem/run/identity.hpp"
#include "sazare/methods/fem/run/motion_rows.hpp"
#include "sazare/methods/fem/run/record.hpp"
#include "sazare/methods/fem/run/run.hpp"
#include "sazare/methods/hybrid/case/continuum.hpp"

/// The runs of finite elements that a hybrid run couples: its parts know them by these names.
namespace sazare::runs {

template <int D>
using ContinuumModel = FemModel<D>;
template <int D>
using ContinuumRecord = FemRecord<D>;

/// Elements that keep a thread busy, as in a run of the continuum alone.
inline constexpr int continuum_elements_per_thread = fem_elements_per_thread;

template <int D>
ContinuumModel<D> build_continuum(const cases::CaseFile& file, geometry::ElementMesh mesh) {
  return build_fem<D>(file, std::move(mesh));
}

inline geometry::ElementMesh load_continuum_mesh(const cases::CaseFile& file, const std::filesystem::path& made, bool keep) {
  return load_fem_mesh(file, made, keep);
}

inline std::string check_continuum(const cases::CaseFile& file) { return check_fem(file); }

}  // namespace sazare::runs
