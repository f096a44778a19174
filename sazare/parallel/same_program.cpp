#include "sazare/parallel/same_program.hpp"

#include <fmt/format.h>

#include "sazare/core/error.hpp"
#include "sazare/core/lanes.hpp"
#include "sazare/core/version.hpp"

namespace sazare::parallel {

std::string build_identity() {
#ifdef __FMA__
  constexpr const char* products = "fused multiplication and addition";
#else
  constexpr const char* products = "no fused multiplication and addition";
#endif
  return fmt::format("version {}, commit {}, compiler {}, vectors of {} numbers, {}", version, commit, __VERSION__, lane_count,
                     products);
}

std::string different_programs(const std::vector<std::string>& identity_by_rank) {
  std::string text;
  for (std::size_t rank = 1; rank < identity_by_rank.size(); ++rank)
    if (identity_by_rank[rank] != identity_by_rank.front()) text += fmt::format("\n  rank {}: {}", rank, identity_by_rank[rank]);
  return text.empty() ? text : fmt::format("\n  rank 0: {}{}", identity_by_rank.front(), text);
}

void require_same_program(const Ranks& ranks) {
  if (ranks.size() == 1) return;
  const std::string own = build_identity();
  const Gathered all = ranks.gather(std::as_bytes(std::span(own)), Topic::other);
  std::vector<std::string> identities;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const auto bytes = all.of(rank);
    identities.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  const std::string differences = different_programs(identities);
  if (!differences.empty())
    throw UserError(fmt::format(
        "the ranks run different builds of sazare, which would not compute the same numbers:{}\nstart the same program "
        "everywhere: where processors differ, one that is built with -DSAZARE_NATIVE=OFF",
        differences));
}

}  // namespace sazare::parallel
