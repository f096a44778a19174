#include "sazare/methods/fem/run/identity.hpp"

#include "sazare/methods/fem/case/format.hpp"

namespace sazare::runs {

RunIdentity identify(const cases::FemCase& fem, const std::string& mesh) {
  cases::FemCase plain = fem;
  const std::string records = records_hash(plain.motions) + curves_hash(plain.materials);
  plain.mesh.file = plain.mesh.file.filename();
  plain.output = {};
  return {cases::write_resolved(plain), mesh, records, program_text()};
}

}  // namespace sazare::runs
