#include "sazare/methods/fem/free_field.hpp"

#include <fmt/format.h>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/soil_column.hpp"

namespace sazare::methods::fem {
namespace {

template <int D>
using PointStresses = std::vector<std::vector<Voigt<D>>>;

/// Traction of a stress on a plane across an axis.
template <int D>
Vector<D> traction(const Voigt<D>& stress, int across) {
  Voigt<D> doubled = stress;
  doubled.template tail<stress_size<D> - 3>() *= 2;
  return strain_tensor<D>(doubled).col(across).template head<D>();
}

/// Values at a place between -1 and 1 of the polynomials that are 1 at their own of Gauss's points and 0 at all others.
Eigen::VectorXd values_between(std::span<const QuadraturePoint> points, Real place) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k != i)
        values[static_cast<Eigen::Index>(i)] *= (place - points[k].place.x()) / (points[i].place.x() - points[k].place.x());
  return values;
}

/// The force of dashpots on a body with these velocities, where what is beyond them stands still [N].
template <int D>
Vector<D> braking(const std::vector<ViscousFace>& faces, const NodalColumn& velocity) {
  Vector<D> sum = Vector<D>::Zero();
  for (const ViscousFace& face : faces)
    for (Eigen::Index column = 0; column < face.impedance.cols(); ++column) {
      const Real speed = velocity[number<D>(face.nodes[static_cast<std::size_t>(column / D)], static_cast<int>(column % D))];
      for (Eigen::Index row = 0; row < face.impedance.rows(); ++row)
        sum[static_cast<int>(row % D)] -= face.impedance(row, column) * speed;
    }
  return sum;
}

}  // namespace

/// A column, and where the side beside it looks at it.
template <int D>
class FreeField<D>::Column {
public:
  Column(const Body<D>& body, const FreeFieldSide<D>& side, const FemRules& rules)
      : side_(side), stepper_(std::make_unique<Body<D>>(side.column->body), side.column->supports, rules) {
    const geometry::ElementMesh& mesh = body.mesh();
    for (const geometry::MeshElement& face : side.surface) {
      for (const Index node : face.node_list()) nodes_.push_back(find_node(mesh, node));
      for (const QuadraturePoint& place : traction_points(face.shape, side.column->body.integration)) {
        const FacePoint<D> point = face_point<D>(mesh, face, place);
        const auto [element, between] = find(place_on(mesh, face, point.values)[D - 1]);
        const auto points = stiffness_points(column_mesh().elements[element].shape, stepper_.body().description().integration);
        points_.push_back(
            {&face - side.surface.data(), element, side.outwards * point.weight * point.values, values_between(points, between)});
      }
    }
    at_rest_ = stresses();
  }

  FemStepper<D>& stepper() { return stepper_; }
  const FemStepper<D>& stepper() const { return stepper_; }
  void relax() {
    guard([&] { stepper_.relax(); });
    at_rest_ = stresses();
  }
  void advance() {
    guard([&] { stepper_.advance(); });
  }

  /// Adds what the side feels to the columns of the body.
  void add_to(SideMotion& motion) const {
    const FemState<D>& state = stepper_.state();
    std::size_t n = 0;
    for (const ViscousFace& face : side_.faces) {
      Eigen::VectorXd velocity(face.impedance.rows());
      for (std::size_t i = 0; i < face.nodes.size(); ++i, ++n)
        for (int axis = 0; axis < D; ++axis) {
          const std::size_t place = number<D>(face.nodes[i], axis);
          motion.displacement[place] = value(nodes_[n], state.displacement, axis);
          motion.velocity[place] = velocity[static_cast<Eigen::Index>(i) * D + axis] = value(nodes_[n], state.velocity, axis);
        }
      add_at<D>(face.nodes, face.impedance * velocity, motion.force);
    }
    const PointStresses<D> now = stresses();
    for (const PointSample& point : points_) {
      Voigt<D> stress = Voigt<D>::Zero();
      for (Eigen::Index i = 0; i < point.gauss.size(); ++i)
        stress += point.gauss[i] * (now[point.element][at(i)] - at_rest_[point.element][at(i)]);
      const Vector<D> by_area = traction<D>(stress, side_.across);
      const auto& face_nodes = side_.faces[at(point.face)].nodes;
      for (std::size_t i = 0; i < face_nodes.size(); ++i)
        for (int axis = 0; axis < D; ++axis)
          motion.force[number<D>(face_nodes[i], axis)] += point.values[static_cast<Eigen::Index>(i)] * by_area[axis];
    }
  }

  void columns(Archive& archive) {
    stepper_.columns(archive);
    std::vector<Real> numbers;
    for (const auto& element : at_rest_)
      for (const auto& stress : element) numbers.insert(numbers.end(), stress.begin(), stress.end());
    archive("stress_at_rest", numbers);
    std::size_t n = 0;
    for (auto& element : at_rest_)
      for (auto& stress : element)
        for (Real& one : stress) one = numbers.at(n++);
  }

private:
  /// Where a node of the body is in the column.
  struct NodeSample {
    std::size_t element = 0;
    NodeValues values;
  };
  /// A point of a face: shares of its nodes, outwards [m2; m], and of the column's points of integration.
  struct PointSample {
    std::ptrdiff_t face = 0;
    std::size_t element = 0;
    NodeValues values;
    Eigen::VectorXd gauss;
  };

  const geometry::ElementMesh& column_mesh() const { return stepper_.body().mesh(); }

  template <class Work>
  void guard(Work work) {
    try {
      work();
    } catch (const PhysicsError& error) {
      throw PhysicsError(fmt::format("in the column beside the side at {} = {:.6g} m: {}", "xy"[side_.across],
                                     column_mesh().nodes.front()[side_.across], error.what()));
    }
  }

