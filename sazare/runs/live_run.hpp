#pragma once

/// A case under way, whatever its method: what the command runs through, and what others walk step by step.

#include <functional>
#include <span>
#include <string>

#include "sazare/runs/motion_table.hpp"
#include "sazare/runs/progress.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// Everything here throws UserError, PhysicsError or MachineError; what was written until then can be resumed from the last
/// checkpoint.
class LiveRun {
public:
  virtual ~LiveRun() = default;

  /// To the end, or until asked to stop, with progress on the terminal.
  virtual RunOutcome run() = 0;

  /// A run in parts: first `begin`, which also resumes; then `walk` as often as wanted; last `finish`.
  virtual void begin() = 0;

  /// Until so many steps are done, or the end, or until `pause`, asked before every step, says so: then true.
  virtual bool walk(std::int64_t until, const std::function<bool()>& pause) = 0;

  /// Writes what belongs at the end; before the end a checkpoint from which the run can go on.
  virtual RunOutcome finish() = 0;

  virtual const std::string& title() const = 0;
  /// Bodies and step, in words.
  virtual std::string words() const = 0;
  virtual const RunClocks& clocks() const = 0;
  virtual std::int64_t step() const = 0;
  virtual ProgressState progress() const = 0;

  /// Where all bodies are now; the table keeps its place in memory from one call to the next.
  virtual void read_motion(MotionTable& table) = 0;

  /// Forces on the bodies from outside, in the order of `read_motion` [N; N/m in the plane]; they act from now on, until others
  /// are given. Before `begin` they act from the beginning. Moments about the centres [N m] only where the method takes such:
  /// else none. The run has been opened with RunOptions::takes_forces.
  virtual void apply(std::span<const Vector3> forces, std::span<const Vector3> moments) = 0;
  /// Throws UserError where the run takes none.
  virtual void require_forces() const = 0;

  Real time() const { return clocks().time(step()); }
  bool is_over() const { return step() >= clocks().steps(); }
};

}  // namespace sazare::runs
