/// How processes of a launch would share a case.

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/levels/distribute/partition.hpp"
#include "sazare/methods/blocks/run/mesh_source.hpp"
#include "sazare/methods/blocks/run/model.hpp"
#include "sazare/methods/blocks/run/run.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

using distribute::Policy;

constexpr Index fewest_elements =
    4000;  // of a rank, below which messages take longer than the work, see docs/guide/threads-and-ranks.md

std::string elements_text(const levels::SharingForecast& of) {
  return of.fewest == of.most ? fmt::format("{}", of.most) : fmt::format("{} to {}", of.fewest, of.most);
}

std::string policy_text(const levels::Simulation<3>& simulation, Policy policy, int ranks) {
  const levels::SharingForecast of = simulation.forecast(policy, ranks);
  return fmt::format("  {:<10}  {:>9.2f}  {:>18}  {:>15.1f} %  {:>12} B  {:>8}\n", distribute::name_of(policy), of.lock_step,
                     elements_text(of), 100 * of.twice, cases::short_number(static_cast<Real>(of.motion.bytes), 3),
                     of.motion.messages);
}

std::string explain(const cases::CaseFile& file, int ranks, const std::filesystem::path& made) {
  BlocksModel model = build_blocks(file.as<cases::BlocksCase>(), load_mesh(file, made, false));
  model.simulation->start();
  std::string text = fmt::format(
      "\non {} ranks, with the levels of the beginning\n"
      "  --balance   lock step     elements a rank  evaluated twice    most sent by a rank in a base step\n",
      ranks);
  for (const Policy policy : {Policy::fixed, Policy::predicted, Policy::by_level})
    text += policy_text(*model.simulation, policy, ranks);
  if (distribute::has_graph_partition()) text += policy_text(*model.simulation, Policy::graph, ranks);
  text +=
      "  lock step: mean over the ranks of the work at a tick over the largest of it; ranks meet at every tick, so it bounds the "
      "efficiency\n"
      "  measured follows the times of the run, from equal numbers of elements on, and random is for tests\n";
  const Index most_ranks = std::max<Index>(1, model.simulation->bodies().size() / fewest_elements);
  if (ranks > most_ranks)
    text +=
        fmt::format("  {} ranks have fewer than {} elements each and wait for messages longer than they work: take {}\n", ranks,
                    fewest_elements, most_ranks == 1 ? "one process and threads" : fmt::format("{} at most", most_ranks));
  return text;
}

}  // namespace

std::string explain_ranks_of_blocks(const cases::CaseFile& file, int ranks) {
  return check_with_meshes([&](const std::filesystem::path& folder) { return explain(file, ranks, folder / "mesh.msh"); });
}

}  // namespace sazare::runs
