// Run by mpirun with the number of processes as its argument: fails unless they see each other, and sort together what each has a
// part of.

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "sazare/core/mixed_hash.hpp"
#include "sazare/parallel/places_among_ranks.hpp"
#include "sazare/parallel/ranks.hpp"

namespace {

using sazare::parallel::Ranks;

bool see_each_other(const Ranks& ranks, int size) {
  return ranks.size() == size && ranks.rank() >= 0 && ranks.rank() < ranks.size() && ranks.is_first() == (ranks.rank() == 0);
}

/// Of so many keys each rank has some that are chosen at random, the first one more than the others.
bool sort_together(const Ranks& ranks, std::uint64_t count) {
  std::vector<std::uint64_t> all, own;
  for (std::uint64_t n = 0; n < count; ++n) {
    all.push_back(sazare::mixed_hash(1, n));
    const std::uint64_t owner = sazare::mixed_hash(2, n) % static_cast<std::uint64_t>(2 * ranks.size());
    if (static_cast<int>(owner < static_cast<std::uint64_t>(ranks.size()) ? owner : 0) == ranks.rank()) own.push_back(all.back());
  }
  std::ranges::sort(all);
  const std::vector<sazare::Index> places = places_among_ranks(ranks, own, sazare::parallel::Topic::other);
  for (std::size_t n = 0; n < own.size(); ++n)
    if (all[static_cast<std::size_t>(places[n])] != own[n]) return false;
  return places.size() == own.size();
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  if (argc < 2) return EXIT_FAILURE;
  ranks.barrier();
  const bool good = see_each_other(ranks, std::atoi(argv[1])) && sort_together(ranks, 5000) && sort_together(ranks, 3) &&
                    sort_together(ranks, 0);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
