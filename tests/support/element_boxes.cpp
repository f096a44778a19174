#include "tests/support/element_boxes.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/methods/fem/shape_functions.hpp"

namespace sazare::test {
namespace {

using geometry::MeshElement;

/// The linear shape with the same corners.
ElementShape linear_of(ElementShape shape) {
  const auto& about = geometry::facts(shape);
  if (about.dimension == 2) return about.simplex ? ElementShape::triangle3 : ElementShape::quadrilateral4;
  return about.simplex ? ElementShape::tetrahedron4 : ElementShape::hexahedron8;
}

/// Corners of the elements of one cell, whose own corners are numbered as a quadrilateral's or hexahedron's.
std::vector<std::vector<int>> parts_of_cell(ElementShape linear) {
  if (linear == ElementShape::triangle3) return {{0, 1, 2}, {0, 2, 3}};
  if (linear == ElementShape::quadrilateral4) return {{0, 1, 2, 3}};
  if (linear == ElementShape::hexahedron8) return {{0, 1, 2, 3, 4, 5, 6, 7}};
  return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
}

Real scatter(int seed) { return std::sin(12.9898 * seed + 4.1) * 0.5; }

class Maker {
public:
  Maker(ElementShape shape, const BoxRules& rules) : shape_(shape), linear_(linear_of(shape)), rules_(rules) {
    mesh_.dimension = geometry::facts(shape).dimension;
    mesh_.region_names = {"body"};
  }

  ElementMesh make() {
    const bool flat = mesh_.dimension == 2;
    for (int k = 0; k < (flat ? 1 : rules_.cells[2]); ++k)
      for (int j = 0; j < rules_.cells[1]; ++j)
        for (int i = 0; i < rules_.cells[0]; ++i) add_cell(i, j, k, flat);
    add_groups();
    return std::move(mesh_);
  }

private:
  Vector3 corner(int i, int j, int k) const {
    const bool flat = mesh_.dimension == 2;
    const std::array<int, 3> place = {i, j, k};
    Vector3 at = Vector3::Zero();
    bool inside = true;
    for (std::size_t axis = 0; axis < (flat ? 2 : 3); ++axis) {
      inside = inside && place[axis] > 0 && place[axis] < rules_.cells[axis];
      at[static_cast<int>(axis)] = rules_.size[static_cast<int>(axis)] * place[axis] / rules_.cells[axis];
    }
    for (int axis = 0; inside && axis < (flat ? 2 : 3); ++axis)
      at[axis] += rules_.distortion * rules_.size[axis] / rules_.cells[static_cast<std::size_t>(axis)] *
                  scatter(i + 7 * j + 31 * k + 101 * axis);
    return at;
  }

  void add_cell(int i, int j, int k, bool flat) {
    std::vector<Vector3> corners = {corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)};
    if (!flat)
      for (const Vector3& upper :
           {corner(i, j, k + 1), corner(i + 1, j, k + 1), corner(i + 1, j + 1, k + 1), corner(i, j + 1, k + 1)})
        corners.push_back(upper);
    for (const auto& part : parts_of_cell(linear_)) {
      MeshElement element{shape_, {}, static_cast<std::int64_t>(mesh_.elements.size()) + 1};
      std::size_t n = 0;
      for (const Vector3& reference : geometry::reference_nodes(shape_)) {
        const auto share = methods::fem::shape_values(linear_, reference);
        Vector3 at = Vector3::Zero();
        for (std::size_t c = 0; c < part.size(); ++c)
          at += share[static_cast<Eigen::Index>(c)] * corners[static_cast<std::size_t>(part[c])];
        element.nodes[n++] = node(at);
      }
      mesh_.elements.push_back(element);
      mesh_.region.push_back(0);
    }
  }

  Index node(const Vector3& at) {
    const auto round = [](Real value) { return std::llround(value * 1e7); };
    const auto [found, added] =
        known_.try_emplace({round(at.x()), round(at.y()), round(at.z())}, static_cast<Index>(mesh_.nodes.size()));
    if (added) {
      mesh_.nodes.push_back(at);
      mesh_.node_tags.push_back(static_cast<std::int64_t>(mesh_.nodes.size()));
    }
    return found->second;
  }

  void add_groups() {
    const int up = mesh_.dimension - 1;
    add_group("left", 0, 0);
    add_group("right", 0, rules_.size.x());
    add_group("bottom", up, 0);
    add_group("top", up, rules_.size[up]);
    if (up == 1) return;
    add_group("front", 1, 0);
    add_group("back", 1, rules_.size.y());
  }

  void add_group(const std::string& name, int axis, Real place) {
    geometry::ElementGroup group{name, mesh_.dimension - 1, {}};
    for (const MeshElement& element : mesh_.elements)
      for (const geometry::ElementFace& face : geometry::faces_of(element.shape)) {
        MeshElement one{face.shape, {}, 0};
        bool on_it = true;
        for (std::size_t i = 0; i < face.nodes.size(); ++i) {
          one.nodes[i] = element.nodes[static_cast<std::size_t>(face.nodes[i])];
          on_it = on_it && std::abs(mesh_.nodes[static_cast<std::size_t>(one.nodes[i])][axis] - place) < 1e-9;
        }
        if (on_it) group.elements.push_back(one);
      }
    mesh_.groups.push_back(std::move(group));
  }

  ElementShape shape_, linear_;
  BoxRules rules_;
  ElementMesh mesh_;
  std::map<std::array<long long, 3>, Index> known_;
};

}  // namespace

ElementMesh box(ElementShape shape, const BoxRules& rules) { return Maker(shape, rules).make(); }

std::string name_of(ElementShape shape) { return std::string(geometry::facts(shape).name); }

template <int D>
void hold(const ElementMesh& mesh, const std::string& group, int axis, methods::fem::Supports<D>& supports, Index motion) {
  std::set<Index> nodes;
  for (const MeshElement& element : mesh.find_group(group)->elements)
    nodes.insert(element.node_list().begin(), element.node_list().end());
  for (const Index node : nodes) supports.held.push_back({node, axis, motion, 0});
}

methods::fem::BodyDescription of_one_material(ElementMesh mesh, const methods::fem::SolidMaterial& material) {
  methods::fem::BodyDescription description;
  description.material.assign(mesh.elements.size(), 0);
  description.mesh = std::move(mesh);
  description.materials = {material};
  return description;
}

methods::fem::NodalColumn traction(const ElementMesh& mesh, const std::string& group, const Vector3& pressure) {
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  methods::fem::NodalColumn force(mesh.nodes.size() * dimension, 0);
  for (const MeshElement& face : mesh.find_group(group)->elements) {
    const auto shares = methods::fem::face_shares(mesh, face);
    for (std::size_t i = 0; i < face.node_list().size(); ++i)
      for (std::size_t axis = 0; axis < dimension; ++axis)
        force[static_cast<std::size_t>(face.nodes[i]) * dimension + axis] +=
            shares[static_cast<Eigen::Index>(i)] * pressure[static_cast<int>(axis)];
  }
  return force;
}

Index node_at(const ElementMesh& mesh, const Vector3& place) {
  Index nearest = 0;
  Real shortest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (const Real distance = (mesh.nodes[i] - place).norm(); distance < shortest) {
      shortest = distance;
      nearest = static_cast<Index>(i);
    }
  return nearest;
}

template void hold<2>(const ElementMesh&, const std::string&, int, methods::fem::Supports<2>&, Index);
template void hold<3>(const ElementMesh&, const std::string&, int, methods::fem::Supports<3>&, Index);

}  // namespace sazare::test
