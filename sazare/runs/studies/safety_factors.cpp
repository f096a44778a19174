#include "sazare/runs/studies/safety_factors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/strength_reduction.hpp"

namespace sazare::runs {

namespace {

using cases::short_number;
using Clock = std::chrono::steady_clock;
using Table = std::vector<std::vector<observe::CsvField>>;

/// The trials of one case.
class FactorSearch {
public:
  FactorSearch(const cases::Study& study, const StudyOptions& options, const Method& method, const cases::CaseFile& file,
               std::size_t number)
      : study_(study), options_(options), file_(file), number_(number), ground_(method.reduce_strength(file)) {}

  /// False when asked to stop.
  bool run() {
    const StrengthTrial elastic = ground_->try_out({.factor = {}, .stop = options_.stop});
    if (is_stopped()) return false;
    if (!elastic.stands)
      cases::refuse(file_, "gravity", "the ground does not come to rest under gravity, however strong it is: " + elastic.end,
                    "look at the boundaries that hold it, and run it without a strength");
    elastic_ = elastic.displacement;
    most_displacement_ = study_.factor.displacement_ratio.value_or(ground_->usual_displacement_ratio()) * elastic_;
    return bracket() && bisect();
  }

  /// Where the bounds do not bracket the factor it is nan.
  std::vector<Real> row() const {
    const Real factor = is_bracketed() ? std::sqrt(lower_ * upper_) : std::numeric_limits<Real>::quiet_NaN();
    return {static_cast<Real>(ground_->size()), lower_,        upper_,  factor,
            static_cast<Real>(trials_.size()),  displacement_, elastic_};
  }

  void write(const std::filesystem::path& folder) const {
    const std::string name = (folder / fmt::format("{:05}", number_)).string();
    observe::write_csv(name + ".csv", {"trial [-]", "factor [-]", "stands [-]", "displacement [m]", "seconds [s]", "end [-]"},
                       trials_);
    Table slip;
    for (const MovedGround& at : failed_)
      slip.push_back(
          {at.place[0], at.place[1], at.place[2], at.displacement[0], at.displacement[1], at.displacement[2], at.slip});
    observe::write_csv(name + "_slip.csv",
                       {"x [m]", "y [m]", "z [m]", "displacement_x [m]", "displacement_y [m]", "displacement_z [m]", "slip [-]"},
                       slip);
  }

private:
  bool is_stopped() const { return options_.stop.is_made(); }

  /// A case that is sound may not be with another strength.
  StrengthTrial trial_of(Real factor) {
    try {
      return ground_->try_out({.factor = factor, .most_displacement = most_displacement_, .stop = options_.stop});
    } catch (const UserError& refused) {
      throw UserError(fmt::format("{}\n  found in {}, with its strength divided by {}", refused.what(), name_of_case(),
                                  short_number(factor)));
    }
  }

  StrengthTrial try_out(Real factor) {
    const auto began = Clock::now();
    const StrengthTrial trial = trial_of(factor);
    if (is_stopped()) return trial;
    trials_.push_back({static_cast<std::int64_t>(trials_.size() + 1), factor, std::int64_t{trial.stands}, trial.displacement,
                       std::chrono::duration<Real>(Clock::now() - began).count(), trial.end});
    if (trial.stands) displacement_ = trial.displacement;
    if (!trial.stands) failed_ = ground_->ground();
    (trial.stands ? lower_ : upper_) = factor;
    if (!options_.quiet) {
      fmt::print("  case {}, strength over {:<7} {}: {}\n", number_, short_number(factor, 5), trial.stands ? "stands" : "fails",
                 trial.end);
      std::fflush(stdout);
    }
    return trial;
  }

  std::string name_of_case() const { return fmt::format("case {} of the study ({})", number_, file_.path.string()); }

  bool is_bracketed() const { return lower_ > 0 && std::isfinite(upper_); }

