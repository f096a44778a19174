#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "apps/sazare/commands.hpp"
#include "apps/sazare/signals.hpp"
#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/shell_word.hpp"
#include "sazare/core/error.hpp"
#include "sazare/levels/distribute/partition.hpp"
#include "sazare/parallel/processors.hpp"
#include "sazare/parallel/same_program.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/progress.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::command {

namespace {

namespace fs = std::filesystem;

runs::Begin begin_of(const RunArguments& arguments) {
  return arguments.resume ? runs::Begin::resume : arguments.overwrite ? runs::Begin::overwrite : runs::Begin::fresh;
}

distribute::Policy policy_of(const RunArguments& arguments) {
  using distribute::Policy;
  if (arguments.balance.empty()) return distribute::has_graph_partition() ? Policy::graph : Policy::by_level;
  const auto policy =
      static_cast<Policy>(std::ranges::find(distribute::policy_names, arguments.balance) - distribute::policy_names.begin());
  if (policy == Policy::graph) distribute::require_graph_partition();
  return policy;
}

levels::Sharing sharing_of(const RunArguments& arguments, const parallel::Ranks& ranks) {
  return {ranks.size() > 1 ? &ranks : nullptr, policy_of(arguments), arguments.balance_interval};
}

/// runs/<name>, and with one side only a folder of the side in it.
fs::path folder_of(const RunArguments& arguments) {
  if (!arguments.folder.empty()) return arguments.folder;
  const fs::path folder = default_folder(arguments.of_case.file);
  return arguments.side.empty() ? folder : folder / arguments.side;
}

std::optional<runs::OneSide> side_of(const RunArguments& arguments, const cases::CaseFile& file) {
  if (arguments.side.empty()) return std::nullopt;
  if (!registry::method(file.method).format.has_sides)
    throw UserError(
        fmt::format("{}: --side is only for cases of method hybrid, which have two sides: remove it", file.path.string()));
  const fs::path exchange = arguments.exchange.empty() ? default_folder(arguments.of_case.file) / "exchange" : arguments.exchange;
  const auto side =
      arguments.side == coupling::name_of(coupling::Side::bodies) ? coupling::Side::bodies : coupling::Side::continuum;
  return runs::OneSide{side, exchange, arguments.time_out};
}

std::string resume_text(const RunArguments& arguments, const fs::path& folder, const parallel::Ranks& ranks) {
  std::string text = ranks.size() > 1 ? fmt::format("mpirun -n {} ", ranks.size()) : "";
  text += fmt::format("sazare run {} --out {} --resume", cases::shell_word(arguments.of_case.file.string()),
                      cases::shell_word(folder.string()));
  if (ranks.size() > 1 && arguments.of_case.threads > 0) text += fmt::format(" --threads {}", arguments.of_case.threads);
  if (!arguments.balance.empty()) text += fmt::format(" --balance {}", arguments.balance);
  if (!arguments.side.empty()) text += fmt::format(" --side {}", arguments.side);
  if (!arguments.exchange.empty()) text += fmt::format(" --exchange {}", cases::shell_word(arguments.exchange.string()));
  for (const std::string& setting : arguments.of_case.settings) text += fmt::format(" --set {}", cases::shell_word(setting));
  return text;
}

}  // namespace

void use_threads(int asked, bool speaks) {
  const int most = parallel::processors();
  if (asked > most && speaks)
    fmt::print(stderr,
               "warning: --threads {}: this program may use {} processor{}, and more threads than that only wait for each other: "
               "{} used\n",
               asked, most, most == 1 ? "" : "s", most == 1 ? "1 is" : fmt::format("{} are", most));
  parallel::set_threads(std::min(asked, most));
}

int run(const RunArguments& arguments, const parallel::Ranks& ranks) {
  stop_on_signals();
  parallel::require_same_program(ranks);
  use_threads(arguments.of_case.threads, ranks.is_first());
  const cases::CaseFile file = registry::read_case(arguments.of_case.file, arguments.of_case.settings);
  if (ranks.size() > 1 && !registry::method(file.method).explain_ranks)
    throw UserError(
        fmt::format("this method runs in one process, and {} were started: do not use mpirun, use --threads", ranks.size()));
  if (ranks.is_first()) fmt::print(stderr, "{}", file.warnings);
  const fs::path folder = folder_of(arguments);
  const bool quiet = arguments.quiet || !ranks.is_first();
  const runs::RunOutcome outcome = registry::run_case(
      file, {folder, begin_of(arguments), quiet, &stop_asked, sharing_of(arguments, ranks), side_of(arguments, file)});
  if (!ranks.is_first()) return outcome.stopped ? stopped : done;
  if (outcome.stopped && !outcome.begun) {
    fmt::print(stderr, "stopped before the first step, so there is nothing to resume. To run it:\n  {}\n",
               resume_text(arguments, folder, ranks));
    return stopped;
  }
  if (outcome.stopped) {
    fmt::print(stderr, "stopped at t = {} s, with a checkpoint. To resume:\n  {}\n", cases::short_number(outcome.time),
               resume_text(arguments, folder, ranks));
    return stopped;
  }
  if (!arguments.quiet)
    fmt::print("{}results in      {}\n", registry::method(file.method).summary(outcome.manifest), folder.string());
  fmt::print(stderr, "{}", runs::balance_warning(outcome.manifest));
  return done;
}

}  // namespace sazare::command
