#include "sazare/methods/fem/soil_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sazare/geometry/interface_split.hpp"
#include "sazare/methods/fem/boundary_faces.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementShape, geometry::MeshElement;

constexpr Real same_place = 1e-6;  // of the extent of a side

struct Range {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;

  void add(Real value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  Real length() const { return high - low; }
};

Range extent(const geometry::ElementMesh& mesh, const MeshElement& face, int axis) {
  Range range;
  for (const Index node : face.node_list()) range.add(mesh.nodes[at(node)][axis]);
  return range;
}

/// Faces in one vertical plane, with the elements beside them.
struct Plane {
  int across = 0;
  Real place = 0, outwards = 1;
  std::vector<MeshElement> faces;
  std::vector<Index> beside;
};

/// Makes the side of a plane.
template <int D>
class SideMaker {
public:
  SideMaker(const BodyDescription& body, const Plane& plane) : body_(body), mesh_(body.mesh), plane_(plane) {
    for (const MeshElement& face : plane.faces)
      for (const Index node : face.node_list()) height_.add(mesh_.nodes[at(node)][up]);
  }

  FreeFieldSide<D> make(Index boundary) {
    check_joints();
    check_surface();
    if constexpr (D == 3) check_rectangle();
    FreeFieldSide<D> side;
    side.boundary = boundary;
    side.across = plane_.across;
    side.outwards = plane_.outwards;
    side.surface = plane_.faces;
    for (std::size_t i = 0; i < plane_.faces.size(); ++i)
      side.faces.push_back(viscous_face<D>(body_, plane_.beside[i], plane_.faces[i]));
    side.column = std::make_shared<SoilColumn<D>>();
    side.column->body = layers();
    std::set<Index> nodes;
    for (const MeshElement& face : plane_.faces) nodes.insert(face.node_list().begin(), face.node_list().end());
    side.nodes.assign(nodes.begin(), nodes.end());
    for (const Vector3& level : side.column->body.mesh.nodes) {
      side.levels.emplace_back();
      for (const Index node : nodes)
        if (std::abs(mesh_.nodes[at(node)][up] - level[up]) < tolerance()) side.levels.back().push_back(node);
    }
    return side;
  }

private:
  static constexpr int up = D - 1;

  Real tolerance() const { return same_place * height_.length(); }
  std::string name() const { return fmt::format("the side at {} = {:.6g} m", "xy"[plane_.across], plane_.place); }

  /// Elevations of all corners, each once.
  std::vector<Real> elevations() const {
    std::vector<Real> all, once;
    for (const MeshElement& face : plane_.faces)
      for (int corner = 0; corner < facts(face.shape).corners; ++corner)
        all.push_back(mesh_.nodes[at(face.nodes[static_cast<std::size_t>(corner)])][up]);
    std::ranges::sort(all);
    for (const Real one : all)
      if (once.empty() || one - once.back() > tolerance()) once.push_back(one);
    return once;
  }

  BodyDescription layers() const {
    BodyDescription column;
    column.materials = body_.materials;
    column.mass = body_.mass;
    const bool quadratic = facts(plane_.faces.front().shape).quadratic;
    const ElementShape beside = mesh_.elements[at(plane_.beside.front())].shape;
    if (beside == ElementShape::quadrilateral8 || beside == ElementShape::hexahedron20) column.integration = body_.integration;
    column.mesh.dimension = D;
    column.mesh.region_names = {"column"};
    const std::vector<Real> corners = elevations();
    const auto add_node = [&](Real elevation) {
      Vector3 place = centre(mesh_, plane_.faces.front());
      place[up] = elevation;
      column.mesh.nodes.push_back(place);
      column.mesh.node_tags.push_back(std::ssize(column.mesh.nodes));
      return static_cast<Index>(column.mesh.nodes.size() - 1);
    };
    Index below = add_node(corners.front());
    for (std::size_t i = 1; i < corners.size(); ++i) {
      MeshElement element{quadratic ? ElementShape::line3 : ElementShape::line2, {}, static_cast<std::int64_t>(i)};
      if (quadratic) element.nodes[2] = add_node(0.5 * (corners[i - 1] + corners[i]));
      element.nodes[0] = below;
      element.nodes[1] = below = add_node(corners[i]);
      column.mesh.elements.push_back(element);
      column.mesh.region.push_back(0);
      column.material.push_back(material_between(corners[i - 1], corners[i]));
    }
    return column;
  }

