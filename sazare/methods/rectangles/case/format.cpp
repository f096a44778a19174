#include "sazare/methods/rectangles/case/format.hpp"

#include <utility>

#include "sazare/cases/case_reader.hpp"
#include "sazare/cases/case_writer.hpp"
#include "sazare/methods/rectangles/case/fields.hpp"

namespace sazare::cases {
namespace {

void read(const CheckContext& context, CaseFile& file) {
  RectanglesCase rectangles = CaseReader(context).read<RectanglesCase>();
  check_rectangles(context, rectangles);
  resolve_clocks(context, rectangles.time);
  if (rectangles.time.strict) context.problems.turn_warnings_into_errors();
  file.histories = outside_motions(rectangles.motions);
  file.content = std::move(rectangles);
}

std::string write(const CaseFile& file, const std::filesystem::path& folder) {
  return write_resolved(file.as<RectanglesCase>(), folder);
}

}  // namespace

std::string write_resolved(const RectanglesCase& rectangles, const std::filesystem::path& folder) {
  return CaseWriter(rectangles_schema(), folder).write(rectangles, "rectangles");
}

CaseFormat rectangles_format() {
  return {.method = "rectangles",
          .sentence = "rectangles (blocks and beams of squares or polygons in the plane)",
          .tables = rectangles_schema(),
          .read = read,
          .write = write};
}

}  // namespace sazare::cases
