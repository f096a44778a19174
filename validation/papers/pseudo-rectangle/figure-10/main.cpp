#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/rectangles/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"
#include "validation/papers/pseudo-rectangle/figure-10/lattice.hpp"

namespace {

using namespace sazare;
constexpr Real height = 0.04, thickness = 0.04, nominal_span = 0.1, strength = 5.6e6, platen_speed = 0.005;
constexpr Real beam_theory = 2 * strength * thickness * height * height / (3 * nominal_span);  // [N]

struct Test {
  int rows = 2;
  int springs = 1;
  bool ends = false;
  bool slender = false;  ///< 16 heights long, supports under its ends, platens 6 heights away from them

  Real length() const { return (slender ? 16 : 4) * height; }
};

/// Supports stand below the middles of the elements nearest to the nominal span; two platens above the middles of the inner
/// elements, as a circle presses that touches two circles. The slender beam has a stretch of one moment between its platens.
struct Span {
  Real support = 0;  ///< from the middle of the beam [m]
  Real platen = 0;
};

Span span_of(const Test& test) {
  const Real size = height / test.rows;
  if (test.slender) return {0.5 * (test.length() - size), 0.5 * (test.length() - size) - 6 * height};
  const Real outer = (std::floor(0.5 * nominal_span / size) + 0.5) * size, inner = outer - size;
  const bool inner_is_nearer = inner > 0 && 0.5 * nominal_span - inner < outer - 0.5 * nominal_span - 1e-9;
  return {inner_is_nearer ? inner : outer, 0.5 * size};
}

/// Time in which the beam surely breaks [s].
Real longest(const Test& test) { return test.slender ? 1 : 0.06; }

std::vector<std::string> settings(const Test& test) {
  const Span span = span_of(test);
  const Real middle = 0.5 * test.length();
  std::vector<std::string> list = {fmt::format("blocks.0.element_size={:.17g}", height / test.rows),
                                   fmt::format("blocks.0.upper=[{},{},0.0]", test.length(), height),
                                   fmt::format("materials.0.springs={}", test.springs),
                                   fmt::format("rollers.0.center=[{:.12f},-0.005,0.0]", middle - span.support),
                                   fmt::format("rollers.1.center=[{:.12f},-0.005,0.0]", middle + span.support),
                                   fmt::format("rollers.2.center=[{:.12f},0.045,0.0]", middle - span.platen),
                                   fmt::format("rollers.2.velocity=[0.0,{},0.0]", -platen_speed),
                                   "gauges=[]",
                                   fmt::format("time.end={}", longest(test)),
                                   "contact.friction_angle=0"};
  if (test.ends) list.emplace_back("materials.0.layout=\"ends\"");
  return list;
}

struct Result {
  Real largest = 0;        ///< load over beam theory
  bool at_middle = false;  ///< the first spring broke at the bottom face between the platens
};

Result bend(const Test& test) {
  cases::CaseFile file = registry::read_case("cases/mortar-beam/case.toml", settings(test));
  auto beam = file.as<cases::RectanglesCase>();
  cases::Roller second = beam.rollers[2];  // the other platen
  second.name = "other platen";
  second.center.x() = test.length() - second.center.x();
  beam.rollers.push_back(second);
  file.content = beam;
  const runs::RectanglesModel model = runs::build_rectangles(file);
  const auto& links = model.forces->links();
  model.stepper->start();
  Result result;
  Real largest = 0, load = 0;
  bool broken = false;
  while (model.stepper->time() < longest(test) && !(broken && load < 0.5 * largest)) {
    model.stepper->advance();
    load = model.forces->support_force(2)[1] + model.forces->support_force(3)[1];
    largest = std::max(largest, load);
    if (broken || links.broken_springs() == 0) continue;
    broken = true;
    if (test.slender) break;  // breaking, it springs up and knocks on the platens
    for (Index number = 0; number < links.count(); ++number) {
      if (!links.has_broken(number)) continue;
      const auto& start = model.stepper->particles().start;
      const auto first = static_cast<std::size_t>(links.link(number).first),
                 second_place = static_cast<std::size_t>(links.link(number).second);
      const Real x = 0.5 * (start[0][first] + start[0][second_place]);
      result.at_middle = std::abs(x - 0.5 * test.length()) < height / test.rows && start[1][first] < height / test.rows;
    }
  }
  result.largest = largest / beam_theory;
  return result;
}

/// The linear statics of the same lattice, over beam theory.
Real statics(const Test& test) {
  const Span span = span_of(test);
  const Real size = height / test.rows;
  const auto column = [&](Real from_middle) {
    return static_cast<int>(std::lround((0.5 * test.length() - from_middle) / size - 0.5));
  };
  const validation::LatticeBeam beam{test.rows,
                                     static_cast<int>(std::lround(test.length() / size)),
                                     test.springs,
                                     test.ends,
                                     size,
                                     thickness,
                                     4.3e9,
                                     1.72e9,
                                     column(span.support),
                                     column(span.platen)};
  return validation::load_at_first_break(beam, strength) / beam_theory;
}

/// (1 + 1/n) of n equal springs over the height, over the span that counts: where the stress is linear over the height.
Real theory(const Test& test) {
  const Span span = span_of(test);
  return (1 + 1.0 / (test.rows * test.springs)) * nominal_span / (2 * (span.support - span.platen));
}

}  // namespace

int main() {
  parallel::set_threads(1);
  int at_middle = 0, tests = 0;
  for (const int rows : {2, 3, 4, 5, 6, 8, 10}) {
    std::vector<Test> list;
    for (const int springs : {1, 2, 3, 5, 10}) list.push_back({rows, springs});
    list.push_back({rows, 2, true});
    for (const Test& test : list) {
      const Result result = bend(test);
      at_middle += result.at_middle ? 1 : 0;
      ++tests;
      const int elements = 4 * rows * rows;
      validation::print_row(fmt::format("{}-{}", elements, test.ends ? "ends" : std::to_string(test.springs)).c_str(),
                            result.largest, statics(test));
      if (test.springs == 1) validation::print_row(fmt::format("{}-1-theory", elements).c_str(), result.largest, theory(test));
    }
  }
  for (const auto& [name, springs] : {std::pair{"1", 1}, {"2", 2}, {"3", 3}, {"5", 5}, {"10", 10}, {"ends", 2}}) {
    const Test test{4, springs, std::string_view(name) == "ends", true};
    validation::print_row(fmt::format("slender-{}", name).c_str(), bend(test).largest, theory(test));
  }
  validation::print_row("crack", static_cast<Real>(at_middle) / tests);
}
