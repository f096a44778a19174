#include "sazare/levels/terms/face_pressure.hpp"

#include <algorithm>
#include <numeric>

#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/state/body_lanes.hpp"

namespace sazare::terms {

namespace {

Real pressure_at(const PressureLoad& load, Real time) {
  const Real since = time - load.delay;
  if (const auto* pulse = std::get_if<laws::BlastPressure>(&load.history)) return laws::blast_pressure(*pulse, since);
  if (const auto* table = std::get_if<laws::PressureTable>(&load.history)) return laws::table_pressure(*table, since);
  return laws::table_pressure(*std::get<std::shared_ptr<const laws::PressureTable>>(load.history), since);
}

}  // namespace

FacePressure::FacePressure(std::vector<PressureLoad> loads, std::vector<PressedFace> faces, const state::Bodies<3>& bodies)
    : loads_(std::move(loads)), faces_(std::move(faces)) {
  for (const PressedFace& face : faces_) links_.push_back({face.body, Link::outside});
  table_.causes = {Cause::load};
  table_.slots.resize(faces_.size());
  table_.incidence = FixedIncidence(bodies.size(), links_);
  strain_table_ = {bodies, faces_.size()};
}

std::vector<Index> FacePressure::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void FacePressure::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  pressures_.resize(loads_.size());
  std::ranges::transform(loads_, pressures_.begin(), [&](const PressureLoad& load) { return pressure_at(load, now.seconds()); });
  parallel::parallel_for(due.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += lane_count)
      evaluate_lanes(now, due.subspan(i, std::min<std::size_t>(lane_count, end - i)), bodies);
  });
}

/// Evaluates as many faces as there are lanes, or fewer.
[[gnu::flatten]] void FacePressure::evaluate_lanes(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  const LaneDue in_lanes = terms::in_lanes(due);
  LanePointers<PressedFace> faces;
  LanePointers<const state::Motion<3>> motions;
  LanePointers<Slot<3, 0>> slots;
  Lanes pressure{}, cut{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    PressedFace& face = faces_[static_cast<std::size_t>(in_lanes[lane].link)];
    const auto load = static_cast<std::size_t>(face.load);
    faces[lane] = &face;
    motions[lane] = &bodies.motion[static_cast<std::size_t>(face.body)];
    slots[lane] = &table_[in_lanes[lane].link];
    pressure[static_cast<int>(lane)] = pressures_[load];
    cut[static_cast<int>(lane)] = loads_[load].cut_distance;
  }
  const auto n = load_records<12>(faces);
  const LaneVector area{{n[0], n[1], n[2]}}, centre{{n[4], n[5], n[6]}}, start{{n[8], n[9], n[10]}};
  const auto [position, rotation] = state::load_places(motions);
  const LaneVector arm = rotation * centre, moved = position + arm - start;
  const LaneMask acts = (n[3] > 0.0) & ~(dot(moved, moved) > cut * cut);
  if (any(~acts))
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      if (acts[static_cast<int>(lane)] == 0) faces[lane]->acts = 0;
  const LaneVector push = select(acts, pressure, Lanes{}) * (rotation * area);  // on the outside, the second body
  if (strain_table_.exists) {
    std::array<Vector3, lane_count> pushes;
    for (int lane = 0; lane < lane_count; ++lane)
      pushes[static_cast<std::size_t>(lane)] = {push[0][lane], push[1][lane], push[2][lane]};
    write_strain_forces(due, pushes, bodies);
  }
  write(slots, now, in_lanes, LanePairForce::at(position - broadcast(bodies.pole) + arm, push));
}

/// A strained face keeps its area and its normal in the body frame; its centre moves with the strain, and the push acts there.
void FacePressure::write_strain_forces(std::span<const Due> due, const std::array<Vector3, lane_count>& push,
                                       const state::Bodies<3>& bodies) {
  for (std::size_t lane = 0; lane < due.size(); ++lane) {
    const PressedFace& face = faces_[static_cast<std::size_t>(due[lane].link)];
    const Matrix3& rotation = bodies.motion[static_cast<std::size_t>(face.body)].rotation;
    const Vector6 on_body = -force_on_strain(rotation.transpose() * push[lane], face.centre);
    strain_table_[due[lane].link].write(table_[due[lane].link].evaluated < 0, on_body, {});
  }
}

void FacePressure::add_energies(const Synchronized<3>& at, EnergySums& energies) const {
  for (std::size_t face = 0; face < faces_.size(); ++face)
    if (at.counts(links_[face])) {
      table_.take_back(static_cast<Index>(face), links_[face], at, energies);
      strain_table_.take_back(static_cast<Index>(face), links_[face], table_, at, energies);
    }
}

void FacePressure::carry(Index link, Parcel& parcel) {
  parcel(faces_[static_cast<std::size_t>(link)].acts);
  parcel(table_[link]);
  strain_table_.carry(link, parcel);
}

void FacePressure::columns(Archive& archive) {
  archive("faces", faces_);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
}

}  // namespace sazare::terms
