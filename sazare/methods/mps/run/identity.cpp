#include "sazare/methods/mps/run/identity.hpp"

#include "sazare/methods/mps/case/format.hpp"

namespace sazare::runs {

RunIdentity identify(const cases::MpsCase& mps, const std::string& filling) {
  cases::MpsCase plain = mps;
  const std::string records = records_hash(plain.motions);
  for (cases::ParticleRegion& region : plain.regions) region.file = region.file.filename();
  plain.output = {};
  return {cases::write_resolved(plain), filling, records, program_text()};
}

}  // namespace sazare::runs
