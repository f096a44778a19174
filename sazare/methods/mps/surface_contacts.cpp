#include "sazare/methods/mps/surface_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sazare/core/member_archive.hpp"
#include "sazare/geometry/facets/touching_points.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 64;
constexpr Real skin = 0.5;  // of the spacing

template <int D>
Vector3 centre_of(const state::Particles<D>& particles, Index particle) {
  return in_space<D>(vector_of<D>(particles.start, particle) + vector_of<D>(particles.displacement, particle));
}

/// Angular velocity of a particle, about z in the plane [rad/s].
template <int D>
Vector3 spin_of(const state::Particles<D>& particles, Index particle) {
  Vector3 spin = Vector3::Zero();
  for (int axis = 0; axis < angular_dimension<D>; ++axis)
    spin[3 - angular_dimension<D> + axis] = particles.velocity[static_cast<std::size_t>(D + axis)][at(particle)];
  return spin;
}

}  // namespace

/// A particle as its contacts see it.
template <int D>
struct SurfaceContacts<D>::Moving {
  Vector3 centre, velocity, spin;
  Real along = 0, across = 0, inverse_mass = 0;  ///< k_n, k_t
  Real inverse_inertia = 0;  ///< 0 where forces act in the centre
};

template <int D>
SurfaceContacts<D>::SurfaceContacts(const state::Particles<D>& particles, std::span<const WaveVelocities> waves,
                                    const SurfaceRules& rules, std::vector<Vector3> nodes,
                                    std::vector<std::array<Index, 3>> faces)
    : rules_(rules), spacing_(particles.spacing), surface_(std::move(nodes), std::move(faces)), complex_(surface_.complex()) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    along_.push_back(stiffness_over_mass(waves[i].p, spacing_) / particles.inverse_mass[i]);
    across_.push_back(stiffness_over_mass(waves[i].s, spacing_) / particles.inverse_mass[i]);
  }
}

template <int D>
void SurfaceContacts<D>::lead(std::vector<Vector3> from, std::vector<Vector3> with) {
  past_work_ += surface_.work();
  Real farthest = 0;  // a surface may be put elsewhere
  for (std::size_t node = 0; node < from.size(); ++node)
    farthest = std::max(farthest, (from[node] - surface_.place(static_cast<Index>(node), time_)).norm());
  drift_ += farthest;
  surface_.lead(0, 0, std::move(from), std::move(with));
  time_ = 0;
}

/// What its parts count follows from where it stands, as for a surface that is there from the beginning.
template <int D>
void SurfaceContacts<D>::put(std::vector<Vector3> nodes) {
  std::vector<Vector3> still(nodes.size(), Vector3::Zero());
  lead(std::move(nodes), std::move(still));
  complex_ = surface_.complex();
}

template <int D>
Index SurfaceContacts<D>::touching() const {
  return static_cast<Index>(std::ranges::count_if(near_, [](const Near& near) { return !near.pushes.empty(); }));
}

template <int D>
Real SurfaceContacts<D>::energy() const {
  Real sum = 0;
  for (const Near& near : near_) sum += near.energy;
  return sum;
}

template <int D>
bool SurfaceContacts<D>::must_search(const state::Particles<D>& particles) const {
  if (!searched_) return true;
  Real farthest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Real square = 0;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const Real way = particles.displacement[axis][i] - searched_at_[axis][i];
      square += way * way;
    }
    farthest = std::max(farthest, square);
  }
  return std::sqrt(farthest) + drift_ > skin * spacing_;
}

/// Which particles are near which faces; those that were near keep what they remember.
template <int D>
void SurfaceContacts<D>::search(const state::Particles<D>& particles) {
  neighbors::SphereGrid grid;
  std::vector<geometry::Triangle> triangles;
  for (std::size_t face = 0; face < surface_.face_count(); ++face) {
    const geometry::Triangle& corners = triangles.emplace_back(surface_.corners(face, time_));
    const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    Real radius = 0;
    for (const Vector3& corner : corners) radius = std::max(radius, (corner - middle).norm());
    grid.place(static_cast<Index>(face), middle, radius);
  }
  const Real reach = (0.5 + skin) * spacing_;
  std::vector<Near> before = std::exchange(near_, {});
  auto known = before.begin();
  for (Index i = 0; i < particles.count; ++i) {
    const Vector3 centre = centre_of<D>(particles, i);
    Near found;
    grid.visit_near(centre, reach, [&](Index face) {
      if ((geometry::nearest_point(triangles[at(face)], centre) - centre).norm() <= reach) found.faces.push_back(face);
    });
    if (found.faces.empty()) continue;
    std::ranges::sort(found.faces);
    while (known != before.end() && known->particle < i) ++known;
    Near& near = near_.emplace_back();
    if (known != before.end() && known->particle == i) near = std::move(*known);
    near.particle = i;
    near.faces = std::move(found.faces);
  }
  searched_ = true;
  drift_ = 0;
  searched_at_ = particles.displacement;
}

