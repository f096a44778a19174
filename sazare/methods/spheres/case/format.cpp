#include "sazare/methods/spheres/case/format.hpp"

#include <utility>

#include "sazare/cases/case_reader.hpp"
#include "sazare/cases/case_writer.hpp"
#include "sazare/methods/spheres/case/fields.hpp"

namespace sazare::cases {
namespace {

void read(const CheckContext& context, CaseFile& file) {
  SpheresCase spheres = CaseReader(context).read<SpheresCase>();
  check_spheres(context, spheres);
  resolve_clocks(context, spheres.time);
  if (spheres.time.strict) context.problems.turn_warnings_into_errors();
  file.histories = outside_motions(spheres.motions);
  file.content = std::move(spheres);
}

std::string write(const CaseFile& file, const std::filesystem::path& folder) {
  return write_resolved(file.as<SpheresCase>(), folder);
}

}  // namespace

std::string write_resolved(const SpheresCase& spheres, const std::filesystem::path& folder) {
  return CaseWriter(spheres_schema(), folder).write(spheres, "spheres");
}

CaseFormat spheres_format() {
  return {.method = "spheres",
          .sentence = "spheres (grains that touch or are bonded)",
          .tables = spheres_schema(),
          .read = read,
          .write = write};
}

}  // namespace sazare::cases
