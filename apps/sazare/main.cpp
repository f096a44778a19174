/// The command `sazare`.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <system_error>
#include <thread>

#include "apps/sazare/commands.hpp"
#include "apps/sazare/signals.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/version.hpp"
#include "sazare/levels/distribute/balance.hpp"

namespace {

using namespace sazare;

constexpr int program_error = 1;
constexpr std::chrono::seconds time_for_the_first(3);

void add_case_options(CLI::App& command, command::CaseArguments& arguments) {
  command.add_option("CASE", arguments.file, "the case file (TOML)")->required();
  command.add_option("--set", arguments.settings, "override a key of the case: --set time.end=1e-4 --set joints.0.cohesion=5e6")
      ->type_name("table.key=value")
      ->expected(1)
      ->take_all();
  command
      .add_option("--threads", arguments.threads,
                  "number of threads (default: OMP_NUM_THREADS, or all processors; fewer for less than 4000 elements each)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
}

/// The Python package, which draws it, has the last word; here a wrong ending is told before the case is looked at.
std::string has_ending_of_picture(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array endings{".png", ".pdf", ".svg", ".jpg"};
  return std::ranges::find(endings, ending) != endings.end() ? "" : file + " must end in .png, .pdf, .svg or .jpg";
}

void describe_study(CLI::App& study, command::StudyArguments& arguments) {
  study.add_option("STUDY", arguments.file, "the study file (TOML)")->required();
  study.add_option("--out", arguments.folder, "the study's folder (default: runs/<name of the study>)")->type_name("DIR");
  study.add_option("--threads", arguments.threads, "number of cases run at the same time (default: all processors)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  auto* resume = study.add_flag("--resume", arguments.resume, "resume a stopped study");
  study.add_flag("--overwrite", arguments.overwrite, "replace the study that is in the folder")->excludes(resume);
  study.add_flag("--quiet", arguments.quiet, "print warnings and errors only");
}

/// A geometry (.geo) is a program of Gmsh; one that does more than describe shapes runs only where the user says so.
void add_trust(CLI::App& command) {
  command.add_flag_callback(
      "--trust-geometry", [] { setenv("SAZARE_TRUST_GEOMETRY", "1", 1); },
      "run .geo files that run commands, or write or read other files, as they are");
}

/// A checkpoint goes into the memory of a run as it is; one that is not the user's own is read only where the user says so.
void add_checkpoint_trust(CLI::App& command) {
  command.add_flag_callback(
      "--trust-checkpoint", [] { setenv("SAZARE_TRUST_CHECKPOINT", "1", 1); },
      "resume from a checkpoint that was not written by you on this machine");
}

/// What Python carries out, and reads the arguments of.
const std::vector<std::pair<std::string, std::string>> python_commands = {
    {"report", "figures, plots and one HTML page of a run"},
    {"plot", "selected figures of a run's report as files"},
    {"movie", "an animation of a run's snapshots"},
    {"compare", "results and histories of two runs side by side"},
    {"blast", "numbers of a blast: sizes of fragments, vibration, damage, energy, as tables and pictures"},
    {"lab", "laboratory tests of a rock of method blocks: strength, elasticity, envelope, calibration"},
    {"blast-model", "geometry and case of method blocks from a drill pattern"},
    {"muck-pile", "fragments of a blast fly and land: throw, flyrock, muck pile, back-break"},
    {"sweep", "a case with every combination of values of some keys: many runs, one table and picture"},
    {"armour", "damage of an armour layer of method spheres: displaced units, N_od, eroded area, settlement"},
    {"armour-model", "case of an armour layer of method spheres: units placed by a grid on a slope"},
    {"motion", "a record of ground motion: figures, response spectra, correction, scaling, deconvolution"},
};

/// An error of the user, or nothing: a number of seconds after which waiting ends.
std::string is_a_duration(const std::string& text) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (*end == '\0' && seconds > 0 && std::isfinite(seconds)) return {};
  return "must be a finite number of seconds above 0, found " + text;
}

void describe_partner(CLI::App& run, command::RunArguments& arguments) {
  auto* side = run.add_option("--side", arguments.side,
                              "run only this side of a hybrid case, continuum or bodies; another program runs the other one")
                   ->check(CLI::IsMember(std::vector<std::string>{"continuum", "bodies"}))
                   ->type_name("SIDE");
  run.add_option("--exchange", arguments.exchange,
                 "with --side: the folder in which both programs exchange files (default: runs/<name of the case>/exchange)")
      ->needs(side)
      ->type_name("DIR");
  run.add_option("--time-out", arguments.time_out, "with --side: seconds to wait for the other program (default 600)")
      ->needs(side)
      ->check(is_a_duration)
      ->type_name("S");
}

struct Arguments {
  command::RunArguments run;
  command::CheckArguments check;
  command::StudyArguments study;
  bool markdown = false, folder = false;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.set_version_flag("--version", fmt::format("sazare {} ({})", version, commit));
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "help of all commands");
  auto& run = *app.add_subcommand("run", "run a case");
  add_case_options(run, arguments.run.of_case);
  add_trust(run);
  add_checkpoint_trust(run);
  run.add_option("--out", arguments.run.folder, "the run's folder (default: runs/<name of the case>)")->type_name("DIR");
  auto* resume = run.add_flag("--resume", arguments.run.resume, "resume a stopped or killed run from its checkpoint");
  run.add_flag("--overwrite", arguments.run.overwrite, "replace the run that is in the folder")->excludes(resume);
  run.add_option(
         "--balance", arguments.run.balance,
         "with mpirun: how the work is distributed over ranks: graph (each time level evenly with few links between ranks, by "
         "METIS; the default where it is installed), by_level (each time level evenly; the default elsewhere), predicted, "
         "measured, fixed, printed and printed_fixed (as Konno and others 2018 have it), or random (a trial); spheres: fixed, "
         "random, or measured with any other word")
      ->check(CLI::IsMember(std::vector<std::string>(distribute::policy_names.begin(), distribute::policy_names.end())))
      ->type_name("POLICY");
  run.add_option("--balance-interval", arguments.run.balance_interval,
                 "base steps between two distributions of the work (default 50)")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  run.add_flag("--quiet", arguments.run.quiet, "print warnings and errors only");
  describe_partner(run, arguments.run);
  auto& check =
      *app.add_subcommand("check", "report every error of a case, or what it will do: steps, levels, limiting elements");
  add_case_options(check, arguments.check.of_case);
  check
      .add_option("--picture", arguments.check.picture,
                  "draw the model at t = 0 with its groups, boundaries, loads and gauges (.png, .pdf, .svg or .jpg)")
      ->check(has_ending_of_picture)
      ->type_name("FILE");
  check.add_option("--ranks", arguments.check.ranks, "tell how so many processes of mpirun would share the work")
      ->check(CLI::Range(2, 1000000))
      ->type_name("N");
  add_trust(check);
  auto& study = *app.add_subcommand("study", "families of cases: the stability limit of each, by bisection");
  describe_study(study, arguments.study);
  add_trust(study);
  for (const auto& [name, words] : python_commands) app.add_subcommand(name, words)->prefix_command()->set_help_flag();
  auto& schema = *app.add_subcommand("schema", "the schema of the case file, as JSON for editors");
  auto* page = schema.add_flag("--markdown", arguments.markdown, "print it as a page of the reference");
  schema.add_flag("--folder", arguments.folder, "print the output of a run as a page of the reference")->excludes(page);
  app.add_subcommand("info", "version, compiler, machine, threads, MPI");
  app.footer(
      "Exit codes: 0 success, 2 user error, 3 failure of the simulated physics, 4 failure of the machine, or the run was "
      "stopped.");
}

int carry_out(const CLI::App& app, const Arguments& arguments, const parallel::Ranks& ranks) {
  if (app.got_subcommand("run")) return command::run(arguments.run, ranks);
  if (app.got_subcommand("study")) return command::study(arguments.study);
  if (app.got_subcommand("check")) return command::check(arguments.check);
  for (const auto& [name, words] : python_commands) {
    if (!app.got_subcommand(name)) continue;
    std::vector<std::string> all = app.get_subcommand(name)->remaining();
    all.insert(all.begin(), name);
    return command::in_python(all);
  }
  if (app.got_subcommand("schema"))
    return command::schema(arguments.folder     ? command::Schema::folder
                           : arguments.markdown ? command::Schema::page
                                                : command::Schema::json);
  return command::info(ranks);
}

void print_failure(const std::string& kind, const std::string& what) {
  fmt::print(stderr, "{}{}\n", what.starts_with("error") || what.find(": error") != std::string::npos ? "" : kind + ": ",
             what.ends_with('\n') ? what.substr(0, what.size() - 1) : what);
}

/// Lets idle threads spin for a moment only. OpenMP's own choice, some milliseconds, makes a run up to thirty times slower
/// where other programs want the processors. It reads this before main, so the program begins anew.
void spin_briefly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  setenv("GOMP_SPINCOUNT", "10000", 1);
  if (!unknown) execv(program.c_str(), argv);  // where it fails, all is as it was
}

