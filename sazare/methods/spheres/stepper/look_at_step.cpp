/// How much of a stable step the contacts take that spheres have now.

#include <algorithm>
#include <utility>

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

namespace {

/// A contact on a body of another rank.
struct BorderContact {
  std::size_t level = 0, tile = 0;
  ContactPoint at;
};

}  // namespace

void SphereStepper::look_at_step() {
  if (looked_at_step_ == step_) return;
  looked_at_step_ = step_;
  LoadedBodies bodies{spheres_, clumps_, clump_at_, {}, place_};
  if (ranks_ != nullptr) bodies.is_own = [this](std::size_t sphere) { return owner_of_body(sphere) == ranks_->ranks().rank(); };
  const OthersContacts of_others = contacts_of_others();
  std::vector<HeavyLoad> heaviest =
      heaviest_loads(bodies, walls_.table(), [&](const auto& visit) { visit_contacts(of_others, visit); });
  if (ranks_ != nullptr) heaviest = ranks_->join(heaviest, parallel::Topic::changes);
  const StepLoad now = largest_step_load(std::move(heaviest));
  if (now.load > step_load_.load) step_load_ = now;
}

/// All ranks call it.
SphereStepper::OthersContacts SphereStepper::contacts_of_others() const {
  if (ranks_ == nullptr) return {};
  std::vector<std::vector<BorderContact>> to_each(static_cast<std::size_t>(ranks_->ranks().size()));
  OthersContacts of_others{ContactsByTile(levels_.count()), ContactsByTile(levels_.count())};
  for (std::size_t level = 0; level < levels_.count(); ++level) {
    const std::size_t tiles = ranks_->owners().tiles();
    of_others.pairs[level].resize(tiles);
    of_others.walls[level].resize(tiles);
    const auto send = [&](std::size_t tile, const ContactPoint& at) {
      const int own = ranks_->ranks().rank(), first = owner_of_body(at.first), second = owner_of_body(at.second);
      if (first != own) to_each[static_cast<std::size_t>(first)].push_back({level, tile, at});
      if (second != own && second != first) to_each[static_cast<std::size_t>(second)].push_back({level, tile, at});
    };
    for (const std::size_t tile : ranks_->owners().own()) {
      visit_contacts_of(tile, level, [&](const ContactPoint& at) { send(tile, at); });
      visit_wall_contacts_of(tile, level, [&](const ContactPoint& at) { send(tile, at); });
    }
  }
  for (const std::vector<BorderContact>& arrived : ranks_->hand_on(std::move(to_each)))
    for (const BorderContact& contact : arrived)
      (contact.at.is_at_wall() ? of_others.walls : of_others.pairs)[contact.level][contact.tile].push_back(contact.at);
  return of_others;
}

/// The contacts of a tile's spheres with others that push.
template <class Visit>
void SphereStepper::visit_contacts_of(std::size_t tile, std::size_t level, const Visit& visit) const {
  if (tile >= levels_.pairs(level).tiles()) return;
  const Real step = levels_.step(level);
  levels_.pairs(level).visit_contacts(tile, [&](Index one, Index other, Real initial_overlap) {
    const auto first = static_cast<std::size_t>(one), second = static_cast<std::size_t>(other);
    const auto &a = spheres_.place[first], &b = spheres_.place[second];
    const Vector3 apart = spheres_.box.nearest(b.centre() - a.centre());
    const Real distance = apart.norm(), overlap = a.radius + b.radius - distance - initial_overlap;
    if (overlap > 0) visit(ContactPoint{first, second, ContactPoint::no_wall, apart / distance, overlap, step});
  });
}

/// Those with walls; with surfaces as they were last evaluated.
template <class Visit>
void SphereStepper::visit_wall_contacts_of(std::size_t tile, std::size_t level, const Visit& visit) const {
  const Real step = levels_.step(level);
  walls_.visit_contacts(spheres_, level, tile, [&](Index sphere, Index material, const Vector3& normal, Real overlap) {
    const auto first = static_cast<std::size_t>(sphere);
    visit(ContactPoint{first, first, material, normal, overlap, step});
  });
}

/// All contacts that push. Those of other ranks' tiles stand where one process would find them.
void SphereStepper::visit_contacts(const OthersContacts& of_others, const std::function<void(const ContactPoint&)>& visit) const {
  const std::size_t tiles = neighbors::tiles_of(spheres_.size());
  for (std::size_t level = 0; level < levels_.count(); ++level) {
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      visit_contacts_of(tile, level, visit);
      if (!of_others.pairs.empty()) std::ranges::for_each(of_others.pairs[level][tile], visit);
    }
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      visit_wall_contacts_of(tile, level, visit);
      if (!of_others.walls.empty()) std::ranges::for_each(of_others.walls[level][tile], visit);
    }
  }
}

}  // namespace sazare::methods::spheres
