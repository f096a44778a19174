#include "sazare/runs/run_case.hpp"

#include "sazare/cases/outside_histories.hpp"
#include "sazare/runs/check_blocks.hpp"

namespace sazare::runs {

std::unique_ptr<LiveRun> open_case(const cases::CaseFile& file, const RunOptions& options) {
  if (std::holds_alternative<cases::MpsCase>(file.content)) return open_mps(file, options);
  if (std::holds_alternative<cases::RectanglesCase>(file.content)) return open_rectangles(file, options);
  if (std::holds_alternative<cases::SpheresCase>(file.content)) return open_spheres(file, options);
  if (std::holds_alternative<cases::FemCase>(file.content)) return open_fem(file, options);
  if (std::holds_alternative<cases::HybridCase>(file.content)) return open_hybrid(file, options);
  return open_blocks(file, options);
}

RunOutcome run_case(const cases::CaseFile& file, const RunOptions& options) {
  cases::refuse_outside_histories(file);
  return open_case(file, options)->run();
}

std::string check_case(const cases::CaseFile& file) {
  if (std::holds_alternative<cases::MpsCase>(file.content)) return check_mps(file);
  if (std::holds_alternative<cases::RectanglesCase>(file.content)) return check_rectangles(file);
  if (std::holds_alternative<cases::SpheresCase>(file.content)) return check_spheres(file);
  if (std::holds_alternative<cases::FemCase>(file.content)) return check_fem(file);
  if (std::holds_alternative<cases::HybridCase>(file.content)) return check_hybrid(file);
  return check_blocks(file);
}

}  // namespace sazare::runs
