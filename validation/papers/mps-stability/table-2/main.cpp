#include <fmt/format.h>

#include "sazare/cases/study_file.hpp"
#include "sazare/methods/mps/run/model.hpp"
#include "sazare/parallel/tasks.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/studies/limit_regression.hpp"
#include "validation/common/rows.hpp"

int main() {
  using namespace sazare;
  const cases::Study study = cases::read_study("cases/stability-study/study.toml");
  std::vector<runs::LimitPoint> points(study.size());
  parallel::run_tasks(study.size(), 1, [&](std::size_t i) {
    const cases::CaseFile file = registry::read_case(study.family(i).file, study.overrides(i));
    const std::vector<Real> values = study.values(i);
    points[i] = {0.5 * values[0], values[1], values[2], runs::make_parts<2>(file).predict().verlet};
  });
  const std::span<const runs::LimitPoint> all(points);
  const std::size_t half = points.size() / 2;
  for (const auto& [name, own, paper] :
       {std::tuple{"s", all.first(half), &runs::paper_shear_fit}, {"p", all.last(half), &runs::paper_pressure_fit}}) {
    const runs::LimitFit fit = runs::fit_limits(own);
    for (int i = 0; i < 3; ++i) {
      const auto term = static_cast<std::size_t>(i);
      validation::print_row(fmt::format("{}-b1{}", name, i + 1).c_str(), fit.b1[term], paper->b1[term]);
      validation::print_row(fmt::format("{}-b2{}", name, i + 1).c_str(), fit.b2[term], paper->b2[term]);
    }
    validation::print_row(fmt::format("{}-error", name).c_str(), runs::log_error(fit, own));
    validation::print_row(fmt::format("{}-paper-error", name).c_str(), runs::log_error(*paper, own));
  }
}
