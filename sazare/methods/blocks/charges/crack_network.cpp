#include "sazare/methods/blocks/charges/crack_network.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sazare::methods::blocks {

namespace {

constexpr Real atmosphere = 101325;  // gas of a lower pressure enters no crack [Pa]
constexpr Real unbounded = std::numeric_limits<Real>::infinity();

}  // namespace

CrackNetwork::CrackNetwork(const ChargeGas& charges, GasFaces faces)
    : faces_(std::move(faces)),
      paths_(faces_.between, faces_.outer),
      charges_(&charges),
      taken_(charges.charges().size()),
      state_of_(faces_.between.size(), unseen) {
  for (const Charge& charge : charges.charges()) gases_.push_back({charge.gas, charge.density, charge.cracks.discharge});
  for (Index number = 0; number < paths_.edge_count(); ++number) {
    const CrackPaths::Edge edge = paths_.edge(number);
    if (std::ranges::any_of(edge.walls, [&](Index wall) {
          return charges.charges()[at(charges.faces()[at(wall)].charge)].cracks.gas != GasInCracks::none;
        }))
      for (const Index face : edge.faces) wait(face);
  }
}

std::array<Vector3, 3> CrackNetwork::corners_of(const GasCrack& crack) const {
  const auto& nodes = face_of(crack).nodes;
  return {faces_.nodes[at(nodes[0])], faces_.nodes[at(nodes[1])], faces_.nodes[at(nodes[2])]};
}

Real CrackNetwork::pressure(const GasCrack& crack, Real volume, Real work) const {
  if (charges_->charges()[at(crack.charge)].cracks.gas == GasInCracks::share) return crack.pressure;
  return gas_pressure(gases_[at(crack.charge)], volume, crack.mass, crack.energy - work);
}

void CrackNetwork::change(Index number, Real work, Real volume, Real width, Real apart) {
  GasCrack& crack = cracks_[at(number)];
  taken_[at(crack.charge)].work += work;
  if (charges_->charges()[at(crack.charge)].cracks.gas == GasInCracks::flow) {
    crack.energy -= work;
    taken_[at(crack.charge)].held -= work;
  }
  crack.volume = volume;
  crack.width = width;
  crack.apart = apart;
}

void CrackNetwork::end(Index number) {
  GasCrack& crack = cracks_[at(number)];
  TakenByCracks& taken = taken_[at(crack.charge)];
  crack.state = is_open_to_air(number) ? CrackGasState::gone : CrackGasState::hole;
  taken.held -= crack.energy;
  if (crack.state == CrackGasState::gone) {
    taken.lost += crack.energy;
    crack.volume = 0;
  } else {
    taken.mass -= crack.mass;
    if (charges_->charges()[at(crack.charge)].cracks.gas == GasInCracks::flow) taken.room += crack.volume;
  }
  crack.mass = crack.energy = crack.pressure = crack.sound = 0;
}

bool CrackNetwork::is_open_to_air(Index number) const {
  const GasCrack& own = crack(number);
  return std::ranges::any_of(paths_.edges_of(own.face), [&](Index at_edge) {
    const CrackPaths::Edge edge = paths_.edge(at_edge);
    return edge.is_free || std::ranges::any_of(edge.faces, [&](Index face) {
             const Index other = state_of_[at(face)];
             return other >= 0 && crack(other).charge == own.charge && crack(other).state == CrackGasState::gone;
           });
  });
}

bool CrackNetwork::is_reached(Index wall, Real time) const {
  const ChargedFace& face = charges_->faces()[at(wall)];
  return face.part.covered_by(charges_->charges()[at(face.charge)].burnt(time)) > 0;
}

/// The charge whose gas presses most on the edges of a face, or -1; of equal ones the first.
OpeningFace CrackNetwork::filled_by(Index face, std::span<const ChargeState> holes, Real time) const {
  OpeningFace found{face, -1};
  Real highest = atmosphere;
  const auto consider = [&](Index charge, Real pressure) {
    if (!(pressure > highest) || charges_->charges()[at(charge)].cracks.gas == GasInCracks::none) return;
    highest = pressure;
    found.charge = charge;
  };
  for (const Index number : paths_.edges_of(face)) {
    const CrackPaths::Edge edge = paths_.edge(number);
    for (const Index wall : edge.walls)
      if (const Index charge = charges_->faces()[at(wall)].charge; is_reached(wall, time))
        consider(charge, holes[at(charge)].pressure);
    for (const Index other : edge.faces)
      if (state_of_[at(other)] >= 0) {
        const GasCrack& crack = cracks_[at(state_of_[at(other)])];
        consider(crack.charge, crack.state == CrackGasState::hole ? holes[at(crack.charge)].pressure : crack.pressure);
      }
  }
  return found;
}

std::vector<OpeningFace> CrackNetwork::opening(std::span<const ChargeState> holes, Real time,
                                               const std::function<bool(Index)>& is_apart) const {
  std::vector<OpeningFace> found;
  for (const Index face : waiting_) {
    if (!is_apart(face)) continue;
    if (const OpeningFace filled = filled_by(face, holes, time); filled.charge >= 0) found.push_back(filled);
  }
  return found;
}

void CrackNetwork::wait(Index face) {
  if (state_of_[at(face)] != unseen) return;
  state_of_[at(face)] = waiting;
  waiting_.push_back(face);
}

void CrackNetwork::add(const OpeningFace& opening, Real volume, Real width) {
  const auto number = static_cast<Index>(cracks_.size());
  cracks_.push_back({.face = opening.face, .charge = opening.charge, .volume = volume, .width = width});
  state_of_[at(opening.face)] = number;
  join(number);
  for (const Index edge : paths_.edges_of(opening.face))
    for (const Index face : paths_.edge(edge).faces) wait(face);
}

