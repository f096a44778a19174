#pragma once

#include <nanobind/nanobind.h>

namespace sazare::python {

/// Adds `mesh_file`, which reads a Gmsh mesh for pictures of its groups.
void add_mesh_file(nanobind::module_& module);

}  // namespace sazare::python