  Index material_between(Real low, Real high) const {
    Index found = -1;
    for (std::size_t i = 0; i < plane_.faces.size(); ++i) {
      const Range face = extent(mesh_, plane_.faces[i], up);
      if (std::min(face.high, high) - std::max(face.low, low) < 0.5 * tolerance()) continue;
      const Index material = body_.material[at(plane_.beside[i])];
      if (found >= 0 && material != found)
        throw UnfitSide(fmt::format("{} has two materials, \"{}\" and \"{}\", between the elevations {:.6g} and {:.6g} m", name(),
                                    body_.materials[at(found)].name, body_.materials[at(material)].name, low, high),
                        "the column beside a side has level layers: make those of the mesh level along the side");
      found = material;
    }
    if (found < 0)
      throw UnfitSide(fmt::format("{} has a gap between the elevations {:.6g} and {:.6g} m", name(), low, high),
                      "give the group all faces of the side, from the base to the surface");
    return found;
  }

  void check_joints() const {
    std::set<Index> nodes;
    for (const MeshElement& face : plane_.faces) nodes.insert(face.node_list().begin(), face.node_list().end());
    for (const JointSet& set : body_.joints)
      for (const auto& face : set.faces)
        for (const MeshElement& one : {face.first, face.second})
          for (const Index node : one.node_list())
            if (nodes.contains(node))
              throw UnfitSide(fmt::format("the joint \"{}\" reaches {}, and the column beside it has none", set.name, name()),
                              "end the joint inside the body, or move the side");
  }

  /// Ground above the faces of a side would be missing from its column.
  void check_surface() const {
    const auto in_plane = [&](Index node) { return std::abs(mesh_.nodes[at(node)][plane_.across] - plane_.place) < tolerance(); };
    const auto above = [&](Index node) { return mesh_.nodes[at(node)][up] - height_.high; };
    for (const MeshElement& element : mesh_.elements) {
      const auto nodes = element.node_list();
      const auto is_top = [&](Index node) { return in_plane(node) && std::abs(above(node)) < tolerance(); };
      const auto is_higher = [&](Index node) { return in_plane(node) && above(node) >= tolerance(); };
      if (std::ranges::any_of(nodes, is_top) && std::ranges::any_of(nodes, is_higher))
        throw UnfitSide(fmt::format("{} ends at an elevation of {:.6g} m, and the mesh goes on above it", name(), height_.high),
                        "give the group all faces of the side, from the base to the surface");
    }
  }

  /// In space a side is as wide everywhere as its widest place.
  void check_rectangle() const {
    Range width;
    Real area = 0;
    for (const MeshElement& face : plane_.faces) {
      for (const Index node : face.node_list()) width.add(mesh_.nodes[at(node)][1 - plane_.across]);
      area += face_shares(mesh_, face).sum();
    }
    const Real whole = width.length() * height_.length();
    if (std::abs(area - whole) > 1e-6 * whole)
      throw UnfitSide(fmt::format("{} is no rectangle: its faces have {:.6g} m2 of {:.6g} m2", name(), area, whole),
                      "the column beside a side has one surface and one base: make both level along the side");
  }

  const BodyDescription& body_;
  const geometry::ElementMesh& mesh_;
  const Plane& plane_;
  Range height_;
};

/// The axis across a face in a vertical plane.
template <int D>
int axis_across(const geometry::ElementMesh& mesh, const MeshElement& face, Real tolerance) {
  for (int axis = 0; axis < D - 1; ++axis)
    if (extent(mesh, face, axis).length() < tolerance) return axis;
  const Vector3 place = centre(mesh, face);
  throw UnfitSide(fmt::format("a face of the side at ({:.6g}, {:.6g}, {:.6g}) m is not vertical and across {}", place.x(),
                              place.y(), place.z(), D == 2 ? "x" : "x or y"),
                  D == 2 ? "a free-field side is a vertical line" : "a free-field side is a vertical plane across x or across y");
}

template <int D>
std::vector<Plane> planes_of(const geometry::ElementMesh& mesh, const geometry::ElementGroup& group) {
  Range whole;
  for (const MeshElement& face : group.elements)
    for (int axis = 0; axis < D; ++axis) whole.add(extent(mesh, face, axis).length());
  const Real tolerance = same_place * whole.high;
  const auto beside = geometry::elements_beside(mesh, group);
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < group.elements.size(); ++i) {
    const int across = axis_across<D>(mesh, group.elements[i], tolerance);
    const Real place = mesh.nodes[at(group.elements[i].nodes[0])][across];
    const Real outwards = place > centre(mesh, mesh.elements[at(beside[i])])[across] ? 1 : -1;
    auto found = std::ranges::find_if(planes, [&](const Plane& plane) {
      return plane.across == across && plane.outwards == outwards && std::abs(plane.place - place) < tolerance;
    });
    if (found == planes.end()) found = planes.insert(found, Plane{across, place, outwards, {}, {}});
    found->faces.push_back(group.elements[i]);
    found->beside.push_back(beside[i]);
  }
  return planes;
}