/// Finds what a crack meets at its edges, of those that have opened before it.
void CrackNetwork::join(Index number) {
  const GasCrack& crack = cracks_[at(number)];
  const auto& nodes = face_of(crack).nodes;
  for (std::size_t k = 0; k < 3; ++k) {
    const CrackPaths::Edge edge = paths_.edge(paths_.edges_of(crack.face)[k]);
    const Real length = (faces_.nodes[at(nodes[(k + 1) % 3])] - faces_.nodes[at(nodes[k])]).norm();
    for (const Index face : edge.faces)
      if (const Index other = state_of_[at(face)]; other >= 0 && other < number && cracks_[at(other)].charge == crack.charge)
        meetings_.push_back({number, other, -1, length});
    const auto wall =
        std::ranges::find_if(edge.walls, [&](Index face) { return charges_->faces()[at(face)].charge == crack.charge; });
    if (wall != edge.walls.end()) meetings_.push_back({number, Opening::outside, *wall, length});
    if (edge.is_free) meetings_.push_back({number, Opening::outside, -1, length});
  }
}

void CrackNetwork::spread(std::span<const ChargeState> holes, Real time, Real span) {
  std::erase_if(waiting_, [&](Index face) { return state_of_[at(face)] >= 0; });
  for (std::size_t charge = 0; charge < holes.size(); ++charge) {
    const GasInCracks gas = charges_->charges()[charge].cracks.gas;
    if (gas == GasInCracks::share) share(charge, holes[charge]);
    if (gas == GasInCracks::flow && span > 0) flow(charge, holes[charge], time, span);
  }
}

/// The hole and its cracks are one vessel.
void CrackNetwork::share(std::size_t charge, const ChargeState& hole) {
  Real room = 0;
  const Real share = charges_->charges()[charge].cracks.share;
  for (GasCrack& crack : cracks_) {
    if (at(crack.charge) != charge || crack.state == CrackGasState::gone) continue;
    if (crack.has_gas()) crack.pressure = share * hole.pressure;
    room += share * crack.volume;
  }
  taken_[charge].room = room;
}

void CrackNetwork::flow(std::size_t charge, const ChargeState& hole, Real time, Real span) {
  const FlowingGas& gas = gases_[charge];
  std::vector<GasVessel> vessels = {{.volume = hole.volume, .width = unbounded, .mass = hole.mass, .energy = hole.energy()}};
  std::vector<Index> vessel_of(cracks_.size(), Opening::outside);
  for (std::size_t i = 0; i < cracks_.size(); ++i) {
    const GasCrack& crack = cracks_[i];
    if (at(crack.charge) != charge || crack.state == CrackGasState::gone) continue;
    if (crack.state == CrackGasState::hole) {
      vessel_of[i] = 0;
      continue;
    }
    vessel_of[i] = static_cast<Index>(vessels.size());
    vessels.push_back({.volume = crack.volume, .width = crack.width, .mass = crack.mass, .energy = crack.energy});
  }
  const std::vector<Opening> openings = find_openings(charge, vessel_of, time);
  for (const Opening& opening : openings)
    for (const Index vessel : {opening.first, opening.second})
      if (vessel != Opening::outside) ++vessels[at(vessel)].openings;
  for (GasVessel& vessel : vessels) gas.settle(vessel);
  const GasAmount left = blocks::flow(gas, vessels, openings, span);
  TakenByCracks& taken = taken_[charge];
  taken.lost += left.energy;
  taken.mass += hole.mass - vessels[0].mass;
  taken.held = 0;
  for (std::size_t i = 0; i < cracks_.size(); ++i) {
    if (vessel_of[i] <= 0) continue;
    const GasVessel& vessel = vessels[at(vessel_of[i])];
    cracks_[i].mass = vessel.mass;
    cracks_[i].energy = vessel.energy;
    cracks_[i].pressure = vessel.pressure;
    cracks_[i].sound = vessel.sound;
    taken.held += vessel.energy;
  }
}

/// Between the vessels of a charge, of which the first is its hole, with what has become a part of it. What met a crack whose gas
/// is gone meets the air.
std::vector<Opening> CrackNetwork::find_openings(std::size_t charge, std::span<const Index> vessel_of, Real time) const {
  std::vector<Opening> openings;
  for (const Meeting& meeting : meetings_) {
    if (at(crack(meeting.crack).charge) != charge || (meeting.wall >= 0 && !is_reached(meeting.wall, time))) continue;
    const Index first = vessel_of[at(meeting.crack)];
    const Index second = meeting.wall >= 0 ? 0 : meeting.other < 0 ? Opening::outside : vessel_of[at(meeting.other)];
    if (first == second) continue;
    const bool is_second = first < 0;  // the one that has gas comes first
    const Real width = std::min(crack(meeting.crack).width, meeting.other < 0 ? unbounded : crack(meeting.other).width);
    openings.push_back({is_second ? second : first, is_second ? first : second, meeting.length, width});
  }
  return openings;
}

void CrackNetwork::columns(Archive& archive) {
  archive("cracks", cracks_);
  archive("waiting", waiting_);
  archive("taken", taken_);
  if (!archive.reading()) return;
  std::ranges::fill(state_of_, unseen);
  for (const Index face : waiting_) state_of_[at(face)] = waiting;
  meetings_.clear();
  for (Index number = 0; number < static_cast<Index>(cracks_.size()); ++number) {
    state_of_[at(cracks_[at(number)].face)] = number;
    join(number);
  }
}

}  // namespace sazare::methods::blocks
