#pragma once

/// Which cracks have gas, how they are joined with each other, with holes and with the air, and what flows between them.
///
/// It changes at base steps only, and alike in all processes of a run.

#include <functional>
#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/methods/blocks/charges/charge_gas.hpp"
#include "sazare/methods/blocks/charges/crack_flow.hpp"
#include "sazare/methods/blocks/charges/crack_paths.hpp"

namespace sazare::methods::blocks {

/// Faces that gas may come to, at the beginning.
struct GasFaces {
  std::span<const Vector3> nodes;               ///< [m]; they must outlive whoever has these faces
  std::vector<geometry::InteriorFace> between;  ///< elements
  std::vector<GasOuterFace> outer;
};

/// Where the gas of a crack is.
enum class CrackGasState : std::int64_t {
  own,   ///< in it
  hole,  ///< it gapes and has become a part of the hole
  gone,  ///< it gapes and was open to the air
};

/// A crack that has gas or had, as it was at the last base step.
struct GasCrack {
  Index face = 0;     ///< between elements
  Index charge = 0;   ///< whose gas it has
  Real mass = 0;      ///< of the gas [kg]
  Real energy = 0;    ///< of the gas [J]
  Real volume = 0;    ///< [m3]
  Real width = 0;     ///< for gas [m]
  Real apart = 0;     ///< distance of its faces, see crack_gas.hpp [m]
  Real pressure = 0;  ///< [Pa]
  Real sound = 0;     ///< its velocity [m/s]
  CrackGasState state = CrackGasState::own;

  bool has_gas() const { return state == CrackGasState::own; }
};

/// A face that has come apart, and the charge whose gas enters it.
struct OpeningFace {
  Index face = 0, charge = 0;
};

class CrackNetwork {
public:
  CrackNetwork(const ChargeGas& charges, GasFaces faces);

  std::span<const GasCrack> cracks() const { return cracks_; }
  const GasCrack& crack(Index number) const { return cracks_[at(number)]; }
  Index face_count() const { return static_cast<Index>(faces_.between.size()); }
  const geometry::InteriorFace& face(Index number) const { return faces_.between[at(number)]; }
  const geometry::InteriorFace& face_of(const GasCrack& crack) const { return face(crack.face); }
  std::array<Vector3, 3> corners_of(const GasCrack& crack) const;
  const TakenByCracks& taken(std::size_t charge) const { return taken_[charge]; }

  /// Pressure of the gas of a crack in a volume [m3], after so much work since the last base step [J].
  Real pressure(const GasCrack& crack, Real volume, Real work) const;

  /// What has happened to a crack since the last base step: its gas has done so much work [J], and it has become so wide
  /// [m3; m; m].
  void change(Index crack, Real work, Real volume, Real width, Real apart);
  /// Ends a crack that gapes: where it is open to the air its gas is gone, elsewhere it adds its room and its gas to the hole.
  void end(Index crack);

  /// Faces that have come apart beside gas.
  std::vector<OpeningFace> opening(std::span<const ChargeState> holes, Real time,
                                   const std::function<bool(Index)>& is_apart) const;
  /// Makes one a crack, without gas as yet, so wide [m3; m].
  void add(const OpeningFace& opening, Real volume, Real width);

  /// Lets the gas of all charges spread for a time [s]; the holes are as they were before it.
  void spread(std::span<const ChargeState> holes, Real time, Real span);

  void columns(Archive& archive);

private:
  /// Where a crack meets another one, the wall of its hole, or the air.
  struct Meeting {
    Index crack = 0;
    Index other = Opening::outside;
    Index wall = -1;  ///< number of a charged face
    Real length = 0;  ///< of the edge [m]
  };
  enum State : Index { unseen = -2, waiting = -1 };  ///< of a face, else the number of its crack

  bool is_reached(Index wall, Real time) const;
  OpeningFace filled_by(Index face, std::span<const ChargeState> holes, Real time) const;
  void wait(Index face);
  void join(Index crack);
  bool is_open_to_air(Index crack) const;
  void share(std::size_t charge, const ChargeState& hole);
  void flow(std::size_t charge, const ChargeState& hole, Real time, Real span);
  std::vector<Opening> find_openings(std::size_t charge, std::span<const Index> vessel_of, Real time) const;

  GasFaces faces_;
  CrackPaths paths_;
  const ChargeGas* charges_;
  std::vector<FlowingGas> gases_;     ///< of the charges
  std::vector<TakenByCracks> taken_;  ///< of the charges
  std::vector<Index> state_of_;       ///< of faces
  std::vector<Index> waiting_;        ///< faces beside walls and cracks, which may open
  std::vector<GasCrack> cracks_;      ///< in the order in which they opened
  std::vector<Meeting> meetings_;
};

}  // namespace sazare::methods::blocks
