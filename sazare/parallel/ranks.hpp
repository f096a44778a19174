#pragma once

namespace sazare::parallel {

/// The processes that run one case together: one, or those of an MPI launch when Sazare was built with MPI.
///
/// One object per process, made at the start of main and destroyed at its end.
class Ranks {
public:
  /// Joins the processes of the launch. argc and argv may be changed by MPI.
  Ranks(int& argc, char**& argv);
  /// One process, whatever started it.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// This process, 0..size()-1.
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }

  /// Returns when all processes have called it.
  void barrier() const;

  /// Ends all processes at once with this exit code; nothing is flushed.
  [[noreturn]] void abort(int exit_code) const;

private:
  int rank_ = 0;
  int size_ = 1;
  bool connected_ = false;  ///< this object speaks for a process of the launch
  bool finalize_ = false;   ///< this object started MPI and ends it
};

}  // namespace sazare::parallel
