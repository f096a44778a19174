#include "sazare/methods/blocks/run/identity.hpp"

#include <span>
#include <vector>

#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

template <class T>
std::span<const std::byte> bytes_of(const T& records) {
  return std::as_bytes(std::span(records.data(), records.size()));
}

/// Folders, and how often to write a checkpoint, may change between the parts of a run.
std::string text_of(cases::BlocksCase blocks) {
  blocks.mesh.file = blocks.mesh.file.filename();
  for (cases::Blast& blast : blocks.blasts)
    if (auto* table = std::get_if<cases::PressureTable>(&blast.pressure)) table->file = table->file.filename();
  blocks.water.wave_file = blocks.water.wave_file.filename();
  blocks.output = {};
  return cases::write_resolved(blocks);
}

std::string mesh_hash(const geometry::TetraMesh& mesh) {
  observe::Hash hash;
  hash.add(bytes_of(mesh.nodes));
  hash.add(bytes_of(mesh.tetrahedra));
  hash.add(bytes_of(mesh.region));
  for (const std::string& name : mesh.region_names) hash.add(bytes_of(name));
  for (const auto& surface : mesh.surfaces) {
    hash.add(bytes_of(surface.name));
    hash.add(bytes_of(surface.triangles));
  }
  return observe::to_hex(hash.value());
}

std::string tables_hash(const cases::BlocksCase& blocks) {
  observe::Hash hash;
  for (const cases::Blast& blast : blocks.blasts)
    if (const auto* table = std::get_if<cases::PressureTable>(&blast.pressure)) {
      hash.add(bytes_of(table->time));
      hash.add(bytes_of(table->pressure));
    }
  if (const auto& waves = blocks.water.record)
    for (const auto* column : {&waves->time, &waves->elevation, &waves->velocity}) hash.add(bytes_of(*column));
  return observe::to_hex(hash.value());
}

}  // namespace

RunIdentity identify(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh) {
  std::vector<cases::Motion> motions = blocks.motions;
  const std::string records = records_hash(motions);  // and takes the folders out of their files
  cases::BlocksCase plain = blocks;
  plain.motions = std::move(motions);
  return {text_of(plain), mesh_hash(mesh), tables_hash(blocks) + records, program_text()};
}

}  // namespace sazare::runs
