#pragma once

/// Forces of ground that meets a surface whose nodes move: its own, and those of the contact.

#include <memory>
#include <optional>

#include "sazare/methods/mps/failing_forces.hpp"
#include "sazare/methods/mps/surface_contacts.hpp"
#include "sazare/particles/particle_forces.hpp"

namespace sazare::methods::mps {

template <int D>
class GroundAtSurface final : public particles::ParticleForces<D> {
public:
  /// `failing` is `ground`, where that has a strength; `waves` by particle.
  GroundAtSurface(std::unique_ptr<particles::ParticleForces<D>> ground, const FailingForces<D>* failing,
                  std::vector<WaveVelocities> waves, const SurfaceRules& rules)
      : ground_(std::move(ground)), failing_(failing), waves_(std::move(waves)), rules_(rules) {}

  /// Adds the surface, before the first evaluation or a resume [m]; until then there is none.
  void attach(const state::Particles<D>& particles, std::vector<Vector3> nodes, std::vector<std::array<Index, 3>> faces) {
    contacts_.emplace(particles, waves_, rules_, std::move(nodes), std::move(faces));
  }
  void lead(std::vector<Vector3> from, std::vector<Vector3> with) { contacts_->lead(std::move(from), std::move(with)); }
  /// Before the beginning: its nodes stand here from now on [m].
  void put_surface(std::vector<Vector3> nodes) { contacts_->put(std::move(nodes)); }

  void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) override {
    ground_->evaluate(particles, acceleration);
    const auto is_linked = [this](Index particle) { return failing_ == nullptr || !failing_->gathered().holds(particle); };
    if (!contacts_) return;
    contacts_->evaluate(particles, is_linked);
    contacts_->add_forces(1, acceleration);
  }
  void add_undamped(Real factor, state::FreedomColumns<D>& acceleration) const override {
    ground_->add_undamped(factor, acceleration);
    if (contacts_) contacts_->add_forces(factor, acceleration);
  }
  Real energy(const state::Particles<D>& particles) override {
    return ground_->energy(particles) + (contacts_ ? contacts_->energy() : 0);
  }
  void columns(Archive& archive) override {
    archive.folder("ground", [&] { ground_->columns(archive); });
    if (contacts_) archive.folder("surface", [&] { contacts_->columns(archive); });
  }

  /// Nullptr where there is none yet.
  const SurfaceContacts<D>* surface() const { return contacts_ ? &*contacts_ : nullptr; }

private:
  std::unique_ptr<particles::ParticleForces<D>> ground_;
  const FailingForces<D>* failing_;
  std::vector<WaveVelocities> waves_;
  SurfaceRules rules_;
  std::optional<SurfaceContacts<D>> contacts_;
};

}  // namespace sazare::methods::mps
