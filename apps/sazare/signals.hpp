#pragma once

#include <atomic>
#include <filesystem>

namespace sazare::command {

/// Set by SIGTERM and by the first Ctrl-C; a second Ctrl-C ends the process at once.
extern std::atomic<bool> stop_asked;

void stop_on_signals();

/// runs/<name>, where case.toml and study.toml are called by their folder.
std::filesystem::path default_folder(const std::filesystem::path& file);

}  // namespace sazare::command
