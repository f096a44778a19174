#include <set>

#include "sazare/parallel/threads.hpp"
#include "sazare/runs/state_hash.hpp"
#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

int main() {
  using namespace sazare;
  std::set<std::uint64_t> hashes;
  Real broken = 0;
  int levels = 0;
  for (const int threads : {1, 2, 4}) {
    parallel::set_threads(threads);
    auto model = validation::started_blast({});
    validation::advance_to(model, 1e-4);
    hashes.insert(runs::state_hash(model));
    broken = model.joints->broken_count();
    const auto [lowest, highest] = validation::level_range(*model.simulation);
    levels = highest - lowest;
  }
  validation::print_row("hashes", static_cast<Real>(hashes.size()));
  validation::print_row("broken", broken);
  validation::print_row("levels", levels);
}
