#include "sazare/methods/fem/run/identity.hpp"

#include "sazare/methods/fem/case/format.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {
namespace {

/// Takes the folders out of the files of materials; what the files hold as a hash, empty where there are none.
std::string curves_hash(std::vector<cases::FemMaterial>& materials) {
  observe::Hash hash;
  bool any = false;
  for (cases::FemMaterial& material : materials) {
    if (material.modulus_reduction.empty()) continue;
    any = true;
    material.modulus_reduction = material.modulus_reduction.filename();
    for (const auto* column : {&material.reduction.strain, &material.reduction.ratio})
      hash.add(std::as_bytes(std::span(*column)));
  }
  return any ? observe::to_hex(hash.value()) : "";
}

}  // namespace

RunIdentity identify(const cases::FemCase& fem, const std::string& mesh) {
  cases::FemCase plain = fem;
  const std::string records = records_hash(plain.motions) + curves_hash(plain.materials);
  plain.mesh.file = plain.mesh.file.filename();
  plain.output = {};
  return {cases::write_resolved(plain), mesh, records, program_text()};
}

}  // namespace sazare::runs
