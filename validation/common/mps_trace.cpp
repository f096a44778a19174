#include "validation/common/mps_trace.hpp"

#include <cmath>
#include <limits>

#include "sazare/methods/mps/case/case.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::validation {

Trace trace_gauges(const std::string& path, const std::vector<std::string>& overrides, std::size_t axis, int every) {
  const cases::CaseFile file = registry::read_case(path, overrides);
  const runs::MpsModel<2> model = runs::build_mps<2>(file);
  std::vector<std::size_t> particles;
  for (const cases::Gauge& gauge : file.as<cases::MpsCase>().gauges) {
    std::size_t nearest = 0;
    Real shortest = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < model.filling.sites.size(); ++i)
      if (const Real distance = (model.filling.place(i) - gauge.point.head<2>()).norm(); distance < shortest - 1e-9) {
        shortest = distance;
        nearest = i;
      }
    particles.push_back(nearest);
  }
  Trace trace{every * model.step, std::vector<std::vector<Real>>(particles.size()),
              std::vector<std::vector<Real>>(particles.size())};
  const auto record = [&] {
    const auto acceleration = model.stepper->acceleration();
    for (std::size_t gauge = 0; gauge < particles.size(); ++gauge) {
      trace.displacement[gauge].push_back(model.stepper->particles().displacement[axis][particles[gauge]]);
      trace.acceleration[gauge].push_back(acceleration[axis][particles[gauge]]);
    }
  };
  const auto steps = static_cast<std::int64_t>(std::llround(file.as<cases::MpsCase>().time.end / model.step));
  model.stepper->start();
  record();
  while (model.stepper->steps() < steps) {
    model.stepper->advance();
    if (model.stepper->steps() % every == 0) record();
  }
  return trace;
}

}  // namespace sazare::validation
