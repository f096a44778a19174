#include "msh_writer.hpp"

#include <fmt/format.h>

namespace sazare::geometry::test {
namespace {

/// Writes numbers as text or as Gmsh's binary: int of 4, long of 8, real of 8 bytes.
class Numbers {
public:
  explicit Numbers(bool binary) : binary_(binary) {}

  void integer(std::int32_t value) { put(value); }
  void whole(std::int64_t value) { put(value); }
  void real(double value) { put(value); }
  void line_end() {
    if (!binary_) out += "\n";
  }
  void section(const std::string& name) { out += "$" + name + "\n"; }
  void end(const std::string& name) { out += (binary_ ? "\n$End" : "$End") + name + "\n"; }

  std::string out;

private:
  template <class T>
  void put(T value) {
    if (binary_) {
      out.append(reinterpret_cast<const char*>(&value), sizeof(T));
    } else {
      out += fmt::format("{} ", value);
    }
  }

  bool binary_;
};

void write_entities(Numbers& out, const MshWriter& mesh) {
  out.section("Entities");
  out.whole(0);
  out.whole(0);
  out.whole(static_cast<std::int64_t>(mesh.surface_groups.size()));
  out.whole(static_cast<std::int64_t>(mesh.volume_groups.size()));
  out.line_end();
  for (const auto* groups : {&mesh.surface_groups, &mesh.volume_groups}) {
    for (const auto& [tag, numbers] : *groups) {
      out.integer(tag);
      for (int i = 0; i < 6; ++i) out.real(0.5);
      out.whole(static_cast<std::int64_t>(numbers.size()));
      for (const int number : numbers) out.integer(number);
      out.whole(2);
      out.integer(1);
      out.integer(-2);
      out.line_end();
    }
  }
  out.end("Entities");
}

void write_nodes(Numbers& out, const MshWriter& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.nodes.size());
  out.section("Nodes");
  for (const std::int64_t value : {std::int64_t{1}, count, std::int64_t{1}, count}) out.whole(value);
  out.line_end();
  out.integer(2);
  out.integer(1);
  out.integer(mesh.parametric ? 1 : 0);
  out.whole(count);
  out.line_end();
  for (std::int64_t tag = 1; tag <= count; ++tag) {
    out.whole(tag);
    out.line_end();
  }
  for (const Vector3& node : mesh.nodes) {
    for (int axis = 0; axis < 3; ++axis) out.real(node[axis]);
    for (int i = 0; mesh.parametric && i < 2; ++i) out.real(0.25);
    out.line_end();
  }
  out.end("Nodes");
}

void write_elements(Numbers& out, const MshWriter& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.elements.size());
  out.section("Elements");
  for (const std::int64_t value : {count, count, std::int64_t{101}, 100 + count}) out.whole(value);
  out.line_end();
  std::int64_t tag = 101;
  for (const auto& element : mesh.elements) {
    out.integer(element.dimension);
    out.integer(element.entity);
    out.integer(element.type);
    out.whole(1);
    out.line_end();
    out.whole(tag++);
    for (const std::int64_t node : element.nodes) out.whole(node);
    out.line_end();
  }
  out.end("Elements");
}

std::string write(const MshWriter& mesh, bool binary) {
  std::string head = fmt::format("$MeshFormat\n{} {} 8\n", mesh.version, binary ? 1 : 0);
  if (binary) {
    const std::int32_t one = 1;
    head.append(reinterpret_cast<const char*>(&one), sizeof(one));
    head += "\n";
  }
  head += "$EndMeshFormat\n";
  head += fmt::format("$PhysicalNames\n{}\n", mesh.names.size());
  for (const auto& group : mesh.names) head += fmt::format("{} {} \"{}\"\n", group.dimension, group.number, group.name);
  head += "$EndPhysicalNames\n";
  Numbers out(binary);
  write_entities(out, mesh);
  write_nodes(out, mesh);
  write_elements(out, mesh);
  return head + out.out;
}

}  // namespace

std::string MshWriter::text() const { return write(*this, false); }
std::string MshWriter::binary() const { return write(*this, true); }

MshWriter two_tetrahedra() {
  MshWriter mesh;
  mesh.names = {{2, 7, "floor"}, {3, 8, "left"}, {3, 9, "right"}};
  mesh.surface_groups = {{1, {7}}};
  mesh.volume_groups = {{1, {8}}, {2, {9}}};
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.elements = {{2, 2, 1, {1, 2, 3}}, {2, 2, 1, {2, 5, 3}}, {4, 3, 1, {1, 2, 3, 4}}, {4, 3, 2, {2, 5, 3, 4}}};
  return mesh;
}

}  // namespace sazare::geometry::test
