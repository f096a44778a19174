#include "python/bindings/live_simulation.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "sazare/cases/case_file.hpp"
#include "sazare/core/error.hpp"
#include "sazare/parallel/processors.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::python {

namespace {

using Clock = std::chrono::steady_clock;

std::int64_t nanoseconds() { return Clock::now().time_since_epoch().count(); }

runs::Begin begin_named(const std::string& begin) {
  if (begin == "resume") return runs::Begin::resume;
  return begin == "overwrite" ? runs::Begin::overwrite : runs::Begin::fresh;
}

cases::CaseFile read(const CaseSource& source, int threads) {
  parallel::set_threads(std::min(threads, parallel::processors()));
  return source.read();
}

}  // namespace

cases::CaseFile CaseSource::read() const {
  return text ? registry::read_case_text(*text, path, overrides) : registry::read_case(path, overrides);
}

/// Only one thread of Python at a time may work with a simulation; the engine runs without Python's lock.
class LiveSimulation::Turn {
public:
  explicit Turn(std::atomic<bool>& at_work) : at_work_(at_work) {
    if (at_work_.exchange(true))
      throw std::runtime_error("the simulation is running in another thread: wait until it has finished");
  }
  ~Turn() { at_work_ = false; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

private:
  std::atomic<bool>& at_work_;
};

LiveSimulation::LiveSimulation(const CaseSource& source, const std::filesystem::path& folder, const std::string& begin,
                               int threads, bool warns, bool takes_forces)
    : file_(read(source, threads)),
      run_(registry::open_case(
          file_, {.folder = folder, .begin = begin_named(begin), .quiet = true, .warns = warns, .takes_forces = takes_forces})),
      began_(nanoseconds()) {
  status_.title = run_->title();
  status_.words = run_->words();
  status_.end = run_->clocks().end;
  status_.steps = run_->clocks().steps();
  look();
}

/// Takes over what is told of the run.
void LiveSimulation::look() {
  status_.time = run_->time();
  status_.step = run_->step();
  now_ = run_->progress();
  if (is_watched_) run_->read_motion(motion_);
}

void LiveSimulation::begin() {
  const Turn turn(at_work_);
  run_->begin();
  look();
  first_ = now_;
  began_ = nanoseconds();
}

void LiveSimulation::walk(std::int64_t until, double seconds) {
  const Turn turn(at_work_);
  if (run_ == nullptr) throw std::runtime_error("the run has ended: create it again with resume=True to continue");
  const auto pause_at = Clock::now() + std::chrono::duration<double>(seconds);
  try {
    run_->walk(until, [&] { return Clock::now() >= pause_at; });
  } catch (...) {
    run_.reset();  // lets go of its folder, so that the run can be resumed
    throw;
  }
  look();
}

void LiveSimulation::add_samples(const std::string& name, double step, const std::vector<double>& values) {
  const Turn turn(at_work_);
  for (const cases::OutsideHistory& history : file_.histories)
    if (history.name == name) history.add(step, values);
}

void LiveSimulation::apply(std::span<const Vector3> forces, std::span<const Vector3> moments) {
  const Turn turn(at_work_);
  if (run_ != nullptr) run_->apply(forces, moments);
}

void LiveSimulation::finish() {
  const Turn turn(at_work_);
  if (run_ == nullptr) return;
  is_watched_ = true;
  look();
  run_->finish();
  run_.reset();
}

const runs::MotionTable& LiveSimulation::motion() {
  const Turn turn(at_work_);
  if (!is_watched_ && run_ != nullptr) run_->read_motion(motion_);
  is_watched_ = true;
  return motion_;
}

std::string LiveSimulation::progress_text() const {
  return runs::progress_text(first_, now_, 1e-9 * static_cast<Real>(nanoseconds() - began_));
}

}  // namespace sazare::python
