#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/sazare/commands.hpp"
#include "apps/sazare/signals.hpp"
#include "sazare/cases/case_file.hpp"
#include "sazare/cases/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/runs/progress.hpp"
#include "sazare/runs/run_case.hpp"

namespace sazare::command {

namespace {

namespace fs = std::filesystem;

Real figure(const observe::Manifest& manifest, std::string_view name) {
  for (const auto& [key, value] : manifest.results)
    if (key == name) return std::visit([](auto number) { return static_cast<Real>(number); }, value);
  return 0;
}

std::string balance_text(const observe::Manifest& manifest) {
  const Real work = figure(manifest, "energy_work"), residual = figure(manifest, "energy_residual");
  const std::string share = work != 0 ? fmt::format(" ({:.1e} of it)", std::abs(residual / work)) : "";
  return fmt::format("work {} J, unaccounted {} J{}", cases::short_number(work, 4), cases::short_number(residual, 2), share);
}

void print_mps_figures(const observe::Manifest& manifest, const fs::path& folder) {
  const auto number = [&](std::string_view name, int digits = 4) { return cases::short_number(figure(manifest, name), digits); };
  const Real seconds = figure(manifest, "wall_seconds");
  fmt::print("particles       {}, step {} s, predicted limit {} s\n", number("particles", 12), number("step"),
             number("predicted_limit"));
  fmt::print("peaks           {} m, {} m/s, {} m/s2\n", number("peak_displacement"), number("peak_speed"),
             number("peak_acceleration"));
  fmt::print("wall time       {:.2f} s, {} particle-steps per second, {} thread{}\n", seconds,
             cases::short_number(seconds > 0 ? figure(manifest, "particle_steps") / seconds : 0, 3), manifest.machine.threads,
             manifest.machine.threads == 1 ? "" : "s");
  fmt::print("results in      {}\n", folder.string());
}

void print_rectangles_figures(const observe::Manifest& manifest, const fs::path& folder) {
  const auto number = [&](std::string_view name, int digits = 4) { return cases::short_number(figure(manifest, name), digits); };
  const Real seconds = figure(manifest, "wall_seconds");
  fmt::print("elements        {}, step {} s, predicted limit {} s\n", number("elements", 12), number("step"),
             number("predicted_limit"));
  fmt::print("springs broken  {}, faces open {}\n", number("broken_springs", 12), number("open_links", 12));
  fmt::print("peaks           {} m, {} m/s\n", number("peak_displacement"), number("peak_speed"));
  fmt::print("energy          {}\n", balance_text(manifest));
  fmt::print("wall time       {:.2f} s, {} element-steps per second, {} thread{}\n", seconds,
             cases::short_number(seconds > 0 ? figure(manifest, "element_steps") / seconds : 0, 3), manifest.machine.threads,
             manifest.machine.threads == 1 ? "" : "s");
  fmt::print("results in      {}\n", folder.string());
}

void print_spheres_figures(const observe::Manifest& manifest, const fs::path& folder) {
  const auto number = [&](std::string_view name, int digits = 4) { return cases::short_number(figure(manifest, name), digits); };
  const Real seconds = figure(manifest, "wall_seconds");
  fmt::print("spheres         {}, {} contacts at the end, step {} s\n", number("particles", 12), number("contacts", 12),
             number("step"));
  if (figure(manifest, "bodies") > 0)
    fmt::print("bodies          {} bonded, {} of them broken, in {} pieces\n", number("bodies", 12), number("bodies_broken", 12),
               number("fragments", 12));
  fmt::print("energy          lost {} J, unaccounted {} J; peak speed {} m/s\n", number("energy_lost"),
             number("energy_residual", 2), number("peak_speed"));
  fmt::print("wall time       {:.2f} s, {} sphere-steps per second, {} thread{}\n", seconds,
             cases::short_number(seconds > 0 ? figure(manifest, "particle_steps") / seconds : 0, 3), manifest.machine.threads,
             manifest.machine.threads == 1 ? "" : "s");
  fmt::print("results in      {}\n", folder.string());
}

void print_fem_figures(const observe::Manifest& manifest, const fs::path& folder) {
  const auto number = [&](std::string_view name, int digits = 4) { return cases::short_number(figure(manifest, name), digits); };
  fmt::print("elements        {}, {} freedoms, {} steps of {} s\n", number("elements", 12), number("freedoms", 12),
             number("steps", 12), number("step"));
  fmt::print("solver          {} iterations, {} steps cut\n", number("iterations", 12), number("cuts", 12));
  fmt::print("peaks           {} m, {} m/s, {} m/s2\n", number("peak_displacement"), number("peak_speed"),
             number("peak_acceleration"));
  fmt::print("energy          {}\n", balance_text(manifest));
  fmt::print("wall time       {:.2f} s, {} thread{}\n", figure(manifest, "wall_seconds"), manifest.machine.threads,
             manifest.machine.threads == 1 ? "" : "s");
  fmt::print("results in      {}\n", folder.string());
}

/// How many bodies a hybrid run has, by the name that they have among its figures.
std::string bodies_text(const observe::Manifest& manifest) {
  for (const auto& [name, words] : {std::pair{"particles", "spheres"}, {"body_elements", "rectangles"}, {"blocks", "blocks"}})
    if (std::ranges::any_of(manifest.results, [&](const auto& result) { return result.first == name; }))
      return fmt::format("{} {}", cases::short_number(figure(manifest, name), 12), words);
  return "no bodies";
}

void print_hybrid_figures(const observe::Manifest& manifest, const fs::path& folder) {
  const auto number = [&](std::string_view name, int digits = 4) { return cases::short_number(figure(manifest, name), digits); };
  fmt::print("sides           {} elements, {}; {} windows of {} s, {} passes\n", number("elements", 12), bodies_text(manifest),
             number("windows", 12), number("window"), number("passes", 12));
  fmt::print("surface         force up to {} N, moved up to {} m\n", number("peak_force"), number("peak_displacement"));
  fmt::print("energy          {} J over the surface, {} J made there, {} J unaccounted\n", number("work_on_nodes"),
             number("energy_made", 2), number("energy_residual", 2));
  fmt::print("wall time       {:.2f} s, {} thread{}\n", figure(manifest, "wall_seconds"), manifest.machine.threads,
             manifest.machine.threads == 1 ? "" : "s");
  fmt::print("results in      {}, its sides in continuum/ and bodies/ there\n", folder.string());
}

void print_figures(const observe::Manifest& manifest, const fs::path& folder) {
  if (manifest.method == "mps") return print_mps_figures(manifest, folder);
  if (manifest.method == "rectangles") return print_rectangles_figures(manifest, folder);
  if (manifest.method == "spheres") return print_spheres_figures(manifest, folder);
  if (manifest.method == "fem") return print_fem_figures(manifest, folder);
  if (manifest.method == "hybrid") return print_hybrid_figures(manifest, folder);
  const auto number = [&](std::string_view name, int digits = 4) { return cases::short_number(figure(manifest, name), digits); };
  fmt::print("joints broken   {} of {}\n", number("broken_joints", 12), number("joints", 12));
  fmt::print("fragments       {} of {} elements, X50 {} m, X80 {} m\n", number("fragments", 12), number("elements", 12),
             number("x50", 3), number("x80", 3));
  fmt::print("largest throw   {} m, peak speed {} m/s\n", number("throw_max"), number("peak_speed"));
  fmt::print("energy          {}\n", balance_text(manifest));
  fmt::print("wall time       {:.2f} s, {} pair evaluations, {} thread{}\n", figure(manifest, "wall_seconds"),
             number("pair_evaluations"), manifest.machine.threads, manifest.machine.threads == 1 ? "" : "s");
  fmt::print("results in      {}\n", folder.string());
}

runs::Begin begin_of(const RunArguments& arguments) {
  return arguments.resume ? runs::Begin::resume : arguments.overwrite ? runs::Begin::overwrite : runs::Begin::fresh;
}

engine::Sharing sharing_of(const RunArguments& arguments, const parallel::Ranks& ranks) {
  const auto policy = std::ranges::find(balance_policies, arguments.balance) - balance_policies.begin();
  return {ranks.size() > 1 ? &ranks : nullptr, static_cast<distribute::Policy>(policy), arguments.balance_interval};
}

/// runs/<name>, and with one side only a folder of the side in it.
fs::path folder_of(const RunArguments& arguments) {
  if (!arguments.folder.empty()) return arguments.folder;
  const fs::path folder = default_folder(arguments.of_case.file);
  return arguments.side.empty() ? folder : folder / arguments.side;
}

std::optional<runs::OneSide> side_of(const RunArguments& arguments, const cases::CaseFile& file) {
  if (arguments.side.empty()) return std::nullopt;
  if (!std::holds_alternative<cases::HybridCase>(file.content))
    throw UserError(fmt::format("{}: --side is for cases of method hybrid, which have two: leave it out", file.path.string()));
  const fs::path exchange = arguments.exchange.empty() ? default_folder(arguments.of_case.file) / "exchange" : arguments.exchange;
  const auto side =
      arguments.side == coupling::name_of(coupling::Side::bodies) ? coupling::Side::bodies : coupling::Side::continuum;
  return runs::OneSide{side, exchange, arguments.time_out};
}

std::string resume_text(const RunArguments& arguments, const fs::path& folder) {
  std::string text = fmt::format("sazare run {} --out {} --resume", arguments.of_case.file.string(), folder.string());
  if (!arguments.side.empty()) text += fmt::format(" --side {}", arguments.side);
  if (!arguments.exchange.empty()) text += fmt::format(" --exchange {}", arguments.exchange.string());
  for (const std::string& setting : arguments.of_case.settings) text += fmt::format(" --set '{}'", setting);
  return text;
}

}  // namespace

int run(const RunArguments& arguments, const parallel::Ranks& ranks) {
  stop_on_signals();
  parallel::set_threads(arguments.of_case.threads);
  const cases::CaseFile file = cases::read_case(arguments.of_case.file, arguments.of_case.settings);
  if (ranks.size() > 1 && !std::holds_alternative<cases::BlocksCase>(file.content))
    throw UserError(
        fmt::format("this method runs in one process, and {} were started: leave mpirun out, and use --threads", ranks.size()));
  if (ranks.is_first()) fmt::print(stderr, "{}", file.warnings);
  const fs::path folder = folder_of(arguments);
  const bool quiet = arguments.quiet || !ranks.is_first();
  const runs::RunOutcome outcome = runs::run_case(
      file, {folder, begin_of(arguments), quiet, &stop_asked, sharing_of(arguments, ranks), side_of(arguments, file)});
  if (!ranks.is_first()) return outcome.stopped ? stopped : done;
  if (outcome.stopped && !outcome.begun) {
    fmt::print(stderr, "stopped before the beginning, so there is nothing to go on from. To run it:\n  {}\n",
               resume_text(arguments, folder));
    return stopped;
  }
  if (outcome.stopped) {
    fmt::print(stderr, "stopped at t = {} s, with a checkpoint. To go on:\n  {}\n", cases::short_number(outcome.time),
               resume_text(arguments, folder));
    return stopped;
  }
  if (!arguments.quiet) print_figures(outcome.manifest, folder);
  return done;
}

}  // namespace sazare::command
