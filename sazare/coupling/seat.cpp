#include "sazare/coupling/seat.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::coupling {

namespace {

namespace fs = std::filesystem;

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "unknown";
}

/// Tries several times: a partner that looks whether the lock is taken has it for a moment.
bool take(int descriptor) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace

std::string Presence::written() const {
  Entries lines;
  lines.add("side", std::string(name_of(side)));
  lines.add("session", session);
  lines.add("partner", partner);
  lines.add("run", run);
  lines.add_count("next", next);
  lines.add_count("kept", kept);
  lines.add_count("process", process);
  lines.add("host", host);
  lines.add("lock", locks ? "flock" : "none");
  lines.add("state", is_done ? "done" : "here");
  return lines.written();
}

Presence Presence::read(std::string_view text, const std::string& name) {
  const Entries lines(text, name, "");
  Presence presence;
  presence.side = lines.text("side") == name_of(Side::bodies) ? Side::bodies : Side::continuum;
  presence.session = lines.text("session");
  presence.partner = lines.text("partner");
  presence.run = lines.text("run");
  presence.next = lines.count("next");
  presence.kept = lines.count("kept");
  presence.process = lines.count("process");
  presence.host = lines.text("host");
  presence.locks = lines.text("lock") == "flock";
  presence.is_done = lines.text("state") == "done";
  return presence;
}

std::string random_identity() {
  std::random_device chance;
  return observe::to_hex((std::uint64_t{chance()} << 32) | chance());
}

Seat::Seat(fs::path folder, Side side) : folder_(std::move(folder)), side_(side) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) observe::fail_to_write(folder_, error.value());
  descriptor_ = open(lock_of(side).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) observe::fail_to_write(lock_of(side), errno);
  if (take(descriptor_)) return;
  close(descriptor_);
  throw UserError(
      fmt::format("{}: another program is the {} in this folder. Wait for it, or choose another folder for the exchange",
                  folder_.string(), name_of(side)));
}

Seat::~Seat() { close(descriptor_); }

fs::path Seat::lock_of(Side side) const { return folder_ / fmt::format("{}.lock", name_of(side)); }
fs::path Seat::here_of(Side side) const { return folder_ / fmt::format("{}.here", name_of(side)); }

void Seat::tell(Presence presence) const {
  presence.side = side_;
  presence.process = getpid();
  presence.host = host_name();
  presence.locks = true;
  observe::write_file(here_of(side_), presence.written(), observe::Sync::system);
}

std::optional<Presence> Seat::partner() const {
  const fs::path file = here_of(other(side_));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    return Presence::read(text, file.string());
  } catch (const DamagedFile&) {  // of a partner that does not write it in one go: it will be whole at the next look
    return std::nullopt;
  }
}

Seat::Life Seat::life_of(const Presence& partner) const {
  if (partner.locks) {
    const int descriptor = open(lock_of(partner.side).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return Life::gone;
    const bool is_free = flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    close(descriptor);
    return is_free ? Life::gone : Life::alive;
  }
  if (partner.host != host_name()) return Life::unknown;
  return kill(static_cast<pid_t>(partner.process), 0) == 0 || errno == EPERM ? Life::alive : Life::gone;
}

}  // namespace sazare::coupling
