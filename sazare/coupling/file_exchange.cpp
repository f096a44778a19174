#include "sazare/coupling/file_exchange.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "sazare/observe/atomic_file.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::coupling {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> reasons = {"done", "stopped", "failed"};
constexpr Real grace = 1;  // of a partner that does not write its files in one go [s]

/// The bytes of a file; none where it is not there.
std::optional<std::string> read_if_there(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  struct stat status {};
  fstat(descriptor, &status);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t length = 0;
  while (length < bytes.size()) {
    const ssize_t count = read(descriptor, bytes.data() + length, bytes.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    length += static_cast<std::size_t>(count);
  }
  close(descriptor);
  bytes.resize(length);
  return bytes;
}

/// The sequence in the name of a message of a side; below 0 when it is no such name.
std::int64_t sequence_of(const std::string& name, Side side) {
  const std::string_view head = name_of(side), ending = ".message";
  if (!name.starts_with(head) || !name.ends_with(ending) || name.size() < head.size() + 1 + ending.size()) return -1;
  std::int64_t sequence = -1;
  const char* end = name.data() + name.size() - ending.size();
  const auto found = std::from_chars(name.data() + head.size() + 1, end, sequence);
  return found.ec == std::errc{} && found.ptr == end ? sequence : -1;
}

void check_numbers(const Message& message, const std::string& who) {
  for (const NumberTable& table : message.tables)
    for (std::size_t i = 0; i < table.values.size(); ++i)
      if (!std::isfinite(table.values[i]))
        throw PhysicsError(fmt::format("{}: {} of node {} in window {} (t = {} s, pass {}) is {}", who, table.name,
                                       i / static_cast<std::size_t>(table.columns), message.window, message.time, message.pass,
                                       table.values[i]));
}

std::string on_one_line(std::string words) {
  for (char& letter : words)
    if (letter == '\n' || letter == '\r') letter = ' ';
  return words.empty() ? "-" : words.substr(0, 2000);
}

}  // namespace

