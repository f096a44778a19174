#include "sazare/methods/rectangles/run/identity.hpp"

#include "sazare/methods/rectangles/case/format.hpp"

namespace sazare::runs {

RunIdentity identify(const cases::RectanglesCase& rectangles, const std::string& assembly) {
  cases::RectanglesCase plain = rectangles;
  const std::string records = records_hash(plain.motions);
  for (cases::SquareBlock& block : plain.blocks) block.file = block.file.filename();
  plain.output = {};
  return {cases::write_resolved(plain), assembly, records, program_text()};
}

}  // namespace sazare::runs
