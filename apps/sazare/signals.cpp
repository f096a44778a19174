#include "apps/sazare/signals.hpp"

#include <signal.h>

#include <string>

namespace sazare::command {

namespace fs = std::filesystem;

std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_asked = true; };
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGTERM, &action, nullptr);
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of the write, not the end of the process
}

fs::path default_folder(const fs::path& case_file) {
  const fs::path full = fs::absolute(case_file).lexically_normal();
  const std::string stem = full.stem().string(), parent = full.parent_path().filename().string();
  return fs::path("runs") / ((stem == "case" || stem == "study") && !parent.empty() ? parent : stem);
}

}  // namespace sazare::command
