/// Counts the pair evaluations of a case, and what they would have been had all elements stepped with the smallest step of
/// any at each time:
///
///     evaluations CASE [table.key=value ...]
///
/// prints `pair_evaluations,N` and `uniform_evaluations,N`. Nothing is written and nothing is timed, so one thread does.

#include <cstdio>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/runs/blocks_model.hpp"
#include "sazare/runs/mesh_source.hpp"

namespace {

using namespace sazare;

engine::Counters count_evaluations(const std::string& path, const std::vector<std::string>& overrides) {
  const auto file = cases::read_case(path, overrides);
  auto model = runs::build_blocks(file.blocks(), runs::load_mesh(file, {}, false));
  auto& simulation = *model.simulation;
  simulation.start();
  const Real nearly_the_end = file.blocks().time.end - 0.5 * simulation.levels().step(0);
  while (simulation.now().seconds() < nearly_the_end) simulation.advance();
  return simulation.counters();
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> texts(arguments + 1, arguments + count);
  if (texts.empty()) {
    std::fprintf(stderr, "usage: evaluations CASE [table.key=value ...]\n");
    return UserError::exit_code;
  }
  try {
    parallel::set_threads(1);
    const auto counters = count_evaluations(texts.front(), {texts.begin() + 1, texts.end()});
    std::printf("pair_evaluations,%lld\n", static_cast<long long>(counters.pair_evaluations));
    std::printf("uniform_evaluations,%lld\n", static_cast<long long>(counters.uniform_evaluations));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
