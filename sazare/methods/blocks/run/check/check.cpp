#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/blocks/run/block_fragments.hpp"
#include "sazare/methods/blocks/run/check/process_zone.hpp"
#include "sazare/methods/blocks/run/check/second_look.hpp"
#include "sazare/methods/blocks/run/check/stability.hpp"
#include "sazare/methods/blocks/run/check/waves.hpp"
#include "sazare/methods/blocks/run/gauges.hpp"
#include "sazare/methods/blocks/run/mesh_source.hpp"
#include "sazare/methods/blocks/run/run.hpp"
#include "sazare/runs/cost.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t limiting_shown = 10;
constexpr int longest_bar = 40;

using cases::line, cases::number;

std::string body_text(const BlocksModel& model) {
  const auto elements = model.simulation->bodies().size();
  return line("body",
              fmt::format("{}, {}, {} m3, initially {}", cases::counted(elements, "elements"),
                          cases::counted(std::ssize(model.joints->links()), "joints"), number(geometry::volume(model.mesh)),
                          find_fragments(elements, *model.joints).count == 1
                              ? "one piece"
                              : fmt::format("{} pieces", find_fragments(elements, *model.joints).count)));
}

std::string level_text(const BlocksModel& model) {
  const std::vector<Index> counts = level_histogram(model);
  const Index most = *std::ranges::max_element(counts);
  std::string text = "\ninitial levels\n  level        step [s]   elements\n";
  for (std::size_t level = 0; level < counts.size(); ++level) {
    const auto length = counts[level] == 0 ? 0 : std::max<std::int64_t>(1, std::int64_t{longest_bar} * counts[level] / most);
    text += fmt::format("  {:>5}  {:>14}  {:>9}  {}\n", level, number(model.simulation->levels().step(static_cast<int>(level))),
                        counts[level], std::string(static_cast<std::size_t>(length), '#'));
  }
  return text;
}

std::string limiting_text(const BlocksModel& model, const cases::Mesh& mesh) {
  std::string text =
      "\nelements that limit the step (half of the stability limit with the neighbours held)\n"
      "    element      step [s]  limited by level  position [m]\n";
  for (const LimitingElement& limiting : limiting_elements(model, limiting_shown)) {
    const Vector3& place = model.simulation->bodies().start[static_cast<std::size_t>(limiting.element)];
    text += fmt::format(
        "  {:>9}  {:>12}  {:<10} {:>5}  ({}, {}, {})\n", element_tag(model.mesh, limiting.element),
        number(stable_share * limiting.stable_step), bound_by_dashpots(model, limiting.element) ? "dashpots" : "springs",
        model.simulation->levels().level(limiting.element), number(place.x()), number(place.y()), number(place.z()));
  }
  if (mesh.is_geometry()) text += "  numbers of elements are those of mesh.msh, which a run writes in its folder\n";
  return text;
}

std::string step_text(const BlocksModel& model, const RunClocks& clocks) {
  const Real base_step = model.simulation->levels().step(0), rate = evaluations_per_second(model);
  const Real smallest = stable_share * limiting_elements(model, 1).front().stable_step;
  return line("steps", fmt::format("base {} s ({} per history row), smallest stable step {} s", number(base_step),
                                   clocks.steps_per_row, number(smallest))) +
         line("work", fmt::format("{} pair evaluations per second of simulated time, {} in total, as long as nothing breaks",
                                  number(rate), number(rate * clocks.end)));
}

std::string cost_text(const cases::BlocksCase& blocks, const BlocksModel& model, const RunClocks& clocks) {
  const Real evaluations_per_second = model.elements == nullptr ? 10e6 : 4.5e6;  // see docs/develop/performance.md
  constexpr Real history_columns = 20, gauge_columns = 6, bytes_of_element = 240;
  const Cost cost{.work = runs::evaluations_per_second(model) * clocks.end,
                  .work_per_second = evaluations_per_second,
                  .columns = history_columns + gauge_columns * static_cast<Real>(blocks.gauges.size()),
                  .bodies = static_cast<Real>(model.simulation->bodies().size()),
                  .bytes_of_body = bytes_of_element};
  return cost_text(cost, clocks);
}

std::string check(const cases::CaseFile& file, const fs::path& made) {
  BlocksModel model = build_blocks(file.as<cases::BlocksCase>(), load_mesh(file, made, false));
  const Gauges gauges(file, model.mesh);
  const RunClocks clocks = make_clocks(file, file.as<cases::BlocksCase>().time, "base_step", model.simulation->levels().step(0));
  const std::string warning = warn_of(file, model);
  model.simulation->start();
  return cases::explain(file.as<cases::BlocksCase>()) + body_text(model) + second_look(file.as<cases::BlocksCase>(), model) +
         describe_waves(file.as<cases::BlocksCase>(), model) + describe_process_zones(file.as<cases::BlocksCase>(), model) +
         step_text(model, clocks) + cost_text(file.as<cases::BlocksCase>(), model, clocks) + level_text(model) +
         limiting_text(model, file.as<cases::BlocksCase>().mesh) + (warning.empty() ? "" : "\n" + warning);
}

}  // namespace

std::string check_blocks(const cases::CaseFile& file) {
  return check_with_meshes([&](const fs::path& folder) { return check(file, folder / "mesh.msh"); });
}

}  // namespace sazare::runs
