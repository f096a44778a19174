#include "sazare/methods/rectangles/rectangle_forces.hpp"

#include <utility>

#include "sazare/core/lane_math.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::rectangles {

namespace {

constexpr std::size_t serial_below = 256;  // packs

geometry::Faces face_bit(int face) { return geometry::Faces{1} << face; }

}  // namespace

RectangleForces::RectangleForces(const state::Particles<2>& particles, Parts parts, Real step)
    : outlines_(std::move(parts.outlines)),
      links_(particles, std::move(parts.kinds), std::move(parts.links), std::move(parts.facets)),
      contacts_(parts.contact, particles, outlines_),
      base_friction_(parts.base_friction),
      step_(step) {
  for (Index number = 0; number < links_.count(); ++number) {
    if (links_.is_padding(number)) continue;
    outlines_.exposed[static_cast<std::size_t>(links_.link(number).first)] &= ~face_bit(links_.first_face(number));
    outlines_.exposed[static_cast<std::size_t>(links_.link(number).second)] &= ~face_bit(links_.second_face(number));
  }
  radius_.assign(particles.padded(), 0);
  for (std::size_t i = 0; i < outlines_.size(); ++i) radius_[i] = outlines_.spring_radius(i);
  if (base_friction_.coefficient > 0) {
    for (state::Column* column : {&base_work_, &base_power_, &base_force_[0], &base_force_[1], &base_force_[2]})
      column->assign(particles.padded(), 0);
  }
  support_force_.resize(static_cast<std::size_t>(parts.supports));
  support_place_.resize(support_force_.size());
}

void RectangleForces::add_surface(const state::Particles<2>& particles, const std::vector<Vector3>& nodes,
                                  std::vector<SurfaceContacts::Segment> segments) {
  surface_.emplace(contacts_.rules(), nodes, std::move(segments), particles, outlines_);
}

void RectangleForces::expose(const FaceLinks& links, std::span<const Index> opened, state::Outlines& outlines) {
  for (const Index number : opened) {
    outlines.exposed[static_cast<std::size_t>(links.link(number).first)] |= face_bit(links.first_face(number));
    outlines.exposed[static_cast<std::size_t>(links.link(number).second)] |= face_bit(links.second_face(number));
  }
}

void RectangleForces::evaluate(const state::Particles<2>& particles, state::FreedomColumns<2>& acceleration) {
  const Real elapsed = begun_ ? step_ : 0;
  links_.evaluate(particles, elapsed);
  if (!links_.opened().empty()) {
    expose(links_, links_.opened(), outlines_);
    contacts_.forget_pairs();
  }
  contacts_.evaluate(particles, outlines_, links_, elapsed);
  if (surface_) surface_->evaluate(particles, outlines_, contacts_.has_searched(), elapsed);
  gather(particles, acceleration);
  sum_up_supports(particles);
  begun_ = true;
}

void RectangleForces::gather(const state::Particles<2>& particles, state::FreedomColumns<2>& acceleration) {
  parallel::parallel_for(particles.padded() / lane_count, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pack = begin; pack < end; ++pack) {
      std::array<Lanes, 3> sum{};
      links_.gather(pack, sum);
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const std::size_t i = pack * lane_count + lane;
        if (i >= outlines_.size() || !is_touched(i)) continue;
        std::array<Real, 3> own{};
        contacts_.add_to(i, own);
        if (surface_ && surface_->has(i)) surface_->add_to(i, own);
        for (std::size_t freedom = 0; freedom < 3; ++freedom) sum[freedom][lane] += own[freedom];
      }
      if (base_friction_.coefficient > 0) add_base_friction(particles, pack, sum);
      for (std::size_t freedom = 0; freedom < 3; ++freedom)
        store_lanes(&acceleration[freedom][pack * lane_count],
                    sum[freedom] * load_lanes(&particles.inverse_inertia_of(freedom)[pack * lane_count]));
    }
  });
}

