#include "python/bindings/motion_file.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>

#include "sazare/cases/motion_file.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace sazare::python {

namespace {

/// In the order of laws::MotionQuantity.
constexpr std::array quantities{"displacement", "velocity", "acceleration"};

nb::tuple motion_file(const std::filesystem::path& path) {
  cases::Problems problems;
  const cases::Place named_at{problems.add_source({path.string(), {}, false})};
  cases::Motion motion;
  motion.file = path;
  cases::read_motion_file(motion, path.string(), named_at, problems);
  problems.throw_if_errors();
  return nb::make_tuple(quantities.at(static_cast<std::size_t>(motion.quantity)), motion.record.step, motion.record.value);
}

}  // namespace

void add_motion_file(nb::module_& module) {
  module.def(
      "motion_file", &motion_file, "path"_a,
      "A record as a case reads it (CSV, PEER, K-NET): its quantity (acceleration, velocity or displacement), the step [s] and "
      "its samples in SI units. Raises UserError.");
}

}  // namespace sazare::python
