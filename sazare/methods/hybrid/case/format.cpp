#include "sazare/methods/hybrid/case/format.hpp"

#include <utility>

#include "sazare/cases/case_reader.hpp"
#include "sazare/cases/case_writer.hpp"
#include "sazare/methods/hybrid/case/fields.hpp"

namespace sazare::cases {
namespace {

/// The functions of both sides; a name that both use is one function.
std::vector<OutsideHistory> histories_of_sides(const HybridCase& hybrid) {
  std::vector<OutsideHistory> found;
  for (const auto& [side, key] : {std::pair{hybrid.continuum, "sides.continuum"}, std::pair{hybrid.bodies, "sides.bodies"}}) {
    if (!side) continue;
    for (OutsideHistory history : side->histories) {
      history.key = key;
      found.push_back(std::move(history));
    }
  }
  return found;
}

void read(const CheckContext& context, CaseFile& file) {
  HybridCase hybrid = CaseReader(context).read<HybridCase>();
  check_hybrid(context, hybrid);
  file.histories = histories_of_sides(hybrid);
  file.content = std::move(hybrid);
}

std::string write(const CaseFile& file, const std::filesystem::path& folder) {
  return write_resolved(file.as<HybridCase>(), folder);
}

}  // namespace

std::string write_resolved(const HybridCase& hybrid, const std::filesystem::path& folder) {
  return CaseWriter(hybrid_schema(), folder).write(hybrid, "hybrid");
}

CaseFormat hybrid_format() {
  return {.method = "hybrid",
          .sentence = "hybrid (a case of finite elements coupled with one of bodies)",
          .tables = hybrid_schema(),
          .read = read,
          .write = write,
          .has_sides = true};
}

}  // namespace sazare::cases
