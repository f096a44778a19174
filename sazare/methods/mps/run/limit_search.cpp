#include "sazare/methods/mps/run/limit_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/mps/run/model.hpp"

namespace sazare::runs {

namespace {

constexpr Real widening = 3;  // until both ends of the bracket are as they should be
constexpr int most_trials = 80;
constexpr std::int64_t check_every = 16;

template <int D>
class LimitSearch {
public:
  LimitSearch(const cases::CaseFile& file, const LimitRules& rules) : file_(file), rules_(rules), parts_(make_parts<D>(file)) {}

  FoundLimit run() {
    const auto predicted = parts_.predict();
    found_.predicted = limit_of(predicted, file_.as<cases::MpsCase>().time);
    found_.particles = parts_.particles.count;
    Real fastest = 0;
    for (const cases::Ground& ground : file_.as<cases::MpsCase>().materials) fastest = std::max(fastest, ground.p_wave_velocity);
    bracket(file_.as<cases::MpsCase>().particles.spacing / fastest);
    while (found_.unstable > rules_.ratio * found_.stable) {
      const Real step = std::sqrt(found_.stable * found_.unstable);
      (holds(step) ? found_.stable : found_.unstable) = step;
    }
    return found_;
  }

private:
  void bracket(Real center) {
    const auto try_out = [&](Real step) { (holds(step) ? found_.stable : found_.unstable) = step; };
    for (Real step = center; !(found_.stable > 0); step /= widening) try_out(step);
    for (Real step = widening * found_.stable; !(found_.unstable > 0); step *= widening) try_out(step);
  }

  bool holds(Real step) {
    if (++found_.trials > most_trials)
      throw UserError(fmt::format("{}: no stability limit was found in {} trials; the last step was {} s", file_.path.string(),
                                  most_trials, cases::short_number(step)));
    const auto& mps = file_.as<cases::MpsCase>();
    const auto stepper = parts_.stepper(mps, step, parts_.forces(mps, step));
    stepper->start();
    const Real steps = rules_.steps > 0 ? static_cast<Real>(rules_.steps) : mps.time.end / step;
    while (static_cast<Real>(stepper->steps()) < steps) {
      stepper->advance();
      if (stepper->steps() % check_every == 0 && !(stepper->largest_acceleration() < rules_.divergence)) return false;
    }
    return stepper->largest_acceleration() < rules_.divergence;
  }

  const cases::CaseFile& file_;
  const LimitRules& rules_;
  MpsParts<D> parts_;
  FoundLimit found_;
};

}  // namespace

FoundLimit find_limit(const cases::CaseFile& file, const LimitRules& rules) {
  return file.as<cases::MpsCase>().particles.dimension == 2 ? LimitSearch<2>(file, rules).run()
                                                            : LimitSearch<3>(file, rules).run();
}

}  // namespace sazare::runs
