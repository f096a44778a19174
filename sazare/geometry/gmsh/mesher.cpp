#include "sazare/geometry/gmsh/mesher.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "sazare/core/error.hpp"
#include "sazare/geometry/gmsh/geometry_file.hpp"

extern char** environ;

namespace sazare::geometry {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

/// A folder that nobody else knows, beside what is to be made: gmsh follows links, and its file would have a name that can be
/// guessed.
struct OwnFolder {
  std::string path;

  explicit OwnFolder(const fs::path& where) : path((where / ".sazare-mesh-XXXXXX").string()) {
    if (mkdtemp(path.data()) == nullptr) path.clear();
  }
  ~OwnFolder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
};

bool is_name_character(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

bool holds_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_name_character(text[at - 1])) && (end == text.size() || !is_name_character(text[end]))) {
      return true;
    }
  }
  return false;
}

std::string read_geometry(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) {
    throw UserError(fmt::format("{}: there is no such geometry file, or it cannot be read. Check the name", file.string()));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Gmsh leaves out a last line without an end.
void check_last_line(const MeshRequest& request, const std::string& text) {
  if (text.find_first_not_of(" \t\r", text.rfind('\n') + 1) != std::string::npos)
    throw UserError(fmt::format("{}: the last line does not end, and gmsh leaves it out. Add a line break at the end of the file",
                                request.geometry.string()));
}

/// Gmsh ignores a number it was not asked for; a wrong name must not pass in silence.
void check_parameters(const MeshRequest& request, const std::string& text) {
  const bool has_other_files = holds_word(text, "Include") || holds_word(text, "Merge");
  for (const auto& [name, value] : request.parameters) {
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_name_character)) {
      throw UserError(
          fmt::format("{}: the parameter '{}' is not a valid name: letters, digits and _ only", request.geometry.string(), name));
    }
    if (!std::isfinite(value)) {
      throw UserError(
          fmt::format("{}: the parameter '{}' is {}; it should be a finite number", request.geometry.string(), name, value));
    }
    if (!has_other_files && !holds_word(text, name)) {
      throw UserError(
          fmt::format("{}: the parameter '{}' does not occur in this file. Define it there: "
                      "DefineConstant[ {} = {} ];",
                      request.geometry.string(), name, name, value));
    }
    if (!has_other_files && !holds_word(text, "DefineConstant")) {
      throw UserError(
          fmt::format("{}: the parameter '{}' has no effect because the file sets it itself. Write there: "
                      "DefineConstant[ {} = {} ];",
                      request.geometry.string(), name, name, value));
    }
  }
  if (!(request.size_factor > 0) || !std::isfinite(request.size_factor)) {
    throw UserError(fmt::format("{}: the size factor is {}; it should be a finite number greater than zero",
                                request.geometry.string(), request.size_factor));
  }
}

std::vector<std::string> arguments_for(const MeshRequest& request, const fs::path& output) {
  std::vector<std::string> arguments = {request.program,
                                        fs::absolute(request.geometry).string(),
                                        fmt::format("-{}", request.dimension),
                                        "-o",
                                        output.string(),
                                        "-format",
                                        "msh41",
                                        "-bin",
                                        "-nt",
                                        "1",
                                        "-v",
                                        "3"};
  arguments.insert(arguments.end(), {"-clscale", fmt::format("{}", request.size_factor)});
  arguments.insert(arguments.end(), {"-setnumber", "Mesh.RandomSeed", "1"});
  for (const auto& [name, value] : request.parameters) {
    arguments.insert(arguments.end(), {"-setnumber", name, fmt::format("{}", value)});
  }
  return arguments;
}

/// This process's environment without the user's own gmsh settings, which would change the mesh.
std::vector<std::string> environment_for_gmsh() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (!text.starts_with("GMSH_HOME=") && !text.starts_with("OMP_NUM_THREADS=")) variables.emplace_back(text);
  }
  variables.insert(variables.end(), {"GMSH_HOME=/nonexistent", "OMP_NUM_THREADS=1"});
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

