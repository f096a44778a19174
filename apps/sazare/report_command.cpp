#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "apps/sazare/commands.hpp"
#include "sazare/core/error.hpp"

extern char** environ;

namespace sazare::command {

namespace {

namespace fs = std::filesystem;

/// The Python of the project that the program was built in, else that of the machine.
std::string python() {
  const fs::path own = fs::path(SAZARE_SOURCE_FOLDER) / "build/venv/bin/python";
  return fs::exists(own) ? own.string() : "python3";
}

/// Makes the package known to a Python that does not have it installed.
void add_package_path() {
  const fs::path package = fs::path(SAZARE_SOURCE_FOLDER) / "python";
  if (!fs::exists(package / "sazare" / "__init__.py")) return;
  const char* before = std::getenv("PYTHONPATH");
  const std::string path = package.string() + (before != nullptr && *before != '\0' ? ":" + std::string(before) : "");
  setenv("PYTHONPATH", path.c_str(), 1);
}

}  // namespace

int report(const fs::path& folder) {
  std::string program = python(), folder_text = folder.string();
  std::string dash_m = "-m", package = "sazare", command = "report";
  char* arguments[] = {program.data(), dash_m.data(), package.data(), command.data(), folder_text.data(), nullptr};
  add_package_path();
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ); error != 0)
    throw MachineError(fmt::format("{}: cannot be started: {}. The report is made by Python: run make setup, or install python3",
                                   program, std::generic_category().message(error)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw MachineError(fmt::format("{}: was lost: {}", program, std::generic_category().message(errno)));
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == done || code == UserError::exit_code || code == MachineError::exit_code) return code;
  if (WIFEXITED(status))
    throw MachineError(fmt::format("{} could not make the report. If it says that a module is missing: run make setup", program));
  throw MachineError(fmt::format("{}: was ended by signal {} while it made the report", program, WTERMSIG(status)));
}

}  // namespace sazare::command
