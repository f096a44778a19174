#include "sazare/methods/mps/run/identity.hpp"

#include <span>

#include "sazare/methods/mps/case/format.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

RunIdentity identify(const cases::MpsCase& mps, const std::string& filling) {
  cases::MpsCase plain = mps;
  const std::string records = records_hash(plain.motions) + curves_hash(plain.materials);
  for (cases::ParticleRegion& region : plain.regions) region.file = region.file.filename();
  plain.output = {};
  return {cases::write_resolved(plain), filling, records, program_text()};
}

template <int D>
std::string filling_hash(const Filling<D>& filling) {
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(filling.sites)));
  hash.add(std::as_bytes(std::span(filling.region)));
  return observe::to_hex(hash.value());
}

template std::string filling_hash<2>(const Filling<2>&);
template std::string filling_hash<3>(const Filling<3>&);

}  // namespace sazare::runs
