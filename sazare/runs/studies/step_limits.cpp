#include "sazare/runs/studies/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/studies/limit_regression.hpp"

namespace sazare::runs {

namespace {

using Table = std::vector<std::vector<observe::CsvField>>;

class StepLimits final : public StudySearch {
public:
  StepLimits(const cases::Study& study, const std::filesystem::path& folder) : study_(study), folder_(folder) {}

  std::string sought() const override { return "a stability limit"; }
  bool is_for(const Method& method) const override { return method.find_limit != nullptr; }
  std::vector<std::string> columns() const override {
    return {"particles [-]", "predicted [s]", "stable [s]", "unstable [s]", "limit [s]", "trials [-]"};
  }

  std::vector<Real> find(const Method& method, const cases::CaseFile& file, std::size_t) const override {
    const FoundLimit found = method.find_limit(file, {study_.limit.ratio, study_.limit.steps, study_.limit.divergence});
    return {static_cast<Real>(found.particles), found.predicted, found.stable, found.unstable, found.limit(),
            static_cast<Real>(found.trials)};
  }

  void write_tables(std::span<const StudyRow> rows) const override {
    const std::size_t spacing = parameter("spacing"), velocity = parameter("velocity"), damping = parameter("damping");
    if (std::max({spacing, velocity, damping}) >= study_.parameters.size()) return;
    for (const std::size_t needed : {spacing, velocity})
      if (study_.parameters[needed].values.size() < 2) return;
    if (study_.parameters[damping].values.size() < 3) return;
    Table coefficients, lines;
    for (const cases::StudyFamily& family : study_.families) {
      std::vector<LimitPoint> points;
      for (const StudyRow& row : rows)
        if (row.family == family.name)
          points.push_back({0.5 * row.values[spacing], row.values[velocity], row.values[damping], row.found[limit]});
      const LimitFit fit = fit_limits(points);
      coefficients.push_back(
          {family.name, fit.b1[0], fit.b1[1], fit.b1[2], fit.b2[0], fit.b2[1], fit.b2[2], log_error(fit, points)});
      for (const DampingFit& line : fit.by_damping) lines.push_back({family.name, line.damping, line.a1, line.a2});
    }
    observe::write_csv(folder_ / "regression.csv",
                       {"family [-]", "b11 [-]", "b12 [-]", "b13 [-]", "b21 [-]", "b22 [-]", "b23 [-]", "log_error [-]"},
                       coefficients);
    observe::write_csv(folder_ / "regression_lines.csv", {"family [-]", "damping [-]", "a1 [-]", "a2 [-]"}, lines);
  }

  std::vector<std::pair<std::string, observe::Figure>> figures(std::span<const StudyRow> rows) const override {
    return {{"largest_log_difference", largest_difference(rows)}};
  }

  std::string summary(std::span<const StudyRow> rows) const override {
    return fmt::format("prediction      within {:.2f} % of the bisection in all cases\n",
                       100 * (std::exp(largest_difference(rows)) - 1));
  }

private:
  static constexpr std::size_t predicted = 1, limit = 4;  // of `found`

  std::size_t parameter(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(study_.parameters, name, &cases::StudyParameter::name) -
                                    study_.parameters.begin());
  }

  /// Of prediction and bisection, |ln|.
  static Real largest_difference(std::span<const StudyRow> rows) {
    Real largest = 0;
    for (const StudyRow& row : rows)
      if (row.found[predicted] > 0) largest = std::max(largest, std::abs(std::log(row.found[limit] / row.found[predicted])));
    return largest;
  }

  const cases::Study& study_;
  std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<StudySearch> step_limits(const cases::Study& study, const std::filesystem::path& folder) {
  return std::make_unique<StepLimits>(study, folder);
}

}  // namespace sazare::runs
