#include "sazare/methods/fem/inclined_waves/inclined_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/soil_column.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::methods::fem {
namespace {

/// Elevations between which the ground of an element is of one density: its ends, and a water table between them.
template <int D>
std::vector<Real> cuts_of(const geometry::ElementMesh& mesh, const geometry::MeshElement& element,
                          const SolidMaterial& material) {
  const Vector3& low = mesh.nodes[at(element.nodes[0])];
  std::vector<Real> cuts{low[D - 1], mesh.nodes[at(element.nodes[1])][D - 1]};
  if (!material.saturation) return cuts;
  const Real table = low[D - 1] + material.saturation->pore_water.depth(low);
  if (table > cuts[0] && table < cuts[1]) cuts.insert(cuts.begin() + 1, table);
  return cuts;
}

}  // namespace

template <int D>
std::vector<ElasticLayer> elastic_layers(const FreeFieldSide<D>& side, const laws::RayleighDamping& damping) {
  const BodyDescription& column = side.column->body;
  std::vector<ElasticLayer> layers;
  for (std::size_t e = 0; e < column.mesh.elements.size(); ++e) {
    const SolidMaterial& material = column.materials[at(column.material[e])];
    const std::vector<Real> cuts = cuts_of<D>(column.mesh, column.mesh.elements[e], material);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      Vector3 middle = column.mesh.nodes[at(column.mesh.elements[e].nodes[0])];
      middle[D - 1] = 0.5 * (cuts[i - 1] + cuts[i]);
      const Real thickness = cuts[i] - cuts[i - 1], density = material.density_at(middle);
      if (e > 0 && column.material[e] == column.material[e - 1] && density == layers.back().density)
        layers.back().thickness += thickness;
      else
        layers.push_back({thickness, density, material.elastic.lame, material.elastic.shear_modulus,
                          damping.mass_rate * material.damping_ratio, damping.stiffness_time * material.damping_ratio});
    }
  }
  return layers;
}

namespace {

/// How much of the ground of one side is at a place, and the history there.
struct Share {
  std::size_t ground = 0, history = 0;
  Real share = 1;
};
using Shares = std::vector<Share>;

/// Gathers which histories are asked for in the grounds beside all sides.
template <int D>
class Inquiry {
public:
  using Quantity = typename WaveHistories<D>::Quantity;

  explicit Inquiry(const Supports<D>& supports) : supports_(supports), wanted_(supports.sides.size()), known_(wanted_.size()) {}

  /// In the ground of one side.
  Shares of_side(std::size_t side, Quantity quantity, int across, const Vector3& place) {
    return {{side, history(side, quantity, across, place), 1}};
  }

  /// In those of all sides, by the distance to each.
  Shares between(Quantity quantity, int across, const Vector3& place) {
    Shares shares;
    Real sum = 0;
    for (std::size_t i = 0; i < supports_.sides.size(); ++i) {
      const auto& side = supports_.sides[i];
      const Real distance = std::abs(place[side.across] - side.column->body.mesh.nodes.front()[side.across]);
      if (!(distance > 0)) return of_side(i, quantity, across, place);
      shares.push_back({i, history(i, quantity, across, place), 1 / distance});
      sum += 1 / distance;
    }
    for (Share& one : shares) one.share /= sum;
    return shares;
  }

  std::vector<WaveHistories<D>> answer(Real step, const laws::RayleighDamping& damping) const {
    const IncidentWave& wave = *supports_.wave;
    std::vector<WaveHistories<D>> histories;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const LayeredGround ground(elastic_layers(supports_.sides[i], damping), wave.kind, wave.angle);
      histories.emplace_back(ground, wave, supports_.motions[at(wave.motion)], step, wanted_[i]);
    }
    return histories;
  }

private:
  using Key = std::tuple<Quantity, int, long long>;

  /// Places of one elevation, but for round-off, have one history.
  std::size_t history(std::size_t ground, Quantity quantity, int across, const Vector3& place) {
    const auto& nodes = supports_.sides[ground].column->body.mesh.nodes;
    const Real foot = nodes.front()[D - 1], extent = nodes.back()[D - 1] - foot;
    const Real height = std::clamp(place[D - 1] - foot, Real{0}, extent);
    const Key key{quantity, across, std::llround(height / extent * 1e9)};
    const auto [found, is_new] = known_[ground].try_emplace(key, wanted_[ground].size());
    if (is_new) wanted_[ground].push_back({quantity, across, height});
    return found->second;
  }

  const Supports<D>& supports_;
  std::vector<std::vector<typename WaveHistories<D>::Wanted>> wanted_;
  std::vector<std::map<Key, std::size_t>> known_;
};

template <int D>
Vector<D> value(const std::vector<WaveHistories<D>>& grounds, const Shares& shares, Real time) {
  Vector<D> sum = Vector<D>::Zero();
  for (const Share& one : shares) sum += one.share * grounds[one.ground].at(one.history, time);
  return sum;
}

/// Slowness of the wave along the level axes of the body [s/m].
template <int D>
Vector3 level_slowness(const Supports<D>& supports) {
  const IncidentWave& wave = *supports.wave;
  const LayeredGround ground(elastic_layers(supports.sides.front(), {}), wave.kind, wave.angle);
  const Vector3 along = D == 2 ? Vector3(1, 0, 0) : Vector3(std::cos(wave.azimuth), std::sin(wave.azimuth), 0);
  return ground.slowness() * along;
}

}  // namespace

/// Faces of a side or of the base.
template <int D>
class InclinedField<D>::Surface {
public:
  using Quantity = typename WaveHistories<D>::Quantity;

