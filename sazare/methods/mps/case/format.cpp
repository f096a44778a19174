#include "sazare/methods/mps/case/format.hpp"

#include <utility>

#include "sazare/cases/case_reader.hpp"
#include "sazare/cases/case_writer.hpp"
#include "sazare/methods/mps/case/fields.hpp"

namespace sazare::cases {
namespace {

void read(const CheckContext& context, CaseFile& file) {
  MpsCase mps = CaseReader(context).read<MpsCase>();
  check_mps(context, mps);
  resolve_clocks(context, mps.time);
  if (mps.time.strict) context.problems.turn_warnings_into_errors();
  file.histories = outside_motions(mps.motions);
  file.content = std::move(mps);
}

std::string write(const CaseFile& file, const std::filesystem::path& folder) {
  return write_resolved(file.as<MpsCase>(), folder);
}

}  // namespace

std::string write_resolved(const MpsCase& mps, const std::filesystem::path& folder) {
  return CaseWriter(mps_schema(), folder).write(mps, "mps");
}

CaseFormat mps_format() {
  return {.method = "mps",
          .sentence = "mps (moving particles, for ground in earthquakes)",
          .tables = mps_schema(),
          .read = read,
          .write = write};
}

}  // namespace sazare::cases
