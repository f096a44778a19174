// Run by mpirun with the number of processes as its argument: fails unless they see each other.

#include <cstdlib>

#include "sazare/parallel/ranks.hpp"

int main(int argc, char** argv) {
  const sazare::parallel::Ranks ranks(argc, argv);
  if (argc < 2) return EXIT_FAILURE;
  ranks.barrier();
  const bool good = ranks.size() == std::atoi(argv[1]) && ranks.rank() >= 0 && ranks.rank() < ranks.size() &&
                    ranks.is_first() == (ranks.rank() == 0);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
