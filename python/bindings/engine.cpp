/// The module sazare._engine: the engine as Python sees it. What users call stands in python/sazare.

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "python/bindings/live_simulation.hpp"
#include "python/bindings/mesh_file.hpp"
#include "python/bindings/motion_file.hpp"
#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/schema.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/version.hpp"
#include "sazare/laws/explosives.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/registry/registry.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace sazare::python {

namespace {

using Rows = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>, nb::c_contig>;
using ReleaseLock = nb::call_guard<nb::gil_scoped_release>;
using runs::MotionTable;

/// Rows of the simulation as numpy sees them where they lie; the array keeps the simulation alive.
template <std::vector<Vector3> MotionTable::*column>
Rows rows(nb::handle_t<LiveSimulation> self) {
  const std::vector<Vector3>& found = nb::cast<LiveSimulation&>(self).motion().*column;
  return Rows(found.empty() ? nullptr : found.front().data(), {found.size(), 3}, self);
}

/// Names of the histories that the case leaves to its caller, each with the time at which its own is 0 [s].
std::vector<std::pair<std::string, double>> functions(const LiveSimulation& self) {
  std::vector<std::pair<std::string, double>> found;
  for (const cases::OutsideHistory& history : self.file().histories)
    found.emplace_back(history.name, history.begin);
  return found;
}

std::vector<Vector3> vectors_of(const Rows& rows) {
  std::vector<Vector3> vectors(rows.shape(0));
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Vector3(rows.data() + 3 * i);
  return vectors;
}

void apply(LiveSimulation& self, const Rows& forces, const std::optional<Rows>& moments) {
  self.apply(vectors_of(forces), moments ? vectors_of(*moments) : std::vector<Vector3>());
}

std::string resolved(const CaseSource& source) {
  return registry::write_resolved(source.read());
}

/// The explosives that a charge may name: density [kg/m3], velocity of the detonation [m/s], energy [J/kg].
nb::dict explosives() {
  nb::dict found;
  for (const laws::Explosive& explosive : laws::explosives)
    found[std::string(explosive.name).c_str()] =
        nb::make_tuple(explosive.density, explosive.velocity, explosive.energy / explosive.density);
  return found;
}

std::string check(const CaseSource& source) {
  const cases::CaseFile file = source.read();
  return registry::check_case(file) + file.warnings;
}

void add_errors(nb::module_& module) {
  nb::exception<UserError>(module, "UserError").attr("__doc__") =
      "An error that the user can correct: in the case, its mesh or tables, or an argument. The message is that of the command.";
  nb::exception<PhysicsError>(module, "PhysicsError").attr("__doc__") =
      "The simulated physics failed: a number that is not finite, a step above its limit. The last checkpoint is kept.";
  nb::exception<MachineError>(module, "MachineError").attr("__doc__") =
      "The machine failed: disk full, folder not writable. The run can be resumed.";
}

void add_simulation(nb::module_& module) {
  nb::class_<LiveSimulation>(module, "LiveSimulation", "A running case; users see it as sazare.Simulation.")
      .def(nb::init<const CaseSource&, const std::filesystem::path&, const std::string&, int, bool, bool>(), "source"_a,
           "folder"_a, "begin"_a, "threads"_a, "warns"_a = true, "takes_forces"_a = false, ReleaseLock())
      .def("begin", &LiveSimulation::begin, ReleaseLock())
      .def("walk", &LiveSimulation::walk, "until"_a, "seconds"_a, ReleaseLock())
      .def("finish", &LiveSimulation::finish, ReleaseLock())
      .def("add_samples", &LiveSimulation::add_samples, "name"_a, "step"_a, "values"_a)
      .def("apply", &apply, "forces"_a, "moments"_a = nb::none())
      .def("require_forces", &LiveSimulation::require_forces)
      .def("progress_text", &LiveSimulation::progress_text)
      .def_prop_ro("title", [](const LiveSimulation& self) { return self.status().title; })
      .def_prop_ro("words", [](const LiveSimulation& self) { return self.status().words; })
      .def_prop_ro("warnings", [](const LiveSimulation& self) { return self.file().warnings; })
      .def_prop_ro("functions", &functions)
      .def_prop_ro("time", [](const LiveSimulation& self) { return self.status().time; })
      .def_prop_ro("step", [](const LiveSimulation& self) { return self.status().step; })
      .def_prop_ro("steps", [](const LiveSimulation& self) { return self.status().steps; })
      .def_prop_ro("end", [](const LiveSimulation& self) { return self.status().end; })
      .def_prop_ro("positions", &rows<&MotionTable::position>)
      .def_prop_ro("velocities", &rows<&MotionTable::velocity>)
      .def_prop_ro("forces", &rows<&MotionTable::force>);
}

}  // namespace

NB_MODULE(_engine, module) {
  module.doc() = "The engine of Sazare. Use the package sazare, which wraps it.";
  module.attr("version") = version;
  module.attr("commit") = commit;
  add_errors(module);
  nb::class_<CaseSource>(module, "CaseSource", "A case as text or file, with overrides such as \"time.end=1e-4\".")
      .def(
          "__init__",
          [](CaseSource* self, std::optional<std::string> text, std::filesystem::path path, std::vector<std::string> overrides) {
            new (self) CaseSource{std::move(text), std::move(path), std::move(overrides)};
          },
          "text"_a.none(), "path"_a, "overrides"_a = std::vector<std::string>());
  add_simulation(module);
  add_mesh_file(module);
  add_motion_file(module);
  module.def("resolved", &resolved, "source"_a, ReleaseLock(), "The case as TOML with every key and default written out.");
  module.def("check", &check, "source"_a, ReleaseLock(), "What the case will do, in words.");
  module.def("explosives", &explosives,
             "Density [kg/m3], velocity [m/s] and energy [J/kg] of every explosive of the table, by name.");
  module.def("schema_json", &registry::schema_json, "The schema of the case file, as JSON.");
}

}  // namespace sazare::python
