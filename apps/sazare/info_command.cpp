#include <fmt/format.h>

#include <thread>

#include "apps/sazare/commands.hpp"
#include "sazare/core/version.hpp"
#include "sazare/levels/distribute/partition.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::command {

namespace {

std::string mpi_text([[maybe_unused]] const parallel::Ranks& ranks) {
#if defined(SAZARE_MPI)
  return fmt::format("yes, {} process{} now", ranks.size(), ranks.size() == 1 ? "" : "es");
#else
  return "no (build the preset mpi for it)";
#endif
}

}  // namespace

int info(const parallel::Ranks& ranks) {
  const observe::Machine machine = observe::this_machine();
  fmt::print("sazare    {}\n", version);
  fmt::print("commit    {}\n", commit);
  fmt::print("compiler  GCC {}, {} build\n", __VERSION__, SAZARE_BUILD_TYPE);
  fmt::print("machine   {}, {} processors\n", machine.cpu, machine.cores);
  fmt::print("threads   {}\n", machine.threads);
  fmt::print("MPI       {}\n", mpi_text(ranks));
  fmt::print("METIS     {}\n", distribute::has_graph_partition() ? "yes" : "no (install libmetis-dev and build again for it)");
  return done;
}

}  // namespace sazare::command
