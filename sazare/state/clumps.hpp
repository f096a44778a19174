#pragma once

/// Rigid bodies of spheres: the spheres go where the body goes, and hand it what pushes them.

#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/time.hpp"
#include "sazare/core/turn.hpp"

namespace sazare::state {

/// A body whose axes are its principal ones. Its momenta hold what each force gives until half a step after it was evaluated.
struct Clump {
  Vector3 centre = Vector3::Zero();            ///< [m]
  Vector3 velocity = Vector3::Zero();          ///< [m/s]
  Vector3 angular_momentum = Vector3::Zero();  ///< about its centre [kg m2/s]
  Turn<Real> turn{1, 0, 0, 0};                 ///< from its own axes to those of space
  Real mass = 0;                               ///< [kg]
  Vector3 inertia = Vector3::Zero();           ///< about its own axes [kg m2]
  Vector3 impulse_ahead = Vector3::Zero();     ///< what its momentum lacks at its time [N s]
  Vector3 turning_ahead = Vector3::Zero();     ///< what its angular momentum lacks [N m s]
  Real volume = 0;                             ///< [m3]
  Real added_mass = 0;                         ///< of water that goes along with its centre [kg]
  std::int64_t first_member = 0;               ///< its members end where those of the next begin

  Real moved_mass() const { return mass + added_mass; }
  /// A vector of its own axes as space sees it, and back.
  Vector3 out(const Vector3& own) const { return turned(turn, own); }
  Vector3 into(const Vector3& space) const { return turned<Real>({turn.w, -turn.x, -turn.y, -turn.z}, space); }
  Vector3 spin_of(const Vector3& momentum) const {
    const Vector3 own = into(momentum);
    return out(own.cwiseQuotient(inertia));
  }
};

struct ClumpMember {
  Index sphere = 0;    ///< its number
  Index unused = 0;    // no gaps: checkpoints are compared byte by byte
  Vector3 place = Vector3::Zero();  ///< of its centre, by the axes of the clump [m]
};

struct Clumps {
  std::vector<Clump> clumps;
  std::vector<ClumpMember> members;  ///< by clump

  bool empty() const { return clumps.empty(); }
  std::size_t begin_of(std::size_t clump) const { return static_cast<std::size_t>(clumps[clump].first_member); }
  std::size_t end_of(std::size_t clump) const { return clump + 1 < clumps.size() ? begin_of(clump + 1) : members.size(); }
  std::span<const ClumpMember> members_of(std::size_t clump) const {
    return std::span(members).subspan(begin_of(clump), end_of(clump) - begin_of(clump));
  }

  void columns(Archive& archive) {
    archive("clumps", clumps);
    archive("members", members);
  }
};

}  // namespace sazare::state