struct Outcome {
  int start_error = 0;  ///< errno of the start, 0 when the program ran
  int status = 0;       ///< as from waitpid
  std::string messages;
};

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// Runs a program without a shell; its output and error messages go to `messages`.
Outcome run(std::vector<std::string> arguments) {
  std::vector<std::string> environment = environment_for_gmsh();
  std::array<int, 2> pipe_ends{};
  Outcome outcome;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    outcome.start_error = errno;
    return outcome;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  pid_t process = 0;
  outcome.start_error =
      posix_spawnp(&process, arguments[0].c_str(), &actions, nullptr, pointers(arguments).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  if (outcome.start_error == 0) {
    outcome.messages = read_all(pipe_ends[0]);
    while (waitpid(process, &outcome.status, 0) < 0 && errno == EINTR) {
    }
  }
  close(pipe_ends[0]);
  return outcome;
}

struct Messages {
  std::vector<std::string> errors;
  std::vector<std::string> lines;
};

Messages split(const std::string& text) {
  Messages messages;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.empty()) continue;
    if (line.starts_with("Error")) messages.errors.push_back(line);
    messages.lines.push_back(std::move(line));
  }
  return messages;
}

std::string last_lines(const std::vector<std::string>& lines, std::size_t count) {
  std::string text;
  const std::size_t first = lines.size() > count ? lines.size() - count : 0;
  for (std::size_t i = first; i < lines.size(); ++i) text += "\n  " + lines[i];
  return text;
}

void check_outcome(const MeshRequest& request, const Outcome& outcome, const fs::path& output) {
  const std::string geometry = request.geometry.string();
  if (outcome.start_error == ENOENT) {
    throw UserError(
        fmt::format("{}: meshing it requires the program '{}', which is not installed. Install it (Debian: apt install gmsh), or "
                    "name a .msh file",
                    geometry, request.program));
  }
  if (outcome.start_error != 0) {
    throw MachineError(
        fmt::format("{}: the program '{}' could not be started: {}", geometry, request.program, reason(outcome.start_error)));
  }
  const Messages messages = split(outcome.messages);
  constexpr std::size_t shown = 8;
  const std::string words = last_lines(messages.errors.empty() ? messages.lines : messages.errors, shown);
  if (WIFSIGNALED(outcome.status) && (WTERMSIG(outcome.status) == SIGINT || WTERMSIG(outcome.status) == SIGTERM)) {
    throw MachineError(fmt::format("{}: stopped while gmsh was meshing it. The run has not started: run it again", geometry));
  }
  if (WIFSIGNALED(outcome.status)) {
    throw MachineError(
        fmt::format("{}: gmsh was terminated by signal {} (out of memory?).{}", geometry, WTERMSIG(outcome.status), words));
  }
  std::error_code ignored;
  if (WEXITSTATUS(outcome.status) == 0 && messages.errors.empty() && fs::exists(output, ignored)) return;
  throw UserError(fmt::format("{}: gmsh could not mesh it. Its last messages:{}", geometry, words));
}

/// Gmsh does not tell of a disk that is full: the end of its file then is not that of a section.
void check_end(const MeshRequest& request, const fs::path& output) {
  constexpr std::streamoff tail = 32;
  std::ifstream stream(output, std::ios::binary | std::ios::ate);
  const std::streamoff length = stream.tellg();
  std::string end(static_cast<std::size_t>(std::clamp<std::streamoff>(length, 0, tail)), ' ');
  stream.seekg(length - static_cast<std::streamoff>(end.size()));
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  if (end.find("$End") != std::string::npos) return;
  throw MachineError(
      fmt::format("{}: the mesh written by gmsh is truncated: is the disk full? It has been removed", request.mesh.string()));
}

}  // namespace

void mesh_geometry(const MeshRequest& request) {
  if (!geometries_are_trusted()) refuse_what_reaches_outside(request.geometry);
  const std::string text = read_geometry(request.geometry);
  check_last_line(request, text);
  check_parameters(request, text);
  std::error_code error;
  const fs::path folder = fs::absolute(request.mesh).parent_path();
  fs::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK) != 0) {
    throw MachineError(fmt::format("{}: cannot be written: {}. Choose another folder", request.mesh.string(),
                                   error ? error.message() : reason(errno)));
  }
  const OwnFolder own(folder);
  if (own.path.empty())
    throw MachineError(fmt::format("{}: cannot be written: {}. Choose another folder", request.mesh.string(), reason(errno)));
  const fs::path made = fs::path(own.path) / "made.msh";
  check_outcome(request, run(arguments_for(request, made)), made);
  check_end(request, made);
  fs::rename(made, request.mesh, error);
  if (error) {
    throw MachineError(fmt::format("{}: cannot be written: {}", request.mesh.string(), error.message()));
  }
}

}  // namespace sazare::geometry
