#pragma once

#include <nanobind/nanobind.h>

namespace sazare::python {

/// Adds `motion_file`, which reads the record of a motion as a case does.
void add_motion_file(nanobind::module_& module);

}  // namespace sazare::python