/// The motion with which all nodes are held along an axis; none where one of them is not.
template <int D>
std::optional<Index> common_motion(const std::vector<Index>& nodes, int axis, const Supports<D>& supports) {
  std::optional<Index> motion;
  for (const Index node : nodes) {
    const auto found =
        std::ranges::find_if(supports.held, [&](const Support& held) { return held.node == node && held.axis == axis; });
    if (found == supports.held.end() || (motion && *motion != found->motion)) return std::nullopt;
    motion = found->motion;
  }
  return motion;
}

template <int D>
bool reaches(const ViscousBoundary<D>& boundary, const std::vector<Index>& nodes) {
  return std::ranges::all_of(nodes, [&](Index node) {
    return std::ranges::any_of(boundary.faces, [&](const ViscousFace& face) { return std::ranges::count(face.nodes, node) > 0; });
  });
}

/// Impedance of the ground below the foot, of 1 m2.
template <int D>
ViscousFace foot_face(const BodyDescription& column) {
  const SolidMaterial& ground = column.materials[at(column.material.front())];
  const Vector3& place = column.mesh.nodes.front();
  Eigen::MatrixXd impedance = ground.s_wave_impedance(place) * Eigen::MatrixXd::Identity(D, D);
  impedance(D - 1, D - 1) = ground.p_wave_impedance(place);
  return {{0}, impedance};
}

}  // namespace

template <int D>
ViscousFace viscous_face(const BodyDescription& body, Index element, const geometry::MeshElement& face) {
  const SolidMaterial& ground = body.materials[at(body.material[at(element)])];
  const auto list = face.node_list();
  const Vector3 place = centre(body.mesh, face);
  return {{list.begin(), list.end()},
          face_impedance<D>(body.mesh, face, ground.p_wave_impedance(place), ground.s_wave_impedance(place))};
}

template <int D>
std::vector<FreeFieldSide<D>> free_field_sides(const BodyDescription& body, const geometry::ElementGroup& group, Index boundary) {
  std::vector<FreeFieldSide<D>> sides;
  for (const Plane& plane : planes_of<D>(body.mesh, group)) sides.push_back(SideMaker<D>(body, plane).make(boundary));
  return sides;
}

template <int D>
void stand_on_base(FreeFieldSide<D>& side, const Supports<D>& supports) {
  Supports<D>& own = side.column->supports;
  own.motions = supports.motions;
  own.gravity = supports.gravity;
  own.base = supports.base;
  std::array<bool, D> carried{};
  for (std::size_t level = 0; level < side.levels.size(); ++level)
    for (int axis = 0; axis < D; ++axis)
      if (const auto motion = common_motion(side.levels[level], axis, supports)) {
        own.held.push_back({static_cast<Index>(level), axis, *motion, 0});
        if (level == 0) carried[static_cast<std::size_t>(axis)] = true;
      }
  for (const ViscousBoundary<D>& boundary : supports.viscous)
    if (reaches(boundary, side.levels.front())) {
      own.viscous.push_back({0, {}, {foot_face<D>(side.column->body)}, {0}, boundary.motion});
      carried.fill(true);
    }
  for (std::size_t axis = 0; axis < D; ++axis)
    if (!carried[axis])
      throw UnfitSide(
          fmt::format("the column beside the side at {} = {:.6g} m has no base: nothing carries it along {} at {:.6g} m",
                      "xy"[side.across], side.column->body.mesh.nodes.front()[side.across], "xyz"[axis],
                      side.column->body.mesh.nodes.front()[D - 1]),
          "hold, move or give a viscous boundary to the base of the body, which reaches the foot of the side");
  std::erase_if(side.nodes, [&](Index node) { return common_motion<D>({node}, side.across, supports).has_value(); });
}

#define SAZARE_INSTANTIATE(D)                                                                                               \
  template ViscousFace viscous_face<D>(const BodyDescription&, Index, const geometry::MeshElement&);                        \
  template std::vector<FreeFieldSide<D>> free_field_sides<D>(const BodyDescription&, const geometry::ElementGroup&, Index); \
  template void stand_on_base<D>(FreeFieldSide<D>&, const Supports<D>&);
SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::methods::fem