  /// The ground should stand at the lower bound and fail at the upper one. False when asked to stop.
  bool bracket() {
    const cases::StudyFactor& factor = study_.factor;
    const StrengthTrial low = try_out(factor.lower);
    if (is_stopped()) return false;
    if (!options_.quiet) fmt::print(stderr, "{}", ground_->warning());
    if (!low.stands) {
      tell_bound("factor.lower",
                 fmt::format("{} fails with its strength over the lower bound of {} already: {}", name_of_case(),
                             short_number(factor.lower), low.end),
                 "the factor of safety lies below: give a smaller lower, or the ground more strength");
      return true;
    }
    const StrengthTrial high = try_out(factor.upper);
    if (is_stopped()) return false;
    if (high.stands)
      tell_bound(
          "factor.upper",
          fmt::format("{} still stands with its strength over the upper bound of {}", name_of_case(), short_number(factor.upper)),
          "the factor of safety lies above: give a larger upper; if the ground never fails, look whether elastic "
          "ground or boundaries hold it");
    return true;
  }

  /// A bound beyond which the factor lies: an error of a single case, while a study of several goes on with the others.
  void tell_bound(const std::string& key, const std::string& what, const std::string& help) const {
    if (study_.size() == 1) cases::refuse(study_, key, what, help);
    fmt::print(stderr, "{}", cases::warning(study_, key, what, help));
  }

  bool bisect() {
    while (is_bracketed() && upper_ > study_.factor.ratio * lower_) {
      try_out(std::sqrt(lower_ * upper_));
      if (is_stopped()) return false;
    }
    return true;
  }

  const cases::Study& study_;
  const StudyOptions& options_;
  const cases::CaseFile& file_;
  std::size_t number_;
  std::unique_ptr<StrengthReduction> ground_;
  Real elastic_ = 0, most_displacement_ = 0;  ///< [m]
  Real lower_ = 0, upper_ = std::numeric_limits<Real>::infinity();
  Real displacement_ = 0;  ///< of the last trial that stood [m]
  Table trials_;
  std::vector<MovedGround> failed_;  ///< at the end of the last trial that failed
};

class SafetyFactors final : public StudySearch {
public:
  SafetyFactors(const cases::Study& study, const StudyOptions& options) : study_(study), options_(options) {}

  std::string sought() const override { return "a factor of safety"; }
  bool is_for(const Method& method) const override { return method.reduce_strength != nullptr; }
  std::vector<std::string> columns() const override {
    return {"bodies [-]", "lower [-]", "upper [-]", "factor [-]", "trials [-]", "displacement [m]", "elastic [m]"};
  }

  void check(const Method& method, const cases::CaseFile& file) const override { method.reduce_strength(file); }

  std::vector<Real> find(const Method& method, const cases::CaseFile& file, std::size_t number) const override {
    FactorSearch search(study_, options_, method, file, number);
    if (!search.run()) return {};
    std::filesystem::create_directories(options_.folder / "trials");
    search.write(options_.folder / "trials");
    return search.row();
  }

  std::vector<std::pair<std::string, observe::Figure>> figures(std::span<const StudyRow> rows) const override {
    const std::vector<Real> factors = found_factors(rows);
    if (factors.empty()) return {};
    const auto [least, most] = std::ranges::minmax(factors);
    return {{"smallest_factor", least}, {"largest_factor", most}};
  }

  std::string summary(std::span<const StudyRow> rows) const override {
    const std::vector<Real> factors = found_factors(rows);
    std::string text;
    if (!factors.empty()) {
      const auto [least, most] = std::ranges::minmax(factors);
      text = fmt::format("factor of safety {}", short_number(least, 4));
      if (factors.size() > 1) text += fmt::format(" to {}", short_number(most, 4));
      text += fmt::format(", bounds within {:.2g} %\n", 100 * (study_.factor.ratio - 1));
    }
    if (const std::size_t missed = rows.size() - factors.size(); missed > 0)
      text +=
          fmt::format("{} of {} cases have a factor below lower or above upper; study.csv has nan for it\n", missed, rows.size());
    return text;
  }

private:
  static constexpr std::size_t factor = 3;  // of `found`

  static std::vector<Real> found_factors(std::span<const StudyRow> rows) {
    std::vector<Real> factors;
    for (const StudyRow& row : rows)
      if (std::isfinite(row.found[factor])) factors.push_back(row.found[factor]);
    return factors;
  }

  const cases::Study& study_;
  const StudyOptions& options_;
};

}  // namespace

std::unique_ptr<StudySearch> safety_factors(const cases::Study& study, const StudyOptions& options) {
  return std::make_unique<SafetyFactors>(study, options);
}

}  // namespace sazare::runs
