/// What links store, have lost and remember.

#include <algorithm>
#include <string>

#include "sazare/methods/rectangles/face_links.hpp"

namespace sazare::methods::rectangles {

bool FaceLinks::has_broken(Index number) const {
  const Index place = damaged_of_[at(number)];
  if (place == none) return false;
  const auto begin = springs_.begin() + first_spring_[at(place)];
  return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(kind_of(number).springs.places.size()),
                     [](const laws::SpringState& spring) { return !spring.whole; });
}

Index FaceLinks::broken_springs() const {
  return static_cast<Index>(std::ranges::count(springs_, false, &laws::SpringState::whole));
}

Real FaceLinks::elastic_energy(const state::Particles<2>& particles) const {
  Real total = 0;
  for (std::size_t number = 0; number < links_.size(); ++number) {
    const Index place = damaged_of_[number];
    if (is_open(static_cast<Index>(number)) || (!is_whole(number) && place == none)) continue;
    const FaceKind& kind = kinds_[at(links_[number].kind)];
    const laws::FaceMotion<Real> motion = motion_of(particles, number);
    for (std::size_t i = 0; i < kind.springs.places.size(); ++i) {
      const laws::SpringState spring =
          place == none ? laws::SpringState{slip_[number], 0, 0, true, true} : springs_[at(first_spring_[at(place)]) + i];
      if (!spring.joined) continue;
      const laws::Facet<Real> springs = springs_of(static_cast<Index>(number));
      const Real closing = motion.closing + motion.slope * kind.springs.places[i];
      const Real elastic = laws::elastic_shear(kind.formula, spring.slip, motion.shear, motion.shear_rate, 0);
      total += 0.5 * (springs.normal * closing * closing + springs.shear * elastic * elastic);
    }
  }
  return total;
}

SpringLosses FaceLinks::losses() const {
  SpringLosses total;
  for (const Real loss : dashpot_loss_) total.dashpot += loss;
  for (const SpringLosses& loss : damaged_loss_) {
    total.dashpot += loss.dashpot;
    total.friction += loss.friction;
    total.fracture += loss.fracture;
  }
  return total;
}

void FaceLinks::columns(Archive& archive) {
  archive("slip", slip_);
  archive("whole", whole_);
  archive("dashpot_loss", dashpot_loss_);
  for (std::size_t k = 0; k < 3; ++k) archive("last_rate" + std::to_string(k), last_rate_[k]);
  archive("open", open_);
  archive("damaged", damaged_);
  archive("damaged_of", damaged_of_);
  archive("first_spring", first_spring_);
  archive("springs", springs_);
  archive("damaged_loss", damaged_loss_);
  archive("just_opened", just_opened_);
  archive("broken_links", open_links_);
  for (auto* column : {&slots_.force_x, &slots_.force_y, &slots_.first_moment, &slots_.second_moment})
    for (std::size_t i = 0; i < column->size() && archive.reading(); ++i) (*column)[i] = 0;
}

}  // namespace sazare::methods::rectangles
