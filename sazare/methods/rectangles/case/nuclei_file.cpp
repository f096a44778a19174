#include "sazare/methods/rectangles/case/nuclei_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/table_problems.hpp"

namespace sazare::cases {
namespace {

using geometry::Vector2;
constexpr Real least_distance = 1e-6;  // of the side of a square of the mean area

class NucleiReader {
public:
  NucleiReader(SquareBlock& block, int source, const Place& named_at, Problems& problems)
      : block_(block),
        outline_(outline_of(block)),
        lines_(problems.source(source).lines),
        faults_(source, named_at, problems, "file"),
        separator_(lines_.empty() ? ',' : separator_of(lines_[0])) {}

  void run() {
    if (lines_.empty() || !is_header(lines_[0]))
      faults_.report(lines_.empty() ? 0 : 1, lines_.empty() ? Field{} : trimmed(lines_[0], 0, lines_[0].size()),
                     lines_.empty() ? "the file of nuclei is empty" : "wrong header", "the first line is \"x [m],y [m]\"");
    faults_.read_rows(lines_, [&](int line, std::string_view text) { read_row(line, text); });
    if (faults_.any()) return;
    if (block_.places.size() < 2)
      return faults_.report(
          0, {}, fmt::format("{} inside the block, at least 2 are needed", block_.places.empty() ? "no nucleus" : "1 nucleus"),
          "each row is the position of a nucleus, the centre of one Voronoi polygon");
    check_distances();
  }

private:
  bool is_header(std::string_view line) const {
    const auto fields = split(line, separator_);
    return fields.size() == 2 && fields[0].text == "x [m]" && fields[1].text == "y [m]";
  }

  void read_row(int line, std::string_view text) {
    const auto fields = split(text, separator_);
    const Field whole = trimmed(text, 0, text.size());
    if (fields.size() != 2)
      return faults_.report(
          line, whole, fmt::format("two numbers were expected, found {} field{}", fields.size(), fields.size() == 1 ? "" : "s"),
          "a row is x and y with a comma between them");
    std::array<Real, 2> place{};
    bool is_good = true;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!faults_.read_number(line, fields[axis], axis == 0 ? "x" : "y", place[axis])) is_good = false;
    }
    if (!is_good) return;
    if (!geometry::holds(outline_, {place[0], place[1]}, least_distance * std::sqrt(geometry::measure(outline_).area)))
      return faults_.report(line, whole, fmt::format("the nucleus lies outside the block \"{}\"", block_.name),
                            "nuclei are given inside the block as it lies before its rotation");
    block_.places.push_back(place);
    line_of_.push_back(line);
  }

  /// Along x, so that only few are compared.
  void check_distances() {
    const auto& places = block_.places;
    const Real least = least_distance * std::sqrt(geometry::measure(outline_).area / static_cast<Real>(places.size()));
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i][0]; });
    for (std::size_t k = 0; k < order.size(); ++k)
      for (std::size_t next = k + 1; next < order.size() && places[order[next]][0] - places[order[k]][0] < least; ++next) {
        const std::size_t one = std::min(order[k], order[next]), other = std::max(order[k], order[next]);
        if (std::abs(places[one][1] - places[other][1]) >= least) continue;
        const std::string& text = lines_[static_cast<std::size_t>(line_of_[other]) - 1];
        faults_.report(line_of_[other], trimmed(text, 0, text.size()),
                       fmt::format("the nucleus coincides with that of line {}", line_of_[one]),
                       "remove one of them, or move it");
      }
  }

  SquareBlock& block_;
  std::vector<Vector2> outline_;
  std::vector<std::string> lines_;
  TableProblems faults_;
  char separator_;
  std::vector<int> line_of_;
};

}  // namespace

std::vector<Vector2> outline_of(const SquareBlock& block) {
  const Vector2 a = block.lower.head<2>(), b = block.upper.head<2>();
  std::vector<Vector2> outline;
  if (block.shape == BlockShape::polygon)
    for (std::size_t i = 0; i + 1 < block.points.size(); ++i) outline.emplace_back(block.points[i][0], block.points[i][1]);
  else
    outline = {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
  if (geometry::measure(outline).area < 0) std::ranges::reverse(outline);
  return outline;
}

void read_nuclei(SquareBlock& block, const std::string& shown_name, const Place& named_at, Problems& problems) {
  const auto source = add_text_file(block.nuclei, shown_name, "the file of nuclei", named_at, problems);
  if (source) NucleiReader(block, *source, named_at, problems).run();
}

}  // namespace sazare::cases
