#include "sazare/parallel/ranks.hpp"

#include <cstdlib>

#if defined(SAZARE_MPI)
#include <mpi.h>
#endif

namespace sazare::parallel {

Ranks::Ranks() = default;

#if defined(SAZARE_MPI)

Ranks::Ranks(int& argc, char**& argv) {
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
  if (finalize_) MPI_Finalize();
}

void Ranks::barrier() const {
  if (connected_) MPI_Barrier(MPI_COMM_WORLD);
}

void Ranks::abort(int exit_code) const {
  if (connected_) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

#else

Ranks::Ranks(int&, char**&) {}

Ranks::~Ranks() = default;

void Ranks::barrier() const {}

void Ranks::abort(int exit_code) const { std::_Exit(exit_code); }

#endif

}  // namespace sazare::parallel
