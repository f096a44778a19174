/// Energies and checkpoints of SurfaceContacts.

#include <algorithm>

#include "sazare/core/member_archive.hpp"
#include "sazare/methods/rectangles/surface_contacts.hpp"

namespace sazare::methods::rectangles {

Index SurfaceContacts::touching() const {
  std::size_t count = 0;
  for (const Near& near : near_) count += near.touches.size();
  return static_cast<Index>(count);
}

Real SurfaceContacts::elastic_energy() const {
  Real total = 0;
  for (const Near& near : near_) {
    total += near.elastic;
    for (const Touch& touch : near.touches) total += touch.energy;
  }
  return total;
}

SpringLosses SurfaceContacts::losses() const {
  SpringLosses total = past_losses_;
  for (const Near& near : near_) {
    total.dashpot += near.loss.dashpot;
    total.friction += near.loss.friction;
  }
  return total;
}

void SurfaceContacts::columns(Archive& archive) {
  archive.folder("nodes", [&] { nodes_.columns(archive); });
  std::vector<Real> numbers{time_, drift_, past_losses_.dashpot, past_losses_.friction, past_work_, searched_ ? 1.0 : 0.0};
  archive("numbers", numbers);
  std::int64_t count = static_cast<std::int64_t>(near_.size());
  archive("near", count);
  near_.resize(static_cast<std::size_t>(count));
  archive_lists(archive, "segments", near_, &Near::segments);
  archive_lists(archive, "touches", near_, &Near::touches);
  archive_lists(archive, "points", near_, &Near::points);
  archive_members(archive, "element", near_, &Near::element);
  archive_members(archive, "force", near_, &Near::force);
  archive_members(archive, "dashpot", near_, &Near::dashpot);
  archive_members(archive, "dashpot_power", near_, &Near::dashpot_power);
  archive_members(archive, "elastic", near_, &Near::elastic);
  archive_members(archive, "loss", near_, &Near::loss);
  if (!archive.reading()) return;
  time_ = numbers[0];
  drift_ = numbers[1];
  past_losses_.dashpot = numbers[2];
  past_losses_.friction = numbers[3];
  past_work_ = numbers[4];
  searched_ = numbers[5] != 0;
  std::ranges::fill(place_of_, -1);
  for (std::size_t i = 0; i < near_.size(); ++i) place_of_[static_cast<std::size_t>(near_[i].element)] = static_cast<Index>(i);
}

}  // namespace sazare::methods::rectangles
