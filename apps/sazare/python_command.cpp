#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "apps/sazare/commands.hpp"
#include "sazare/core/error.hpp"

extern char** environ;

namespace sazare::command {

namespace {

namespace fs = std::filesystem;

/// The Python beside the command, where it was installed with the package; else that of the project in which the command was
/// built, else that of the machine.
std::string python() {
  std::error_code unknown;
  const fs::path beside = fs::read_symlink("/proc/self/exe", unknown).parent_path() / "python3";
  if (!unknown && fs::exists(beside) && std::string_view(SAZARE_SOURCE_FOLDER).empty()) return beside.string();
  const fs::path own = fs::path(SAZARE_SOURCE_FOLDER) / "build/venv/bin/python";
  return fs::exists(own) ? own.string() : "python3";
}

/// Makes the package known to a Python that does not have it installed.
void add_package_path() {
  if (std::string_view(SAZARE_SOURCE_FOLDER).empty()) return;
  const fs::path package = fs::path(SAZARE_SOURCE_FOLDER) / "python";
  if (!fs::exists(package / "sazare" / "__init__.py")) return;
  const char* before = std::getenv("PYTHONPATH");
  const std::string path = package.string() + (before != nullptr && *before != '\0' ? ":" + std::string(before) : "");
  setenv("PYTHONPATH", path.c_str(), 1);
}

/// Starts a program on which Ctrl-C acts as usual, though this one leaves it to that program from now on: so its last words come
/// before the prompt.
pid_t start(const std::string& program, char* const* arguments) {
  std::signal(SIGINT, SIG_IGN);
  posix_spawnattr_t rules;
  sigset_t as_usual;
  posix_spawnattr_init(&rules);
  sigemptyset(&as_usual);
  sigaddset(&as_usual, SIGINT);
  posix_spawnattr_setsigdefault(&rules, &as_usual);
  posix_spawnattr_setflags(&rules, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), nullptr, &rules, arguments, environ);
  posix_spawnattr_destroy(&rules);
  if (error != 0)
    throw MachineError(
        fmt::format("{}: cannot be started: {}. Reports and pictures are made by Python: run make setup, or install python3",
                    program, std::generic_category().message(error)));
  return child;
}

}  // namespace

int in_python(std::vector<std::string> arguments) {
  std::string program = python();
  arguments.insert(arguments.begin(), {program, "-m", "sazare"});
  std::vector<char*> list;
  for (std::string& argument : arguments) list.push_back(argument.data());
  list.push_back(nullptr);
  add_package_path();
  const pid_t child = start(program, list.data());
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw MachineError(fmt::format("{}: was lost: {}", program, std::generic_category().message(errno)));
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == done || code == UserError::exit_code || code == MachineError::exit_code) return code;
  if (WIFEXITED(status))
    throw MachineError(fmt::format("{} failed. If a module is missing: run make setup", program));
  throw MachineError(fmt::format("{}: was terminated by signal {}", program, WTERMSIG(status)));
}

}  // namespace sazare::command
