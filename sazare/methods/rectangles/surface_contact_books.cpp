/// Energies and checkpoints of SurfaceContacts.

#include <algorithm>
#include <type_traits>

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
  // A list that every element near the surface has, and a record of each, one behind the other.
  const auto lists = [&](const std::string& name, auto member) {
    std::vector<std::int64_t> sizes;
    std::remove_reference_t<decltype(Near{}.*member)> all;
    for (Near& near : near_) {
      sizes.push_back(static_cast<std::int64_t>((near.*member).size()));
      all.insert(all.end(), (near.*member).begin(), (near.*member).end());
    }
    archive(name + "_sizes", sizes);
    archive(name, all);
    auto next = all.begin();
    for (std::size_t i = 0; archive.reading() && i < near_.size(); ++i) {
      (near_[i].*member).assign(next, next + sizes[i]);
      next += sizes[i];
    }
  };
  lists("segments", &Near::segments);
  lists("touches", &Near::touches);
  lists("points", &Near::points);
  const auto records = [&](const std::string& name, auto member) {
    std::vector<std::remove_cvref_t<decltype(Near{}.*member)>> all;
    for (Near& near : near_) all.push_back(near.*member);
    archive(name, all);
    for (std::size_t i = 0; i < near_.size(); ++i) near_[i].*member = all[i];
  };
  records("element", &Near::element);
  records("force", &Near::force);
  records("dashpot", &Near::dashpot);
  records("dashpot_power", &Near::dashpot_power);
  records("elastic", &Near::elastic);
  records("loss", &Near::loss);
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