/// Carries out the command; errors become messages and exit codes. Of several ranks the first one speaks; an error that the
/// others may not have ends them all.
int run_command(const CLI::App& app, const Arguments& arguments, const parallel::Ranks& ranks) {
  const auto fail = [&](const std::string& kind, const std::string& what, int exit_code, bool everywhere = false) {
    if (everywhere && !ranks.is_first()) return exit_code;
    if (!ranks.is_first()) std::this_thread::sleep_for(time_for_the_first);  // it most likely fails as well, and ends this one
    print_failure(kind, what);
    if (ranks.size() > 1 && !everywhere) ranks.abort(exit_code);
    return exit_code;
  };
  try {
    return carry_out(app, arguments, ranks);
  } catch (const UserError& error) {
    return fail("error", error.what(), UserError::exit_code);
  } catch (const PhysicsError& error) {
    return fail("the physics failed", error.what(), PhysicsError::exit_code, true);
  } catch (const MachineError& error) {
    return fail(sazare::command::stop_asked ? "stopped" : "the machine failed", error.what(), MachineError::exit_code);
  } catch (const std::bad_alloc&) {
    return fail("the machine failed", "not enough memory: use a coarser mesh, or a machine with more", MachineError::exit_code);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(
        "the machine failed",
        fmt::format("{}: {}. Is the path right, and may it be read and written?", error.path1().string(), error.code().message()),
        MachineError::exit_code);
  } catch (const std::system_error& error) {
    return fail("the machine failed", fmt::format("a file could not be read or written: {}", error.code().message()),
                MachineError::exit_code);
  } catch (const std::exception& error) {
    return fail("error of the program", fmt::format("{}. Please report it", error.what()), program_error);
  }
}

/// The exit code, once all that was printed has gone where it should: a full disk behind standard output is told, too.
int with_output(int exit_code) {
  if (exit_code != 0 || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return exit_code;
  print_failure("the machine failed", "standard output cannot be written: is the disk full?");
  return MachineError::exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  spin_briefly(argv);
  try {
    parallel::Ranks ranks(argc, argv);
    ranks.watch(&command::stop_asked);
    CLI::App app("Sazare: dynamic failure of ground, rock and concrete", "sazare");
    Arguments arguments;
    describe(app, arguments);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return !ranks.is_first() ? UserError::exit_code : app.exit(error) == 0 ? with_output(0) : UserError::exit_code;
    }
    return with_output(run_command(app, arguments, ranks));
  } catch (const UserError& error) {  // of the launch
    print_failure("error", error.what());
    return UserError::exit_code;
  }
}
