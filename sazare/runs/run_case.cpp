#include "sazare/runs/run_case.hpp"

#include "sazare/runs/check_blocks.hpp"

namespace sazare::runs {

RunOutcome run_case(const cases::CaseFile& file, const RunOptions& options) {
  return std::holds_alternative<cases::MpsCase>(file.content) ? run_mps(file, options) : run_blocks(file, options);
}

std::string check_case(const cases::CaseFile& file) {
  return std::holds_alternative<cases::MpsCase>(file.content) ? check_mps(file) : check_blocks(file);
}

}  // namespace sazare::runs