template <int D>
void SurfaceContacts<D>::evaluate(const state::Particles<D>& particles, const std::function<bool(Index)>& is_linked) {
  time_ += searched_ ? rules_.step : 0;
  drift_ += rules_.step * surface_.largest_speed();
  if (must_search(particles)) search(particles);
  parallel::parallel_for(near_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) evaluate(particles, is_linked(near_[n].particle), near_[n]);
  });
  std::vector<geometry::NodeForce> forces;
  for (const Near& near : near_) {
    dissipated_ += near.loss;
    for (const Push& push : near.pushes)
      for (std::size_t k = 0; k < 3; ++k) forces.push_back({push.nodes[k], -push.shares[k] * push.on_particle});
  }
  surface_.add_work(forces, rules_.step);
}

template <int D>
void SurfaceContacts<D>::add_forces(Real factor, state::FreedomColumns<D>& acceleration) const {
  constexpr int turns = angular_dimension<D>;
  for (const Near& near : near_) {
    const auto i = at(near.particle);
    for (int axis = 0; axis < D; ++axis) acceleration[static_cast<std::size_t>(axis)][i] += factor * near.acceleration[axis];
    for (int axis = 0; axis < turns; ++axis)
      acceleration[static_cast<std::size_t>(D + axis)][i] += factor * near.turning[3 - turns + axis];
  }
}

/// The faces within the radius of a particle. Returns by how much it overlaps the nearest one.
template <int D>
Real SurfaceContacts<D>::find_faces(const Vector3& centre, const Near& near, std::vector<geometry::NearFacet>& found) const {
  const Real radius = 0.5 * spacing_;
  Real deepest = 0;
  found.clear();
  for (const Index face : near.faces) {
    const auto point = geometry::nearest_on(surface_.corners(at(face), time_), centre);
    const Real distance = (point.place - centre).norm();
    if (!(distance < radius) || !(distance > 0) || complex_.facets()[at(face)].count == 0) continue;
    found.push_back({face, point, distance});
    deepest = std::max(deepest, radius - distance);
  }
  return deepest;
}

template <int D>
void SurfaceContacts<D>::evaluate(const state::Particles<D>& particles, bool is_linked, Near& near) const {
  thread_local std::vector<geometry::NearFacet> faces;
  thread_local geometry::FacetPoints found;
  near.acceleration = near.turning = Vector3::Zero();
  near.energy = near.loss = 0;
  near.pushes.clear();
  for (Touch& touch : near.touches) touch.is_touching = 0;
  const auto i = at(near.particle);
  const Moving particle{centre_of<D>(particles, near.particle),
                        in_space<D>(velocity_of<D>(particles, near.particle)),
                        is_linked ? spin_of<D>(particles, near.particle) : Vector3(Vector3::Zero()),
                        along_[i],
                        across_[i],
                        particles.inverse_mass[i],
                        is_linked ? particles.inverse_inertia[i] : 0};
  const Real deepest = find_faces(particle.centre, near, faces);
  near.initial_overlap = near.is_known != 0 ? std::min(near.initial_overlap, deepest) : deepest;
  near.is_known = 1;
  const Real radius = 0.5 * spacing_ - near.initial_overlap;
  std::erase_if(faces, [&](const geometry::NearFacet& face) { return !(face.distance < radius); });
  if (!faces.empty()) {
    found.find(
        complex_, [&](Index node) { return surface_.place(node, time_); }, particle.centre, radius, radius, faces);
    const auto contacts = static_cast<Real>(
        std::ranges::count_if(found.points(), [](const geometry::FacetPoint& point) { return point.share > 0; }));
    for (const geometry::FacetPoint& point : found.points()) push(particle, point, radius - point.distance, contacts, near);
  }
  for (const Touch& touch : near.touches)
    if (touch.is_touching == 0) near.loss += touch.stored;
  std::erase_if(near.touches, [](const Touch& touch) { return touch.is_touching == 0; });
}

