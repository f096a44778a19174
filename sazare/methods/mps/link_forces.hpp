#pragma once

/// The forces of all links, whatever the frames of the particles are. Each particle evaluates all its own links, in the order of
/// the table, in two passes: volume strains, then forces. Results do not depend on the number of threads.

#include "sazare/methods/mps/link_pack.hpp"

namespace sazare::methods::mps {

/// D x D numbers of every particle, by rows.
template <int D>
using Tensors = std::array<state::Column, static_cast<std::size_t>(D) * D>;

/// Accelerations of all particles [m/s2], [rad/s2]; `pressure` is left with V lambda div of every particle [N m; N in 2-D].
/// `virial`, unless null, is left with the derivative of the energy by the frame of every particle, the other sign: half of the sum
/// of (k u + S e) r0^T over its links [N m; N in 2-D].
template <int D, std::size_t N>
void evaluate_links(const LinkTable<D>& links, RotationRemoval removal, const state::Particles<D>& particles,
                    const Frames<N>& frames, state::Column& pressure, state::FreedomColumns<D>& acceleration,
                    Tensors<D>* virial = nullptr);

/// For every particle the sum over its links of d w/(n0 |r0|^2) r r0^T, from which its strain follows.
template <int D>
void measure_stretch(const LinkTable<D>& links, const state::Particles<D>& particles, Tensors<D>& stretch);

/// Energy of the links of a pack of particles, half of each, and of their volume strains [J; J/m in 2-D].
template <int D, std::size_t N>
Real energy_of_pack(const LinkTable<D>& links, const state::Particles<D>& particles, const Frames<N>& frames, std::size_t pack);

/// Energy stored in all links [J; J/m in 2-D].
template <int D, std::size_t N>
Real energy_of_links(const LinkTable<D>& links, RotationRemoval removal, const state::Particles<D>& particles,
                     const Frames<N>& frames);

}  // namespace sazare::methods::mps
