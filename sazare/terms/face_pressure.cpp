#include "sazare/terms/face_pressure.hpp"

#include <numeric>

#include "sazare/parallel/threads.hpp"

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
}

std::vector<Index> FacePressure::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void FacePressure::evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  std::vector<Real> pressures;
  for (const PressureLoad& load : loads_) pressures.push_back(pressure_at(load, now.seconds()));
  parallel::parallel_for(due.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (const Due& at : due.subspan(begin, end - begin)) {
      PressedFace& face = faces_[static_cast<std::size_t>(at.link)];
      const auto& body = bodies.motion[static_cast<std::size_t>(face.body)];
      const Vector3 arm = body.rotation * face.centre;
      const PressureLoad& load = loads_[static_cast<std::size_t>(face.load)];
      if ((body.position + arm - face.start).norm() > load.cut_distance) face.acts = 0;
      const Vector3 force = (-pressures[static_cast<std::size_t>(face.load)] * face.acts) * (body.rotation * face.area);
      const PairForce<3> push{arm.cross(force), -force, Vector3::Zero()};
      write<3, 1>(table_[at.link], now, at, push, {push});
    }
  });
}

void FacePressure::add_energies(const Synchronized<3>& at, Books& books) const {
  for (std::size_t face = 0; face < faces_.size(); ++face)
    if (at.counts(links_[face])) table_.take_back(static_cast<Index>(face), links_[face], at, books);
}

void FacePressure::carry(Index link, Parcel& parcel) {
  parcel(faces_[static_cast<std::size_t>(link)].acts);
  parcel(table_[link]);
}

void FacePressure::columns(Archive& archive) {
  archive("faces", faces_);
  archive("slots", table_.slots);
}

}  // namespace sazare::terms
