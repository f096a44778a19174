#include "sazare/parallel/ranks.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "sazare/core/error.hpp"

#if defined(SAZARE_MPI)
#include <mpi.h>
#endif

namespace sazare::parallel {

namespace {

/// Whether a launcher has started this process, and for Open MPI as one of several.
bool is_launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

}  // namespace

Sent Traffic::total() const {
  Sent all;
  for (const Sent& about : sent) {
    all.bytes += about.bytes;
    all.messages += about.messages;
  }
  return all;
}

Ranks::Ranks() = default;

/// Enters messages, each of so many bytes.
void Ranks::count(Topic topic, std::size_t bytes, int messages) const {
  Sent& sent = traffic_.sent[static_cast<std::size_t>(topic)];
  sent.bytes += static_cast<std::int64_t>(bytes) * messages;
  sent.messages += messages;
}

#if defined(SAZARE_MPI)

namespace {

constexpr std::size_t largest_part = std::size_t{1} << 30;  // MPI counts in int: more goes in several rounds

int count_of(std::size_t bytes) { return static_cast<int>(bytes); }

}  // namespace

/// Waits for requests of MPI: looks often, then rarely.
class Ranks::Wait {
public:
  explicit Wait(const Ranks& ranks) : ranks_(&ranks), begin_(Clock::now()) {}
  ~Wait() { ranks_->traffic_.seconds += seconds_since(begin_); }
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  void operator()(std::span<MPI_Request> requests) {
    static const bool crowded = ranks_->size_ > static_cast<int>(std::thread::hardware_concurrency());
    const int eager = crowded ? 1 : 2000;
    for (int round = 0;; ++round) {
      int done = 0;
      MPI_Testall(count_of(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
      if (done != 0) return;
      if (round < eager) continue;
      if (round < eager + 200)
        sched_yield();
      else
        usleep(20);
      look_out();
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

  /// A launcher gives those that are left about a second.
  void look_out() {
    if (ranks_->asked_to_end_ == nullptr || !ranks_->asked_to_end_->load(std::memory_order_relaxed)) return;
    if (asked_ == Clock::time_point{}) asked_ = Clock::now();
    if (seconds_since(asked_) < 0.3) return;
    ranks_->lost_ = true;
    throw MachineError("another process of the run has ended, or does not answer");
  }

  const Ranks* ranks_;
  Clock::time_point begin_, asked_;
};

Ranks::Ranks(int& argc, char**& argv) {
  if (!is_launched()) return;
  int started = 0;
  MPI_Initialized(&started);
  if (started == 0) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    finalize_ = true;
  }
  connected_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  if (lost_) abort(MachineError::exit_code);
  if (finalize_) MPI_Finalize();
}

void Ranks::barrier() const {
  if (size_ == 1) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  Wait wait(*this);
  wait({&request, 1});
}

Gathered Ranks::gather(std::span<const std::byte> own, Topic topic, To to) const {
  const auto n = static_cast<std::size_t>(size_);
  Gathered gathered{{}, std::vector<std::size_t>(n + 1, 0)};
  if (size_ == 1) {
    gathered.bytes.assign(own.begin(), own.end());
    gathered.begin[1] = own.size();
    return gathered;
  }
  const std::uint64_t size = own.size();
  std::vector<std::uint64_t> sizes(n);
  {
    Wait wait(*this);
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request);
    wait({&request, 1});
  }
  const std::size_t part = largest_part / n, largest = *std::max_element(sizes.begin(), sizes.end());
  const bool keeps_all = to == To::all || is_first();
  for (std::size_t rank = 0; rank < n; ++rank)
    gathered.begin[rank + 1] = gathered.begin[rank] + (keeps_all || static_cast<int>(rank) == rank_ ? sizes[rank] : 0);
  gathered.bytes.resize(gathered.begin.back());
  count(topic, own.size(), to == To::all ? size_ - 1 : is_first() ? 0 : 1);
  for (std::size_t done = 0; done < largest; done += part) gather_round(gathered, own, to, done, part);
  if (!keeps_all) std::ranges::copy(own, gathered.bytes.begin());
  return gathered;
}

/// The bytes of every rank from `done` on, a part at most.
void Ranks::gather_round(Gathered& gathered, std::span<const std::byte> own, To to, std::size_t done, std::size_t part) const {
  const auto n = static_cast<std::size_t>(size_);
  const auto left = [&](std::size_t of) { return of > done ? std::min(part, of - done) : 0; };
  std::vector<int> counts(n), places(n);
  std::size_t total = 0;
  for (std::size_t rank = 0; rank < n; ++rank) {
    counts[rank] = count_of(left(gathered.of(static_cast<int>(rank)).size()));
    places[rank] = count_of(total);
    total += static_cast<std::size_t>(counts[rank]);
  }
  const bool at_once = done == 0 && total == gathered.bytes.size();  // then it lies where it belongs already
  std::vector<std::byte> round(at_once ? 0 : total);
  std::byte* const into = at_once ? gathered.bytes.data() : round.data();
  const std::byte* const from = own.data() + (left(own.size()) > 0 ? done : 0);
  const int mine = count_of(left(own.size()));
  Wait wait(*this);
  MPI_Request request = MPI_REQUEST_NULL;
  if (to == To::all)
    MPI_Iallgatherv(from, mine, MPI_BYTE, into, counts.data(), places.data(), MPI_BYTE, MPI_COMM_WORLD, &request);
  else
    MPI_Igatherv(from, mine, MPI_BYTE, into, counts.data(), places.data(), MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  wait({&request, 1});
  for (std::size_t rank = 0; !at_once && rank < n; ++rank)
    std::copy_n(round.begin() + places[rank], counts[rank],
                gathered.bytes.begin() + static_cast<std::ptrdiff_t>(gathered.begin[rank] +
                                                                     std::min(done, gathered.of(static_cast<int>(rank)).size())));
}

std::int64_t Ranks::from_first(std::int64_t number) const {
  if (size_ == 1) return number;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&number, 1, MPI_INT64_T, 0, MPI_COMM_WORLD, &request);
  Wait wait(*this);
  wait({&request, 1});
  return number;
}

void Ranks::exchange(const std::vector<Message>& sent, std::vector<Message>& received, Topic topic) const {
  if (sent.empty() && received.empty()) return;  // a process alone has not begun MPI
  Wait wait(*this);
  std::vector<MPI_Request> requests;
  const auto for_parts = [&](std::size_t size, auto&& begin_part) {  // they arrive in the order in which they are sent
    for (std::size_t done = 0; done < size; done += largest_part)
      begin_part(done, count_of(std::min(largest_part, size - done)), &requests.emplace_back(MPI_REQUEST_NULL));
  };
  for (Message& message : received)
    for_parts(message.bytes.size(), [&](std::size_t at, int count, MPI_Request* request) {
      MPI_Irecv(message.bytes.data() + at, count, MPI_BYTE, message.rank, 0, MPI_COMM_WORLD, request);
    });
  for (const Message& message : sent) {
    if (message.bytes.empty()) continue;
    for_parts(message.bytes.size(), [&](std::size_t at, int bytes, MPI_Request* request) {
      MPI_Isend(message.bytes.data() + at, bytes, MPI_BYTE, message.rank, 0, MPI_COMM_WORLD, request);
    });
    count(topic, message.bytes.size(), 1);
  }
  wait(requests);
}

void Ranks::abort(int exit_code) const {
  if (connected_) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

#else

Ranks::Ranks(int&, char**&) {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (is_launched() && (size == nullptr || std::string(size) != "1"))
    throw UserError(
        "this sazare is built without MPI and cannot be one of several processes: do not use mpirun, or build it with `make "
        "build` where Open MPI is installed");
}

Ranks::~Ranks() = default;

void Ranks::barrier() const {}

Gathered Ranks::gather(std::span<const std::byte> own, Topic, To) const { return {{own.begin(), own.end()}, {0, own.size()}}; }

std::int64_t Ranks::from_first(std::int64_t number) const { return number; }

void Ranks::exchange(const std::vector<Message>&, std::vector<Message>&, Topic) const {}

void Ranks::abort(int exit_code) const { std::_Exit(exit_code); }

#endif

}  // namespace sazare::parallel