void RectangleForces::add_base_friction(const state::Particles<2>& particles, std::size_t pack, std::array<Lanes, 3>& sum) {
  const std::size_t i = pack * lane_count;
  const Lanes radius = load_lanes(&radius_[i]), inverse_mass = load_lanes(&particles.inverse_mass[i]);
  const Lanes x = load_lanes(&particles.velocity[0][i]) - base_friction_.velocity.x();
  const Lanes y = load_lanes(&particles.velocity[1][i]) - base_friction_.velocity.y();
  const Lanes turning = radius * load_lanes(&particles.velocity[2][i]);
  const Real press = base_friction_.coefficient * base_friction_.gravity;
  const Lanes speed = square_root(x * x + y * y + turning * turning), least = broadcast(press * step_);
  const Lanes weight = select(inverse_mass > 0.0, press / inverse_mass, Lanes{});
  const Lanes factor = -weight / maximum(speed, least);
  const std::array<Lanes, 3> force = {factor * x, factor * y, (2.0 / 3.0) * radius * factor * turning};
  // The work of the last forces, by the mean of the velocities before and after.
  Lanes last_power = load_lanes(&base_power_[i]), power{};
  for (std::size_t freedom = 0; freedom < 3; ++freedom) {
    const Lanes velocity = load_lanes(&particles.velocity[freedom][i]);
    last_power += load_lanes(&base_force_[freedom][i]) * velocity;
    power += force[freedom] * velocity;
    store_lanes(&base_force_[freedom][i], force[freedom]);
    sum[freedom] += force[freedom];
  }
  store_lanes(&base_power_[i], power);
  store_lanes(&base_work_[i], load_lanes(&base_work_[i]) + (begun_ ? 0.5 * step_ : 0) * last_power);
}

/// The work of a support between two steps: the mean of its forces times its way.
void RectangleForces::sum_up_supports(const state::Particles<2>& particles) {
  const std::size_t first = outlines_.size() - support_force_.size();
  for (std::size_t k = 0; k < support_force_.size(); ++k) {
    std::array<Real, 3> force{};
    contacts_.add_to(first + k, force);
    const std::array<Real, 3> place = {particles.displacement[0][first + k], particles.displacement[1][first + k],
                                       particles.angle[first + k]};
    for (std::size_t freedom = 0; begun_ && freedom < 3; ++freedom)
      support_work_ -= 0.5 * (force[freedom] + support_force_[k][freedom]) * (place[freedom] - support_place_[k][freedom]);
    support_force_[k] = force;
    support_place_[k] = place;
  }
}

Real RectangleForces::energy(const state::Particles<2>& particles) {
  return links_.elastic_energy(particles) + contacts_.elastic_energy() + (surface_ ? surface_->elastic_energy() : 0);
}

EnergyParts RectangleForces::energy_parts(const state::Particles<2>& particles) const {
  EnergyParts energies;
  energies.links = links_.losses();
  energies.contacts = contacts_.losses();
  energies.elastic = links_.elastic_energy(particles) + contacts_.elastic_energy();
  for (std::size_t i = 0; i < outlines_.size() && !base_work_.empty(); ++i)
    energies.base_friction += base_work_[i];  // without the padding
  energies.supports = support_work_;
  if (!surface_) return energies;
  energies.elastic += surface_->elastic_energy();
  energies.contacts.dashpot += surface_->losses().dashpot;
  energies.contacts.friction += surface_->losses().friction;
  energies.surface = surface_->work();
  return energies;
}

void RectangleForces::columns(Archive& archive) {
  archive.folder("links", [&] { links_.columns(archive); });
  archive.folder("contacts", [&] { contacts_.columns(archive); });
  if (surface_) archive.folder("surface", [&] { surface_->columns(archive); });
  archive("exposed", outlines_.exposed);
  archive("base_work", base_work_);
  archive("base_power", base_power_);
  for (std::size_t freedom = 0; freedom < 3; ++freedom) archive("base_force" + std::to_string(freedom), base_force_[freedom]);
  archive("support_force", support_force_);
  archive("support_place", support_place_);
  archive("support_work", support_work_);
  int begun = begun_ ? 1 : 0;
  archive("begun", begun);
  begun_ = begun != 0;
}

}  // namespace sazare::methods::rectangles