  /// The element of the column at an elevation, and the place in it, from -1 to 1.
  std::pair<std::size_t, Real> find(Real elevation) const {
    const auto& mesh = column_mesh();
    const auto end_of = [&](std::size_t element, std::size_t end) {
      return mesh.nodes[at(mesh.elements[element].nodes[end])][D - 1];
    };
    std::size_t element = 0;
    while (element + 1 < mesh.elements.size() && elevation > end_of(element, 1)) ++element;
    const Real low = end_of(element, 0), high = end_of(element, 1);
    return {element, (2 * elevation - low - high) / (high - low)};
  }

  NodeSample find_node(const geometry::ElementMesh& mesh, Index node) const {
    const auto [element, between] = find(mesh.nodes[at(node)][D - 1]);
    return {element, shape_values(column_mesh().elements[element].shape, {between, 0, 0})};
  }

  Real value(const NodeSample& sample, const NodalColumn& column, int axis) const {
    Real sum = 0;
    const auto list = column_mesh().elements[sample.element].node_list();
    for (std::size_t i = 0; i < list.size(); ++i)
      sum += sample.values[static_cast<Eigen::Index>(i)] * column[number<D>(list[i], axis)];
    return sum;
  }

  /// Total stresses: those of the material and of its Rayleigh damping, less the excess pressure in its pores.
  PointStresses<D> stresses() const {
    const Body<D>& body = stepper_.body();
    const FemState<D>& state = stepper_.state();
    PointStresses<D> stresses = body.point_stresses(state.displacement, state.memory);
    for (std::size_t e = 0; e < stresses.size(); ++e) {
      const geometry::MeshElement& element = body.mesh().elements[e];
      const SolidMaterial& material = body.description().materials[at(body.description().material[e])];
      const Real time = stepper_.rules().damping.stiffness_time * material.damping_ratio;
      if (!(time > 0)) continue;
      const VoigtMatrix<D> stiffness = elastic_stiffness<D>(material.elastic);
      const ElementColumn<D> velocity = displacements_of<D>(element, state.velocity);
      std::size_t n = 0;
      for (const QuadraturePoint& place : stiffness_points(element.shape, body.description().integration)) {
        const Voigt<D> rate = strain_matrix<D>(solid_point<D>(body.mesh(), element, place).gradients) * velocity;
        stresses[e][n++] += time * (stiffness * rate);
      }
    }
    const Pores<D>& pores = body.pores();
    for (std::size_t i = 0; i < pores.size(); ++i) {
      const std::size_t e = at(pores.element(i));
      const auto points = stiffness_points(body.mesh().elements[e].shape, body.description().integration);
      const std::vector<Real> pressures = pores.at_points(i, points, state.velocity);
      for (std::size_t n = 0; n < pressures.size(); ++n) stresses[e][n].template head<3>().array() -= pressures[n];
    }
    return stresses;
  }

  FreeFieldSide<D> side_;
  FemStepper<D> stepper_;
  std::vector<NodeSample> nodes_;  ///< face by face
  std::vector<PointSample> points_;
  PointStresses<D> at_rest_;
};

template <int D>
FreeField<D>::FreeField(const Body<D>& body, const Supports<D>& supports, const FemRules& rules) : impedance_(body.pattern()) {
  for (const FreeFieldSide<D>& side : supports.sides) {
    faces_.push_back(side.faces);
    for (const ViscousFace& face : side.faces) impedance_.add(face.nodes, face.impedance);
  }
  if (supports.wave)
    inclined_ = std::make_unique<InclinedField<D>>(body, supports, rules.step, rules.damping);
  else
    for (const FreeFieldSide<D>& side : supports.sides) columns_.push_back(std::make_unique<Column>(body, side, rules));
}

template <int D>
FreeField<D>::~FreeField() = default;

template <int D>
void FreeField<D>::relax() {
  for (const auto& column : columns_) column->relax();
}

template <int D>
void FreeField<D>::start() {
  for (const auto& column : columns_) column->stepper().start();
}

template <int D>
void FreeField<D>::advance() {
  for (const auto& column : columns_) column->advance();
}

template <int D>
SideMotion FreeField<D>::motion(Real time) const {
  const NodalColumn none(impedance_.pattern().nodes() * D, 0);
  SideMotion motion{none, none, none};
  for (const auto& column : columns_) column->add_to(motion);
  if (inclined_) inclined_->add_to(motion, time);
  return motion;
}

template <int D>
Vector<D> FreeField<D>::force(std::size_t side, const NodalColumn& velocity, Real time) const {
  const Vector<D> dashpots = braking<D>(faces_[side], velocity);
  if (inclined_) return dashpots + inclined_->force_of_side(side, time);
  const NodalColumn none(impedance_.pattern().nodes() * D, 0);
  SideMotion motion{none, none, none};
  columns_[side]->add_to(motion);
  return dashpots + sum_by_axis<D>(motion.force);
}

template <int D>
std::vector<FemState<D>> FreeField<D>::states() const {
  std::vector<FemState<D>> states;
  for (const auto& column : columns_) states.push_back(column->stepper().state());
  return states;
}

template <int D>
void FreeField<D>::restore(const std::vector<FemState<D>>& states) {
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i]->stepper().restore(states[i]);
}

template <int D>
void FreeField<D>::columns(Archive& archive) {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    archive.folder(fmt::format("column{}", i), [&] { columns_[i]->columns(archive); });
}

template class FreeField<2>;
template class FreeField<3>;

}  // namespace sazare::methods::fem