/// Adds what passes until it goes to a cost, unless it is told that it was a look in vain.
class FileExchange::Stopwatch {
public:
  explicit Stopwatch(ExchangeCost& cost) : cost_(&cost) {}
  ~Stopwatch() {
    if (cost_ == nullptr) return;
    cost_->seconds += std::chrono::duration<Real>(Clock::now() - began_).count();
    cost_->processor_seconds += parallel::processor_seconds() - processor_began_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  void forget() { cost_ = nullptr; }

private:
  using Clock = std::chrono::steady_clock;
  ExchangeCost* cost_;
  Clock::time_point began_ = Clock::now();
  Real processor_began_ = parallel::processor_seconds();
};

FileExchange::FileExchange(ExchangeOptions options)
    : options_(std::move(options)), seat_(options_.folder, options_.side), next_(options_.mark.next) {
  if (!(options_.time_out > 0))
    throw UserError(fmt::format("waiting for {} ends after a time above 0 s, found {}", partner_name(), options_.time_out));
  remove_from(next_);
  presence_.session = random_identity();
  presence_.run = options_.mark.run;
  if (presence_.run == "-" && options_.side == Side::continuum) presence_.run = random_identity();
  presence_.next = next_;
  presence_.kept = options_.keeps_checkpoints ? next_ : -1;
  seat_.tell(presence_);
}

FileExchange::~FileExchange() {
  if (has_parted_ || partner_session_.empty()) return;
  try {
    part(Farewell::failed, -1, "it ended before the run was complete");
  } catch (const std::exception&) {  // nobody is left to be told
  }
}

std::string FileExchange::partner_name() const {
  return options_.side == Side::bodies ? "the continuum's program" : "the bodies' program";
}

/// Own messages that another life of this side has left: they are sent anew.
void FileExchange::remove_from(std::int64_t sequence) {
  std::error_code ignored;
  oldest_ = std::max<std::int64_t>(sequence, 1);
  for (const auto& entry : fs::directory_iterator(options_.folder, ignored)) {
    const std::int64_t found = sequence_of(entry.path().filename().string(), options_.side);
    if (found >= sequence)
      fs::remove(entry.path(), ignored);
    else if (found >= 1)
      oldest_ = std::min(oldest_, found);
  }
}

/// Removes own messages before a number, but not that of the shape: a side that is resumed reads it again.
void FileExchange::remove_before(std::int64_t sequence) {
  std::error_code ignored;
  for (; oldest_ < sequence; ++oldest_) fs::remove(options_.folder / file_name(options_.side, oldest_), ignored);
}

void FileExchange::wait(Patience& patience) const {
  if (options_.stop.is_made()) throw Stopped(false, -1);
  patience.sleep();
}

void FileExchange::meet() {
  for (Patience patience;; wait(patience)) {
    const std::optional<Presence> partner = seat_.partner();
    if (partner && has_met(*partner)) return agree(*partner);
    if (patience.waited() > options_.time_out)
      throw MachineError(fmt::format("{}: {} did not come within {} s. Start it with the same folder, or wait longer",
                                     options_.folder.string(), partner_name(), options_.time_out));
  }
}

/// Both have met when each has seen the session of the other: what an older run has left knows no session of today. A partner
/// that has done its part of this very run needs not come again.
bool FileExchange::has_met(const Presence& partner) {
  const bool was_here = partner.is_done && presence_.run != "-" && partner.run == presence_.run;
  if (partner.session != presence_.partner) {
    presence_.partner = partner.session;
    seat_.tell(presence_);
  }
  return partner.partner == presence_.session || was_here;
}

void FileExchange::agree(const Presence& partner) {
  const std::string folder = options_.folder.string();
  const bool partner_knows = partner.run != "-", this_knows = presence_.run != "-";
  if (partner_knows && this_knows && partner.run != presence_.run)
    throw UserError(
        fmt::format("{}: {} belongs to another run: one side resumes a run, and the other one starts a new one or resumes "
                    "another. Resume both, or start both again",
                    folder, partner_name()));
  if (partner.next > next_ && !fs::exists(options_.folder / file_name(other(options_.side), next_)))
    throw UserError(
        fmt::format("{}: {} is ahead, and its message {} is no longer there, so this side cannot catch up. Resume both from "
                    "their checkpoints, or start both again",
                    folder, partner_name(), next_));
  if (!this_knows) {
    presence_.run = partner.run;
    seat_.tell(presence_);
  }
  partner_session_ = partner.session;
}

void FileExchange::send(Message message) {
  check_numbers(message, "this side");
  message.from = options_.side;
  message.run = presence_.run;
  message.sequence = next_;
  const Stopwatch watch(cost_);
  observe::write_file(options_.folder / file_name(options_.side, next_), encode(message), observe::Sync::system);
  ++next_;
  if (!options_.keeps_checkpoints) remove_before(next_ - 2);
}

Message FileExchange::receive(std::int64_t sequence) {
  damaged_since_ = -1;
  for (Patience patience(last_wait_);; wait(patience)) {
    if (std::optional<Message> message = look_for(sequence, patience)) {
      last_wait_ = patience.waited();
      return opened(std::move(*message));
    }
    if (patience.glance_is_due()) watch_partner(sequence, patience);
  }
}

std::optional<Message> FileExchange::look_for(std::int64_t sequence, const Patience& patience) {
  const fs::path file = options_.folder / file_name(other(options_.side), sequence);
  Stopwatch watch(cost_);
  const std::optional<std::string> bytes = read_if_there(file);
  if (!bytes) {
    watch.forget();
    return std::nullopt;
  }
  try {
    Message message = decode(*bytes, file.string());
    check_sender(message, sequence, file.string());
    return message;
  } catch (const DamagedFile& error) {
    if (damaged_since_ < 0) damaged_since_ = patience.waited();
    if (patience.waited() - damaged_since_ < grace) return std::nullopt;
    throw DamagedFile(fmt::format("{}. It should be written under a temporary name and then renamed", error.what()));
  }
}

void FileExchange::check_sender(const Message& message, std::int64_t sequence, const std::string& file) const {
  if (message.from != other(options_.side))
    throw MachineError(fmt::format("{}: has data of the {}, but those of the {} are expected", file, name_of(message.from),
                                   name_of(other(options_.side))));
  if (message.run != presence_.run)
    throw MachineError(
        fmt::format("{}: is stale: it belongs to run {}, and this is run {}. Start both sides again in an empty folder", file,
                    message.run, presence_.run));
  if (message.sequence != sequence)
    throw MachineError(fmt::format("{}: is stale: it has message {}, but {} is expected", file, message.sequence, sequence));
}

void FileExchange::watch_partner(std::int64_t sequence, const Patience& patience) {
  const std::optional<Presence> partner = seat_.partner();
  const std::string folder = options_.folder.string();
  if (partner && partner->session != partner_session_)
    throw MachineError(fmt::format("{}: {} died, and was started again. Resume this side as well", folder, partner_name()));
  const bool is_gone = partner && seat_.life_of(*partner) == Seat::Life::gone;
  const bool has_come =
      fs::exists(options_.folder / file_name(other(options_.side), sequence));  // its last message before it went
  if (is_gone && !has_come)
    throw MachineError(fmt::format("{}: {} (process {} on {}) died without notice. Resume both sides", folder, partner_name(),
                                   partner->process, partner->host));
  if (patience.waited() > options_.time_out)
    throw MachineError(fmt::format("{}: {} has sent nothing for {} s. If it needs that long, wait longer", folder, partner_name(),
                                   options_.time_out));
}

Message FileExchange::opened(Message message) const {
  if (message.kind != Kind::farewell) {
    check_numbers(message, partner_name());
    return message;
  }
  const std::string& reason = message.details.text("reason");
  if (reason == "stopped") throw Stopped(true, message.window);
  if (reason == "failed")
    throw MachineError(fmt::format("{}: {} failed: {}", options_.folder.string(), partner_name(), message.details.text("words")));
  return message;
}

Message FileExchange::own(std::int64_t sequence) const {
  const fs::path file = options_.folder / file_name(options_.side, sequence);
  const std::optional<std::string> bytes = read_if_there(file);
  if (!bytes) throw UserError(fmt::format("{}: does not exist: this is not the folder of the run", file.string()));
  return decode(*bytes, file.string());
}

void FileExchange::keep_from(std::int64_t sequence) {
  presence_.kept = sequence;
  seat_.tell(presence_);
  const std::optional<Presence> partner = seat_.partner();
  if (partner) remove_before(partner->kept < 0 ? next_ - 2 : std::min(sequence, partner->kept));
}

void FileExchange::part(Farewell reason, std::int64_t window, const std::string& words) {
  if (std::exchange(has_parted_, true) || partner_session_.empty()) return;
  Message message;
  message.kind = Kind::farewell;
  message.window = window;
  message.details.add("reason", std::string(reasons[static_cast<std::size_t>(reason)]));
  message.details.add("words", on_one_line(words));
  send(std::move(message));
  --next_;  // a run that is resumed goes on in its place
  if (reason != Farewell::done) return;
  presence_.is_done = true;
  seat_.tell(presence_);
}

}  // namespace sazare::coupling