/// Pushes the particle in one point. In a step the mean of the forces at its ends does work, as the stepper counts it; what of it
/// the spring that slides does not store is lost.
template <int D>
void SurfaceContacts<D>::push(const Moving& particle, const geometry::FacetPoint& point, Real overlap, Real contacts,
                              Near& near) const {
  const auto face = surface_.point(at(point.facet), time_, point.place);
  const Vector3& normal = point.normal;
  const Vector3 arm = particle.inverse_inertia > 0 ? Vector3(point.place - particle.centre) : Vector3(Vector3::Zero());
  const laws::SphereContact law{.stiffness = particle.along,
                                .damping = 2 * rules_.damping_ratio * std::sqrt(particle.along / particle.inverse_mass)};
  const Real energy = laws::sphere_energy(law, overlap);
  Vector3 force = point.count * law.stiffness * overlap * normal;
  near.energy += point.count * energy;
  if (point.share > 0) {
    Touch& touch = geometry::touching_point(near.touches, normal, [](const Touch&) { return true; });
    geometry::turn_point(touch, normal, rules_.step * face.spin().dot(normal));
    const Vector3 parting = particle.velocity + particle.spin.cross(arm) - face.velocity();
    laws::SphereMotion motion;
    motion.overlap = overlap;
    motion.opening_speed = parting.dot(normal);
    motion.normal_mass = motion.sliding_mass = 1 / particle.inverse_mass;
    motion.contacts = contacts;
    motion.step = motion.elapsed = rules_.step;
    const laws::SphereForce given = laws::sphere_force(law, motion, touch.memory.along);
    const Vector3 way = rules_.step * (parting - motion.opening_speed * normal);
    touch.memory.across =
        laws::limited<Real>(touch.memory.across - particle.across * way, rules_.friction * (given.elastic + given.dashpot));
    const Vector3 dashpot = point.share * given.dashpot * normal, friction = point.share * touch.memory.across;
    const Real stored = 0.5 * point.share * touch.memory.across.squaredNorm() / particle.across;
    const Vector3 mean = 0.5 * (dashpot + touch.dashpot + friction + touch.friction);
    near.loss -= rules_.step * parting.dot(mean) + stored - touch.stored;
    near.energy += stored;
    touch.dashpot = dashpot;
    touch.friction = friction;
    touch.stored = stored;
    force += dashpot + friction;
    near.turning += particle.inverse_inertia * arm.cross(friction);
  }
  force -= energy * point.slope;
  near.acceleration += particle.inverse_mass * force;
  near.pushes.push_back({face.nodes, face.shares, force});
}

template <int D>
void SurfaceContacts<D>::columns(Archive& archive) {
  archive.folder("nodes", [&] { surface_.columns(archive); });
  archive("time", time_);
  archive("drift", drift_);
  int searched = searched_ ? 1 : 0;
  archive("searched", searched);
  searched_ = searched != 0;
  for (std::size_t axis = 0; axis < D; ++axis) archive("searched_at" + std::to_string(axis), searched_at_[axis]);
  archive("dissipated", dissipated_);
  archive("past_work", past_work_);
  std::vector<Index> particles;
  for (const Near& near : near_) particles.push_back(near.particle);
  archive("particles", particles);
  if (archive.reading()) near_.resize(particles.size());
  for (std::size_t n = 0; n < near_.size(); ++n) near_[n].particle = particles[n];
  archive_members(archive, "is_known", near_, &Near::is_known);
  archive_members(archive, "initial_overlap", near_, &Near::initial_overlap);
  archive_members(archive, "acceleration", near_, &Near::acceleration);
  archive_members(archive, "turning", near_, &Near::turning);
  archive_lists(archive, "faces", near_, &Near::faces);
  archive_lists(archive, "touches", near_, &Near::touches);
  if (archive.reading()) check(searched_at_[0].size());
}

template <int D>
void SurfaceContacts<D>::check(std::size_t particles) const {
  const auto is_face = [&](Index face) { return face >= 0 && at(face) < surface_.face_count(); };
  for (const Near& near : near_)
    if (near.particle < 0 || at(near.particle) >= particles || !std::ranges::all_of(near.faces, is_face))
      throw UserError("checkpoint: a particle or a face near the coupling surface has a number that the model does not have");
}

template class SurfaceContacts<2>;
template class SurfaceContacts<3>;

}  // namespace sazare::methods::mps
