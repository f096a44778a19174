#pragma once

/// What a checkpoint belongs to: only the same case, on the same mesh, in the same program gives the same bits.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sazare/cases/soil/backbone.hpp"
#include "sazare/cases/tables.hpp"
#include "sazare/observe/checkpoint.hpp"

namespace sazare::runs {

struct RunIdentity {
  std::string case_text;  ///< resolved, without what does not change the results
  std::string mesh;       ///< hash of nodes, elements and groups
  std::string tables;     ///< hash of the pressure tables
  std::string program;    ///< version, commit, compiler and the sizes of the records
};

/// Hash of all records, whose folders may change between the parts of a run: of their files only the names stay.
std::string records_hash(std::vector<cases::Motion>& motions);

/// The same of the tables of soils; empty where there are none.
std::string curves_hash(std::span<cases::SoilBackbone* const> soils);

template <class Material>
std::string curves_hash(std::vector<Material>& materials) {
  std::vector<cases::SoilBackbone*> soils;
  for (Material& material : materials) soils.push_back(&material);
  return curves_hash(std::span<cases::SoilBackbone* const>(soils));
}

/// What the program says of itself.
std::string program_text();

void write_identity(observe::CheckpointWriter& out, const RunIdentity& identity);

/// Throws UserError saying what has changed when the checkpoint belongs to another run.
void check_identity(const observe::CheckpointReader& in, const std::filesystem::path& folder, const RunIdentity& identity);

}  // namespace sazare::runs
