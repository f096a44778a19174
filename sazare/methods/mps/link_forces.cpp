#include "sazare/methods/mps/link_forces.hpp"

#include <cmath>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 128;  // packs; one takes about half a microsecond, waking a thread some microseconds

template <int D>
Real length_of(const laws::LinkDirection<D>& law) {
  return std::sqrt(laws::product<D, Real>(law.start, law.start));
}

/// Volume strain of the particles of a pack.
template <int D, std::size_t N, RotationRemoval removal>
Lanes volume_strain(const state::Particles<D>& particles, const Frames<N>& frames, const LinkTable<D>& links, std::size_t pack) {
  LinkPack<D, N> at(particles, frames, pack);
  Lanes sum{};
  for (const auto& direction : links.directions) {
    if (direction.pattern[pack] == 0) continue;
    at.look(direction);
    const Lanes share = links.patterns[static_cast<std::size_t>(direction.pattern[pack])].lanes;
    sum += share * direction.law.divergence * at.template strain<removal>(direction.law).stretch;
  }
  return sum;
}

template <int D>
void pack_stretch(const LinkTable<D>& links, const state::Particles<D>& particles, std::size_t pack, Tensors<D>& stretch) {
  LinkPack<D, state::rotation_numbers<D>> at(particles, particles.rotation, pack);
  std::array<Lanes, static_cast<std::size_t>(D) * D> sum{};
  for (const auto& direction : links.directions) {
    if (direction.pattern[pack] == 0) continue;
    at.look(direction);
    const Lanes share = links.patterns[static_cast<std::size_t>(direction.pattern[pack])].lanes;
    const Lanes weight = share * (direction.law.divergence / length_of<D>(direction.law));
    const VectorOf<Lanes, D> apart = at.apart(direction.law);
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) sum[D * i + k] += weight * direction.law.start[k] * apart[i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i) store_lanes(&stretch[i][pack * lane_count], sum[i]);
}

/// Forces and torques on the particles of a pack, as accelerations.
template <int D, std::size_t N, RotationRemoval removal>
void pack_accelerations(const state::Particles<D>& particles, const Frames<N>& frames, const LinkTable<D>& links,
                        const state::Column& pressure, std::size_t pack, state::FreedomColumns<D>& acceleration,
                        Tensors<D>* virial) {
  LinkPack<D, N> at(particles, frames, pack);
  const Lanes own_modulus = at.own(particles.shear_modulus), own_pressure = at.own(pressure);
  std::array<Lanes, state::particle_freedoms<D>> sum{};
  std::array<Lanes, static_cast<std::size_t>(D) * D> turning{};
  for (const auto& direction : links.directions) {
    if (direction.pattern[pack] == 0) continue;
    at.look(direction);
    const Lanes share = links.patterns[static_cast<std::size_t>(direction.pattern[pack])].lanes;
    const auto strain = at.template strain<removal>(direction.law);
    const Lanes spring = share * direction.law.spring * 0.5 * (own_modulus + at.others(particles.shear_modulus));
    const Lanes push = share * direction.law.divergence * (own_pressure + at.others(pressure));
    const auto force = laws::link_force<D, Lanes>(strain, spring, push);
    const VectorOf<Lanes, D> arm = at.template arm<removal>(strain, direction.law);
    for (std::size_t i = 0; i < D; ++i) sum[i] += force.force[i];
    for (std::size_t i = D; i < sum.size(); ++i) sum[i] += 0.5 * lane_moment(arm, force.turning, i - D);
    if (virial == nullptr) continue;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) turning[D * i + k] += (0.5 * direction.law.start[k]) * force.turning[i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    store_lanes(&acceleration[i][pack * lane_count], sum[i] * at.own(particles.inverse_inertia_of(i)));
  for (std::size_t i = 0; virial != nullptr && i < turning.size(); ++i) store_lanes(&(*virial)[i][pack * lane_count], turning[i]);
}

template <int D, std::size_t N, RotationRemoval removal>
void evaluate_with(const LinkTable<D>& links, const state::Particles<D>& particles, const Frames<N>& frames,
                   state::Column& pressure, state::FreedomColumns<D>& acceleration, Tensors<D>* virial) {
  pressure.resize(particles.padded());
  const std::size_t packs = particles.padded() / lane_count;
  const Real volume = particles.volume();
  parallel::parallel_for(packs, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pack = begin; pack < end; ++pack) {
      const Lanes strain = volume_strain<D, N, removal>(particles, frames, links, pack);
      store_lanes(&pressure[pack * lane_count], volume * load_lanes(&particles.lame[pack * lane_count]) * strain);
    }
  });
  parallel::parallel_for(packs, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pack = begin; pack < end; ++pack)
      pack_accelerations<D, N, removal>(particles, frames, links, pressure, pack, acceleration, virial);
  });
}

