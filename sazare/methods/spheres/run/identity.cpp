#include "sazare/methods/spheres/run/identity.hpp"

#include "sazare/methods/spheres/case/format.hpp"

namespace sazare::runs {

RunIdentity identify(const cases::SpheresCase& spheres, const std::string& start) {
  cases::SpheresCase plain = spheres;
  const std::string records = records_hash(plain.motions);
  for (cases::SphereGroup& group : plain.spheres) {
    group.file = group.file.filename();
    group.bodies_file = group.bodies_file.filename();
  }
  for (cases::WallRules& wall : plain.walls) wall.file = wall.file.filename();
  plain.output = {};
  return {cases::write_resolved(plain), start, records, program_text()};
}

}  // namespace sazare::runs