  /// A surface across an axis; `shares(quantity, place)` says whose motion is there, `delay(place)` when the wave comes.
  template <class SharesOf, class Delay>
  Surface(const Body<D>& body, const std::vector<geometry::MeshElement>& surface, const std::vector<ViscousFace>& faces,
          Real outwards, const SharesOf& shares, const Delay& delay) {
    for (std::size_t f = 0; f < surface.size(); ++f) {
      const auto& mesh = body.mesh();
      faces_.push_back({faces[f].nodes, faces[f].impedance, {}, {}});
      for (const Index node : faces[f].nodes) {
        const Vector3& place = mesh.nodes[at(node)];
        faces_.back().places.push_back({delay(place), shares(Quantity::velocity, place), shares(Quantity::displacement, place)});
      }
      for (const QuadraturePoint& point : traction_points(surface[f].shape, body.description().integration)) {
        const FacePoint<D> at_point = face_point<D>(mesh, surface[f], point);
        const Vector3 place = place_on(mesh, surface[f], at_point.values);
        faces_.back().points.push_back(
            {delay(place), outwards * at_point.weight * at_point.values, shares(Quantity::traction, place)});
      }
    }
  }

  /// Adds the forces of the wave on a body that stands still [N].
  void add_force(const std::vector<WaveHistories<D>>& grounds, Real time, NodalColumn& force) const {
    for (const Face& face : faces_) {
      Eigen::VectorXd velocity(face.impedance.rows());
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        velocity.segment<D>(static_cast<Eigen::Index>(i) * D) =
            value<D>(grounds, face.places[i].velocity, time - face.places[i].delay);
      Eigen::VectorXd all = face.impedance * velocity;
      for (const Point& point : face.points) {
        const Vector<D> traction = value<D>(grounds, point.traction, time - point.delay);
        for (Eigen::Index i = 0; i < point.values.size(); ++i) all.segment<D>(i * D) += point.values[i] * traction;
      }
      add_at<D>(face.nodes, all, force);
    }
  }

  /// Sets velocities and displacements of its nodes to those of the wave.
  void set_motion(const std::vector<WaveHistories<D>>& grounds, Real time, SideMotion& motion) const {
    for (const Face& face : faces_)
      for (std::size_t i = 0; i < face.nodes.size(); ++i) {
        const Place& place = face.places[i];
        const Vector<D> velocity = value<D>(grounds, place.velocity, time - place.delay),
                        displacement = value<D>(grounds, place.displacement, time - place.delay);
        for (int axis = 0; axis < D; ++axis) {
          motion.velocity[number<D>(face.nodes[i], axis)] = velocity[axis];
          motion.displacement[number<D>(face.nodes[i], axis)] = displacement[axis];
        }
      }
  }

private:
  struct Place {
    Real delay = 0;
    Shares velocity, displacement;
  };
  struct Point {
    Real delay = 0;
    NodeValues values;  ///< shares of the face's nodes, outwards [m2; m]
    Shares traction;
  };
  struct Face {
    std::vector<Index> nodes;
    Eigen::MatrixXd impedance;
    std::vector<Place> places;
    std::vector<Point> points;
  };

  std::vector<Face> faces_;
};

template <int D>
InclinedField<D>::InclinedField(const Body<D>& body, const Supports<D>& supports, Real step, const laws::RayleighDamping& damping)
    : freedoms_(body.freedoms()) {
  const Vector3 slowness = level_slowness(supports);
  Real soonest = std::numeric_limits<Real>::infinity();
  for (const Vector3& node : body.mesh().nodes) soonest = std::min(soonest, slowness.dot(node));
  const auto delay = [&](const Vector3& place) { return slowness.dot(place) - soonest; };

  Inquiry<D> inquiry(supports);
  for (std::size_t i = 0; i < supports.sides.size(); ++i) {
    const auto& side = supports.sides[i];
    const auto shares = [&](auto quantity, const Vector3& place) { return inquiry.of_side(i, quantity, side.across, place); };
    sides_.emplace_back(body, side.surface, side.faces, side.outwards, shares, delay);
  }
  for (const auto& boundary : supports.viscous) {
    const auto shares = [&](auto quantity, const Vector3& place) { return inquiry.between(quantity, D - 1, place); };
    boundaries_.emplace_back(body, boundary.surface, boundary.faces, -1, shares, delay);
  }
  grounds_ = inquiry.answer(step, damping);
}

template <int D>
InclinedField<D>::~InclinedField() = default;

template <int D>
void InclinedField<D>::add_to(SideMotion& motion, Real time) const {
  for (const Surface& side : sides_) {
    side.add_force(grounds_, time, motion.force);
    side.set_motion(grounds_, time, motion);
  }
}

template <int D>
void InclinedField<D>::add_incoming(NodalColumn& force, Real time) const {
  for (const Surface& boundary : boundaries_) boundary.add_force(grounds_, time, force);
}

template <int D>
Vector<D> InclinedField<D>::force_of_side(std::size_t side, Real time) const {
  NodalColumn force(freedoms_, 0);
  sides_[side].add_force(grounds_, time, force);
  return sum_by_axis<D>(force);
}

template <int D>
Vector<D> InclinedField<D>::force_of_boundary(std::size_t boundary, Real time) const {
  NodalColumn force(freedoms_, 0);
  boundaries_[boundary].add_force(grounds_, time, force);
  return sum_by_axis<D>(force);
}

template std::vector<ElasticLayer> elastic_layers<2>(const FreeFieldSide<2>&, const laws::RayleighDamping&);
template std::vector<ElasticLayer> elastic_layers<3>(const FreeFieldSide<3>&, const laws::RayleighDamping&);
template class InclinedField<2>;
template class InclinedField<3>;

}  // namespace sazare::methods::fem
