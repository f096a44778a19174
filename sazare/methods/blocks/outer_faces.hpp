#pragma once

/// Springs and dashpots between the outer faces of blocks and the ground: held, driven, frictionless and absorbing boundaries.
///
///     f = -A (k_n u_n + c_n v_n) n - A (k_s u_t + c_s v_t)     at each of the three corners, A a third of the face,
///                                                              u and v relative to the ground
///
/// fixed: as if bonded to unbreakable ground; frictionless: the normal part alone; absorbing: c_n = rho c_P, c_s = rho c_S
/// (Lysmer and Kuhlemeyer 1969) with the wave speeds that the joints imply over the block's own height; an incident wave v_in
/// enters through them as ground that moves with 2 v_in, which makes f = -A c (v - 2 v_in). Initial tractions of the ground act
/// beside them, unchanged; their work counts as energy of the ground.
///
/// Dashpots hold nothing: until time begins such a face may stand on springs. What these carry in the end it carries as a
/// traction.
///
/// Ground that moves does work on the blocks: the force of a face times the displacement of the ground over the time for which
/// the force is given. Its share in what moves the dashpots is dissipated there.

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "sazare/laws/ground_motion.hpp"
#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/rates/joint_rates.hpp"

namespace sazare::methods::blocks {

/// Ground by its motion along each axis; it stands still along the others.
using MovingGround = std::array<std::optional<laws::GroundMotion>, 3>;

struct OuterFace {
  Index body = 0;
  Index boundary = 0;            ///< which of the boundaries it belongs to
  FaceSprings springs;           ///< corners in the body frame
  std::array<Vector3, 3> place;  ///< of the corners at the beginning [m]
  Vector3 normal;                ///< outward, at the beginning
  std::array<Vector3, 3> traction = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};  ///< initial, on the corners [Pa]
  std::optional<FaceSprings> later = std::nullopt;  ///< which take the place of `springs` at the beginning of time
};

/// Where a body is and how it moves.
struct BodyMotion {
  state::Pose<3> pose;
  Vector3 velocity, spin;  ///< [m/s], [rad/s]
  Vector6 strain = Vector6::Zero(), strain_rate = Vector6::Zero();
};

/// How far the ground has moved [m], and its velocity [m/s].
struct GroundState {
  Vector3 displacement, velocity;
};

class OuterFaces final : public terms::Term<3> {
public:
  /// The ground of every boundary that the faces name.
  OuterFaces(std::vector<OuterFace> faces, std::vector<MovingGround> ground, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "boundaries"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  bool acts_on_strains() const override { return true; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override {
    strain_table_.gather(now, body, table_, sum);
  }
  terms::Rates rates(Index body) const override { return rates_[static_cast<std::size_t>(body)]; }
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override;
  void columns(Archive& archive) override;

  std::span<const OuterFace> faces() const { return faces_; }

  /// Time begins, where bodies stand: faces that stood on springs until now let go. Returns the bodies that have such faces.
  std::vector<Index> let_go(const state::Bodies<3>& bodies);

  /// Adds what the dashpots of each boundary have dissipated, as the energy balance counts it, of the bodies that `owns` names;
  /// `work_on` is their work by boundaries so far [J]. A body with faces on several boundaries divides it by their areas.
  void add_dissipated(const terms::Synchronized<3>& at, const std::function<bool(Index)>& owns,
                      const std::function<Real(Index)>& work_on, std::span<ExactSum> by_boundary) const;

  /// Force of each boundary on the bodies at a time [s] at which they move so [N].
  std::vector<Vector3> forces(Real time, const std::function<BodyMotion(Index)>& motion_of) const;

private:
  /// What the ground has done through a face.
  struct GroundWork {
    Vector3 given_until;  ///< displacement of the ground at the end of the time for which the force is given [m]
    Real work;            ///< on the bodies and their springs [J]
    Real dissipated;      ///< part of it that goes into the dashpots [J]
  };
  std::vector<terms::Rates> find_rates(const state::Bodies<3>& bodies, bool later) const;
  bool has_held() const { return !rates_later_.empty(); }
  void take_later_springs();
  GroundState ground_at(Index boundary, Real time) const;
  std::vector<GroundState> ground_at(Real time) const;
  Vector3 displacement_ahead(std::size_t face, const GroundState& ground) const {
    return ground_work_[face].given_until - ground.displacement;  // by what is given beyond now
  }
  Real dissipated_by_ground(std::size_t face, const GroundState& ground) const;
  void evaluate_one(const Instant& now, const Due& due, const GroundState& ground, const state::Bodies<3>& bodies);
  void count_work(const Due& due, const Instant& now, const GroundState& ground_now);

  std::vector<MovingGround> ground_;     ///< by boundary
  std::vector<GroundWork> ground_work_;  ///< by face; empty where all ground stands still
  std::vector<OuterFace> faces_;
  std::vector<Link> links_;
  std::vector<terms::Rates> rates_;
  std::vector<terms::Rates> rates_later_;  ///< none where no face stands on springs until time begins
  terms::SlotTable<3, 1, terms::FixedIncidence> table_;
  terms::StrainTable<1, 1> strain_table_;
};

}  // namespace sazare::methods::blocks
