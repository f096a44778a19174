#include "sazare/methods/blocks/outer_faces.hpp"

#include <map>
#include <numeric>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

/// Stress of a spring or dashpot pair for a displacement or velocity [Pa].
Vector3 stress(const Vector3& normal, Real across, Real along, const Vector3& motion) {
  const Vector3 normal_part = normal.dot(motion) * normal;
  return across * normal_part + along * (motion - normal_part);
}

}  // namespace

OuterFaces::OuterFaces(std::vector<OuterFace> faces, const state::Bodies<3>& bodies)
    : faces_(std::move(faces)), rates_(static_cast<std::size_t>(bodies.size())) {
  std::map<Index, BodyMatrices> matrices;
  for (const OuterFace& face : faces_) {
    links_.push_back({face.body, Link::outside});
    add_face(matrices[face.body], face.springs);
  }
  for (const auto& [body, sum] : matrices) {
    const auto at = static_cast<std::size_t>(body);
    rates_[at] = largest_rates(sum, bodies.inertia[at], state::start_rotation(bodies, body), bodies.locks[at]);
  }
  table_.causes = {terms::Cause::boundary};
  table_.slots.resize(faces_.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
}

std::vector<Index> OuterFaces::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void OuterFaces::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (const Due& at : due.subspan(begin, end - begin)) {
      const OuterFace& face = faces_[static_cast<std::size_t>(at.link)];
      const FaceSprings& springs = face.springs;
      const auto& body = bodies.motion[static_cast<std::size_t>(face.body)];
      terms::PairForce<3> total, dashpots;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vector3 arm = body.rotation * springs.corners[corner];
        const Vector3 moved = body.position + arm - face.place[corner];
        const Real area = springs.corner_area;
        const Vector3 spring = area * stress(face.normal, springs.normal_stiffness, springs.shear_stiffness, moved);
        const Vector3 dashpot = area * stress(face.normal, springs.normal_damping, springs.shear_damping, body.velocity_at(arm));
        const Vector3 point = body.position - bodies.pole + arm;
        dashpots.add_at(point, dashpot);  // the ground is the second body
        total.add_at(point, spring + dashpot - area * face.traction[corner]);
      }
      terms::write<3, 1>(table_[at.link], now, at, total, {dashpots});
    }
  });
}

void OuterFaces::add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (!at.counts(links_[i])) continue;
    const OuterFace& face = faces_[i];
    const auto& body = at.pose_of(face.body);
    table_.take_back(static_cast<Index>(i), links_[i], at, energies);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3 moved = body.position + body.rotation * face.springs.corners[corner] - face.place[corner];
      energies[terms::EnergyKind::elastic] +=
          face.springs.corner_area *
          (0.5 * moved.dot(stress(face.normal, face.springs.normal_stiffness, face.springs.shear_stiffness, moved)) -
           face.traction[corner].dot(moved));
    }
  }
}

}  // namespace sazare::methods::blocks
