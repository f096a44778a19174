#include "sazare/coupling/surface_messages.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sazare::coupling {

namespace {

std::string force_unit(const SurfaceShape& shape) { return shape.dimension == 2 ? "N/m" : "N"; }

std::string file_of(const Message& message) { return file_name(message.from, message.sequence).string(); }

void check_kind(const Message& message, Kind awaited) {
  if (message.kind == awaited) return;
  throw UserError(fmt::format("{}: is a message of kind '{}', but one of kind '{}' is expected: the partner is out of step",
                              file_of(message), name_of(message.kind), name_of(awaited)));
}

/// The numbers of a table with a row for every node.
std::vector<Real> take(Message& message, const char* name, const std::string& unit, const SurfaceShape& shape) {
  std::vector<Real>& values = message.table(name, shape.dimension, unit).values;
  if (values.size() != shape.nodes.size())
    throw UserError(fmt::format("{}: the surfaces do not match: '{}' has {} rows, and the surface has {} nodes", file_of(message),
                                name, values.size() / static_cast<std::size_t>(shape.dimension),
                                shape.nodes.size() / static_cast<std::size_t>(shape.dimension)));
  return std::move(values);
}

template <class Contents>
Message begin(Kind kind, const Contents& contents) {
  Message message;
  message.kind = kind;
  message.window = contents.window;
  message.pass = contents.pass;
  message.time = contents.time;
  return message;
}

template <class Contents>
Contents begin(const Message& message) {
  Contents contents;
  contents.window = message.window;
  contents.pass = message.pass;
  contents.time = message.time;
  return contents;
}

[[noreturn]] void refuse(const std::string& words) { throw UserError("the surface cannot be used: " + words); }

/// Face numbers are few and small, and exact as numbers of any kind: one kind is enough for all readers.
std::vector<std::int32_t> whole_numbers(const std::vector<Real>& values) {
  std::vector<std::int32_t> whole;
  whole.reserve(values.size());
  for (const Real value : values) {
    if (!(std::abs(value) < 2147483648.0) || value != std::floor(value)) refuse(fmt::format("'{}' is not a node number", value));
    whole.push_back(static_cast<std::int32_t>(value));
  }
  return whole;
}

template <class T>
void compare(const std::vector<T>& expected, const std::vector<T>& got, const char* what, int columns, const std::string& where) {
  const auto rows = static_cast<std::size_t>(columns);
  if (expected.size() != got.size())
    throw UserError(fmt::format("{}: the surfaces do not match: {} {}, and {} are expected", where, got.size() / rows, what,
                                expected.size() / rows));
  for (std::size_t i = 0; i < got.size(); ++i)
    if (expected[i] != got[i])
      throw UserError(fmt::format("{}: the surfaces do not match: number {} of the {} has {} in column {}, and {} is expected",
                                  where, i / rows, what, got[i], i % rows, expected[i]));
}

void compare(Real expected, Real got, const char* what, const std::string& where) {
  if (expected != got)
    throw UserError(fmt::format("{}: the surfaces do not match: its {} is {}, and {} is expected", where, what, got, expected));
}

}  // namespace

Message to_message(const SurfaceShape& shape) {
  Message message;
  message.kind = Kind::shape;
  message.window = -1;
  message.details.add_count("dimension", shape.dimension);
  message.details.add_number("width", shape.width);
  message.details.add_number("window_length", shape.window);
  message.tables = {{"nodes", shape.dimension, "m", shape.nodes},
                    {"faces", shape.dimension, "1", std::vector<Real>(shape.faces.begin(), shape.faces.end())}};
  return message;
}

Message to_message(const SurfaceMotion& motion, const SurfaceShape& shape) {
  Message message = begin(Kind::motion, motion);
  message.tables = {{"displacement", shape.dimension, "m", motion.displacement},
                    {"velocity", shape.dimension, "m/s", motion.velocity}};
  return message;
}

Message to_message(const SurfaceForce& force, const SurfaceShape& shape) {
  Message message = begin(Kind::force, force);
  message.tables = {{"mean", shape.dimension, force_unit(shape), force.mean},
                    {"last", shape.dimension, force_unit(shape), force.last}};
  return message;
}

SurfaceShape to_shape(Message message) {
  check_kind(message, Kind::shape);
  SurfaceShape shape;
  const std::int64_t dimension = message.details.count("dimension");
  if (dimension != 2 && dimension != 3) refuse(fmt::format("it has {} dimensions", dimension));
  shape.dimension = static_cast<int>(dimension);
  shape.width = message.details.number("width");
  shape.window = message.details.number("window_length");
  shape.nodes = std::move(message.table("nodes", shape.dimension, "m").values);
  shape.faces = whole_numbers(message.table("faces", shape.dimension, "1").values);
  check_shape(shape);
  return shape;
}

SurfaceMotion to_motion(Message message, const SurfaceShape& shape) {
  check_kind(message, Kind::motion);
  SurfaceMotion motion = begin<SurfaceMotion>(message);
  motion.displacement = take(message, "displacement", "m", shape);
  motion.velocity = take(message, "velocity", "m/s", shape);
  return motion;
}

SurfaceForce to_force(Message message, const SurfaceShape& shape) {
  check_kind(message, Kind::force);
  SurfaceForce force = begin<SurfaceForce>(message);
  force.mean = take(message, "mean", force_unit(shape), shape);
  force.last = take(message, "last", force_unit(shape), shape);
  return force;
}

void check_shape(const SurfaceShape& shape) {
  const auto dimension = static_cast<std::size_t>(shape.dimension);
  const std::size_t nodes = shape.nodes.size() / dimension;
  if (nodes == 0 || shape.faces.empty()) refuse("it has no nodes, or no faces");
  if (!(shape.window > 0 && std::isfinite(shape.window))) refuse(fmt::format("its windows are {} s long", shape.window));
  if (!(shape.width > 0 && std::isfinite(shape.width))) refuse(fmt::format("it is {} m wide", shape.width));
  for (std::size_t i = 0; i < shape.faces.size(); ++i) {
    const std::int32_t node = shape.faces[i];
    if (node < 0 || static_cast<std::size_t>(node) >= nodes)
      refuse(fmt::format("face {} has node {}, and there are {} nodes, counted from 0", i / dimension, node, nodes));
    for (std::size_t j = i - i % dimension; j < i; ++j)
      if (shape.faces[j] == node) refuse(fmt::format("face {} has node {} twice", i / dimension, node));
  }
}

void check_same(const SurfaceShape& expected, const SurfaceShape& got, const std::string& where) {
  compare(expected.dimension, got.dimension, "dimension", where);
  compare(expected.width, got.width, "width [m]", where);
  compare(expected.window, got.window, "window [s]", where);
  compare(expected.nodes, got.nodes, "nodes", got.dimension, where);
  compare(expected.faces, got.faces, "faces", got.dimension, where);
}

}  // namespace sazare::coupling