template <int D, std::size_t N, RotationRemoval removal>
Real pack_energy(const LinkTable<D>& links, const state::Particles<D>& particles, const Frames<N>& frames, std::size_t pack) {
  LinkPack<D, N> at(particles, frames, pack);
  Lanes energy{}, divergence{};
  for (const auto& direction : links.directions) {
    if (direction.pattern[pack] == 0) continue;
    at.look(direction);
    const Lanes share = links.patterns[static_cast<std::size_t>(direction.pattern[pack])].lanes;
    const auto strain = at.template strain<removal>(direction.law);
    const Lanes spring = direction.law.spring * 0.5 * (at.own(particles.shear_modulus) + at.others(particles.shear_modulus));
    energy += share * 0.25 * spring * laws::product<D, Lanes>(strain.deformation, strain.deformation);
    divergence += share * direction.law.divergence * strain.stretch;
  }
  energy += 0.5 * particles.volume() * at.own(particles.lame) * divergence * divergence;
  Real total = 0;
  for (int lane = 0; lane < lane_count; ++lane) total += energy[lane];
  return total;
}

}  // namespace

template <int D, std::size_t N>
void evaluate_links(const LinkTable<D>& links, RotationRemoval removal, const state::Particles<D>& particles,
                    const Frames<N>& frames, state::Column& pressure, state::FreedomColumns<D>& acceleration,
                    Tensors<D>* virial) {
  if constexpr (N == 2)
    if (removal == RotationRemoval::mean_angle)
      return evaluate_with<D, N, RotationRemoval::mean_angle>(links, particles, frames, pressure, acceleration, virial);
  evaluate_with<D, N, RotationRemoval::mean_rotation>(links, particles, frames, pressure, acceleration, virial);
}

template <int D>
void measure_stretch(const LinkTable<D>& links, const state::Particles<D>& particles, Tensors<D>& stretch) {
  parallel::parallel_for(particles.padded() / lane_count, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pack = begin; pack < end; ++pack) pack_stretch<D>(links, particles, pack, stretch);
  });
}

template <int D, std::size_t N>
Real energy_of_pack(const LinkTable<D>& links, const state::Particles<D>& particles, const Frames<N>& frames, std::size_t pack) {
  return pack_energy<D, N, RotationRemoval::mean_rotation>(links, particles, frames, pack);
}

template <int D, std::size_t N>
Real energy_of_links(const LinkTable<D>& links, RotationRemoval removal, const state::Particles<D>& particles,
                     const Frames<N>& frames) {
  Real total = 0;
  const std::size_t packs = particles.padded() / lane_count;
  if constexpr (N == 2)
    if (removal == RotationRemoval::mean_angle) {
      for (std::size_t pack = 0; pack < packs; ++pack)
        total += pack_energy<D, N, RotationRemoval::mean_angle>(links, particles, frames, pack);
      return total;
    }
  for (std::size_t pack = 0; pack < packs; ++pack) total += energy_of_pack(links, particles, frames, pack);
  return total;
}

template void evaluate_links<2, 2>(const LinkTable<2>&, RotationRemoval, const state::Particles<2>&, const Frames<2>&,
                                   state::Column&, state::FreedomColumns<2>&, Tensors<2>*);
template void evaluate_links<2, 4>(const LinkTable<2>&, RotationRemoval, const state::Particles<2>&, const Frames<4>&,
                                   state::Column&, state::FreedomColumns<2>&, Tensors<2>*);
template void evaluate_links<3, 9>(const LinkTable<3>&, RotationRemoval, const state::Particles<3>&, const Frames<9>&,
                                   state::Column&, state::FreedomColumns<3>&, Tensors<3>*);
template void measure_stretch<2>(const LinkTable<2>&, const state::Particles<2>&, Tensors<2>&);
template void measure_stretch<3>(const LinkTable<3>&, const state::Particles<3>&, Tensors<3>&);
template Real energy_of_pack<2, 4>(const LinkTable<2>&, const state::Particles<2>&, const Frames<4>&, std::size_t);
template Real energy_of_pack<3, 9>(const LinkTable<3>&, const state::Particles<3>&, const Frames<9>&, std::size_t);
template Real energy_of_links<2, 2>(const LinkTable<2>&, RotationRemoval, const state::Particles<2>&, const Frames<2>&);
template Real energy_of_links<2, 4>(const LinkTable<2>&, RotationRemoval, const state::Particles<2>&, const Frames<4>&);
template Real energy_of_links<3, 9>(const LinkTable<3>&, RotationRemoval, const state::Particles<3>&, const Frames<9>&);

}  // namespace sazare::methods::mps
