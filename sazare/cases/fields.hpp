#pragma once

#include <array>
#include <string_view>

#include "sazare/cases/format/enum_words.hpp"
#include "sazare/cases/tables.hpp"

/// Which member of a table belongs to which key: written once, used by the reader and by the writer of
/// resolved cases. The tables of a method have theirs in the method's own fields.hpp, which ends with
/// visit_tables(visitor, case): visit.one(table, member) for [table], visit.list(table, members) for [[table]].
///
/// A visitor is called as visit(key, member) and answers visit.has(key, member's own answer): the reader says
/// whether the file gives the key, the writer whether the case holds it.
namespace sazare::cases {

template <>
struct EnumWords<MotionShape> {
  static constexpr std::array<std::string_view, 4> words{"ricker", "sine", "record", "function"};
};

template <>
struct EnumWords<laws::MotionQuantity> {
  static constexpr std::array<std::string_view, 3> words{"displacement", "velocity", "acceleration"};
};

template <>
struct EnumWords<Baseline> {
  static constexpr std::array<std::string_view, 3> words{"none", "constant", "linear"};
};

template <>
struct EnumWords<Integrator> {
  static constexpr std::array<std::string_view, 3> words{"verlet", "leapfrog", "euler"};
};

template <class Visitor>
void visit_fields(Visitor& visit, Damping& damping) {
  if (visit.has("f1", damping.f1 > 0)) visit("f1", damping.f1);
  if (visit.has("f2", damping.f2 > 0)) visit("f2", damping.f2);
  visit("relative_to_base", damping.relative_to_base);
}

/// Keys of what follows motions along its axes.
inline constexpr std::array<std::string_view, 3> motion_name_keys{"motion_x", "motion_y", "motion_z"};

/// Names of motions by axis, empty where there is none.
template <class Visitor, std::size_t Axes>
void visit_motion_names(Visitor& visit, std::array<std::string, Axes>& names) {
  for (std::size_t axis = 0; axis < Axes; ++axis)
    if (visit.has(motion_name_keys[axis], !names[axis].empty())) visit(motion_name_keys[axis], names[axis]);
}

template <class Visitor>
void visit_fields(Visitor& visit, Motion& motion) {
  visit("name", motion.name);
  visit("type", motion.type);
  visit("amplitude", motion.amplitude);
  if (motion.type == MotionShape::record) {
    visit("file", motion.file);
    visit("baseline", motion.baseline);
    return;
  }
  visit("quantity", motion.quantity);
  if (motion.type == MotionShape::function) return;
  visit("frequency", motion.frequency);
  if (motion.type == MotionShape::ricker)
    visit("peak_time", motion.peak_time);
  else
    visit("cycles", motion.cycles);
}

template <class Visitor>
void visit_fields(Visitor& visit, UniformTime& time) {
  visit("end", time.end);
  visit("step", time.step);
  visit("stability_fraction", time.stability_fraction);
  visit("integrator", time.integrator);
  visit("history_interval", time.history_interval);
  visit("snapshot_interval", time.snapshot_interval);
  visit("strict", time.strict);
}

template <class Visitor>
void visit_fields(Visitor& visit, LeapfrogTime& time) {
  visit("end", time.end);
  visit("step", time.step);
  visit("stability_fraction", time.stability_fraction);
  visit("history_interval", time.history_interval);
  visit("snapshot_interval", time.snapshot_interval);
  visit("strict", time.strict);
}

template <class Visitor>
void visit_fields(Visitor& visit, Mesh& mesh) {
  visit("file", mesh.file);
  visit("scale", mesh.scale);
  if (!mesh.is_geometry()) return;
  visit("size_factor", mesh.size_factor);
  visit("parameters", mesh.parameters);
}

template <class Visitor>
void visit_fields(Visitor& visit, Gravity& gravity) {
  visit("acceleration", gravity.acceleration);
}

template <class Visitor>
void visit_fields(Visitor& visit, Gauge& gauge) {
  visit("name", gauge.name);
  visit("point", gauge.point);
}

template <class Visitor>
void visit_fields(Visitor& visit, Output& output) {
  visit("checkpoint_interval", output.checkpoint_interval);
}

}  // namespace sazare::cases
