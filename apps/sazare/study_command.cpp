#include <fmt/format.h>

#include <cstdio>

#include "apps/sazare/commands.hpp"
#include "apps/sazare/signals.hpp"
#include "sazare/cases/format/shell_word.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::command {

int study(const StudyArguments& arguments) {
  stop_on_signals();
  parallel::set_threads(arguments.threads);
  const cases::Study study = cases::read_study(arguments.file);
  const std::filesystem::path folder = arguments.folder.empty() ? default_folder(arguments.file) : arguments.folder;
  const runs::Begin begin = arguments.resume      ? runs::Begin::resume
                            : arguments.overwrite ? runs::Begin::overwrite
                                                  : runs::Begin::fresh;
  const runs::StudyOutcome outcome =
      registry::run_study(study, {folder, begin, arguments.quiet, parallel::threads(), &stop_asked});
  if (outcome.done < outcome.cases) {
    fmt::print(stderr, "stopped after {} of {} cases. To resume:\n  sazare study {} --out {} --resume\n", outcome.done,
               outcome.cases, cases::shell_word(arguments.file.string()), cases::shell_word(folder.string()));
    return stopped;
  }
  if (!arguments.quiet) {
    fmt::print("cases           {}\n", outcome.cases);
    fmt::print("{}", outcome.summary);
    fmt::print("wall-clock time {:.1f} s\n", outcome.wall_seconds);
    fmt::print("results in      {}\n", folder.string());
  }
  return done;
}

}  // namespace sazare::command
