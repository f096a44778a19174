#include "sazare/methods/blocks/rates/coupled_rates.hpp"

#include <algorithm>
#include <random>

namespace sazare::methods::blocks {

namespace {

constexpr int iterations = 24;
constexpr Real margin = 1.05;  // power iteration comes from below: within 3 % after so many (measured on the cases)

/// A velocity and a spin for every body, in world axes.
struct Motions {
  std::vector<Vector3> velocity, spin;

  explicit Motions(std::size_t bodies) : velocity(bodies, Vector3::Zero()), spin(bodies, Vector3::Zero()) {}
};

/// One face: n, and what its dashpots have per vertex, over the larger of its bodies' rates [kg].
struct Coupling {
  Vector3 normal;
  Real across = 0;
  Real along = 0;
};

Coupling coupling_of(const JointFace& face, const ElasticJoint& kind, std::span<const terms::Rates> held) {
  const auto& c = face.corners;
  const Vector3 twice_area = (c[1] - c[0]).cross(c[2] - c[0]);
  const Real rate = std::max(held[at(face.master)].damping, held[at(face.slave)].damping);
  const Real weight = rate > 0 ? twice_area.norm() / 6 / rate : 0;
  return {twice_area.normalized(), weight * kind.normal_damping, weight * kind.shear_damping};
}

/// Adds the momenta per time that the dashpots of a face give.
void add_forces(const JointFace& face, const Coupling& coupling, const state::Bodies<3>& bodies, const Motions& motions,
                Motions& forces) {
  const auto &master = bodies.motion[at(face.master)], &slave = bodies.motion[at(face.slave)];
  const auto moving = [&](Index body, const Vector3& arm) -> Vector3 {
    return motions.velocity[at(body)] + motions.spin[at(body)].cross(arm);
  };
  for (const Vector3& corner : face.corners) {
    const Vector3 master_arm = corner - master.position, slave_arm = corner - slave.position;
    const Vector3 opening = moving(face.slave, slave_arm) - moving(face.master, master_arm);
    const Vector3 normal_part = coupling.normal.dot(opening) * coupling.normal;
    const Vector3 force = coupling.across * normal_part + coupling.along * (opening - normal_part);
    forces.velocity[at(face.slave)] += force;
    forces.spin[at(face.slave)] += slave_arm.cross(force);
    forces.velocity[at(face.master)] -= force;
    forces.spin[at(face.master)] -= master_arm.cross(force);
  }
}

void clear_locked(const state::Bodies<3>& bodies, Motions& motions) {
  for (std::size_t body = 0; body < motions.velocity.size(); ++body)
    for (int axis = 0; axis < 3; ++axis) {
      if (bodies.locks[body].translation >> axis & 1) motions.velocity[body][axis] = 0;
      if (bodies.locks[body].rotation >> axis & 1) motions.spin[body][axis] = 0;
    }
}

/// Deterministic noise: every mode has a share in it.
Motions noise(const state::Bodies<3>& bodies) {
  Motions made(at(bodies.size()));
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<Real>(random()) / static_cast<Real>(std::mt19937::max()) - 0.5; };
  for (std::size_t body = 0; body < made.velocity.size(); ++body) {
    for (int axis = 0; axis < 3; ++axis) made.velocity[body][axis] = number();
    for (int axis = 0; axis < 3; ++axis) made.spin[body][axis] = number() / std::max(bodies.reach[body], Real{1e-12});
  }
  clear_locked(bodies, made);
  return made;
}

Vector3 turned_by(const state::Bodies<3>& bodies, std::size_t body, const Vector3& torque) {
  const Matrix3& rotation = bodies.motion[body].rotation;
  return rotation * bodies.inertia[body].inverse_moments.cwiseProduct(rotation.transpose() * torque);
}

}  // namespace

Real coupled_damping(std::span<const ElasticJoint> kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies,
                     std::span<const terms::Rates> held) {
  std::vector<Coupling> couplings;
  for (const JointFace& face : faces) couplings.push_back(coupling_of(face, elastic_joint(kinds, face), held));
  Motions motions = noise(bodies);
  Real largest = 1;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Motions forces(at(bodies.size()));
    for (std::size_t face = 0; face < faces.size(); ++face) add_forces(faces[face], couplings[face], bodies, motions, forces);
    clear_locked(bodies, forces);
    Real power = 0, square = 0;  // v C v and (M^-1 C v) C v: their ratio is the Rayleigh quotient of M^-1/2 C v
    for (std::size_t body = 0; body < forces.velocity.size(); ++body) {
      power += motions.velocity[body].dot(forces.velocity[body]) + motions.spin[body].dot(forces.spin[body]);
      motions.velocity[body] = forces.velocity[body] / bodies.inertia[body].mass;
      motions.spin[body] = turned_by(bodies, body, forces.spin[body]);
      square += motions.velocity[body].dot(forces.velocity[body]) + motions.spin[body].dot(forces.spin[body]);
    }
    if (power <= 0) return 1;  // no dashpots
    largest = square / power;
    const Real scale = 1 / std::sqrt(square);
    for (std::size_t body = 0; body < forces.velocity.size(); ++body) {
      motions.velocity[body] *= scale;
      motions.spin[body] *= scale;
    }
    clear_locked(bodies, motions);
  }
  return std::clamp(margin * largest, Real{1}, Real{2});
}

}  // namespace sazare::methods::blocks
