#include "sazare/methods/fem/case/format.hpp"

#include <utility>

#include "sazare/cases/case_reader.hpp"
#include "sazare/cases/case_writer.hpp"
#include "sazare/methods/fem/case/fields.hpp"

namespace sazare::cases {
namespace {

void read(const CheckContext& context, CaseFile& file) {
  FemCase fem = CaseReader(context).read<FemCase>();
  check_fem(context, fem);
  resolve_clocks(context, fem.time);
  if (fem.time.strict) context.problems.turn_warnings_into_errors();
  file.histories = outside_motions(fem.motions);
  file.content = std::move(fem);
}

std::string write(const CaseFile& file, const std::filesystem::path& folder) {
  return write_resolved(file.as<FemCase>(), folder);
}

}  // namespace

std::string write_resolved(const FemCase& fem, const std::filesystem::path& folder) {
  return CaseWriter(fem_schema(), folder).write(fem, "fem");
}

CaseFormat fem_format() {
  return {.method = "fem",
          .sentence = "fem (finite elements)",
          .tables = fem_schema(),
          .read = read,
          .write = write};
}

}  // namespace sazare::cases
