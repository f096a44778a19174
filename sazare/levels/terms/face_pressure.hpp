#pragma once

/// Pressure on faces of bodies. It follows its face: the normal turns with the body, the area stays the original one.

#include <limits>
#include <memory>
#include <variant>
#include <vector>

#include "sazare/core/lanes.hpp"
#include "sazare/laws/blast_pressure.hpp"
#include "sazare/laws/pressure_table.hpp"
#include "sazare/levels/terms/slot_table.hpp"

namespace sazare::terms {

struct PressureLoad {
  Real delay = 0;  ///< [s]
  std::variant<laws::BlastPressure, laws::PressureTable, std::shared_ptr<const laws::PressureTable>> history;
  Real cut_distance = std::numeric_limits<Real>::infinity();  ///< the load leaves a face for good this far out [m]
};

/// Lanes read it four numbers at a time, in the order of its members.
struct alignas(32) PressedFace {
  Vector3 area;    ///< outward vector with the length of the area, in the body frame [m2]
  Real acts = 1;   ///< 0 once cut off
  Vector3 centre;  ///< in the body frame [m]
  Index body = 0;
  Index load = 0;
  Vector3 start;  ///< place of the centre at the beginning [m]
  Real unused = 0;
};
static_assert(sizeof(PressedFace) == 12 * sizeof(Real));

class FacePressure final : public Term<3> {
public:
  FacePressure(std::vector<PressureLoad> loads, std::vector<PressedFace> faces, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "pressure"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<Impulse<3>> sum,
              CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  bool acts_on_strains() const override { return true; }
  void gather_strain(const Instant& now, Index body, StrainGathered& sum) const override {
    strain_table_.gather(now, body, table_, sum);
  }
  Rates rates(Index) const override { return {}; }
  void add_energies(const Synchronized<3>& at, EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override;
  void columns(Archive& archive) override;

private:
  void evaluate_lanes(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies);
  void write_strain_forces(std::span<const Due> due, const std::array<Vector3, lane_count>& push, const state::Bodies<3>& bodies);

  std::vector<PressureLoad> loads_;
  std::vector<Real> pressures_;  ///< of the loads, at the last evaluation [Pa]
  std::vector<PressedFace> faces_;
  std::vector<Link> links_;
  SlotTable<3, 0, FixedIncidence> table_;
  StrainTable<1, 0> strain_table_;
};

}  // namespace sazare::terms
