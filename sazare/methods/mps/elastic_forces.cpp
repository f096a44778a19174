#include "sazare/methods/mps/elastic_forces.hpp"

#include <utility>

#include "sazare/core/lane_math.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 128;  // blocks; one takes about half a microsecond, waking a thread some microseconds

template <int D>
using LaneComponents = laws::Components<D, Lanes>;

/// The particles of a block and their neighbours in one direction.
template <int D>
class Block {
 public:
  Block(const state::Particles<D>& particles, std::size_t block) : particles_(particles), begin_(block * lane_count) {
    for (std::size_t i = 0; i < D; ++i) displacement_[i] = own(particles.displacement[i]);
    for (std::size_t i = 0; i < rotation_.size(); ++i) rotation_[i] = own(particles.rotation[i]);
  }

  Lanes own(const state::Column& column) const { return load_lanes(&column[begin_]); }

  void look(const typename LinkTable<D>::Direction& direction) {
    const Index first = direction.first[begin_ / lane_count];
    in_a_row_ = first >= 0;
    first_ = static_cast<std::size_t>(in_a_row_ ? first : 0);
    places_ = &direction.neighbor[begin_];
  }

  Lanes others(const state::Column& column) const {
    return in_a_row_ ? load_lanes(&column[first_]) : gather_lanes(column.data(), places_);
  }

  template <RotationRemoval removal>
  laws::LinkStrain<D, Lanes> strain(const laws::LinkDirection<D>& law) const {
    std::array<Lanes, state::rotation_numbers<D>> mean;
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5 * (rotation_[i] + others(particles_.rotation[i]));
    if constexpr (removal == RotationRemoval::mean_angle) {
      const Lanes scale = 1.0 / square_root(mean[0] * mean[0] + mean[1] * mean[1]);
      for (Lanes& number : mean) number *= scale;
    }
    return laws::link_strain<D, Lanes>(apart(law), turned(mean, law));
  }

  /// R r0 for the particles' own rotation where that is what turns the link, else for the mean angle's.
  template <RotationRemoval removal>
  LaneComponents<D> arm(const laws::LinkStrain<D, Lanes>& strain, const laws::LinkDirection<D>& law) const {
    if constexpr (removal == RotationRemoval::mean_rotation) return turned(rotation_, law);
    LaneComponents<D> mean = apart(law);
    for (std::size_t i = 0; i < D; ++i) mean[i] -= strain.deformation[i];
    return mean;
  }

 private:
  /// r, which a missing neighbour (the particle itself) leaves as it began.
  LaneComponents<D> apart(const laws::LinkDirection<D>& law) const {
    LaneComponents<D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = law.start[i] + (others(particles_.displacement[i]) - displacement_[i]);
    return result;
  }

  static LaneComponents<D> turned(const std::array<Lanes, state::rotation_numbers<D>>& rotation, const laws::LinkDirection<D>& law) {
    LaneComponents<D> arm{};
    if constexpr (D == 2) {
      arm[0] = rotation[0] * law.start[0] - rotation[1] * law.start[1];
      arm[1] = rotation[1] * law.start[0] + rotation[0] * law.start[1];
    } else {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) arm[i] += rotation[3 * i + k] * law.start[k];
    }
    return arm;
  }

  const state::Particles<D>& particles_;
  std::size_t begin_;
  LaneComponents<D> displacement_;
  std::array<Lanes, state::rotation_numbers<D>> rotation_;
  bool in_a_row_ = false;
  std::size_t first_ = 0;
  const Index* places_ = nullptr;
};

/// Volume strain of the particles of a block.
template <int D, RotationRemoval removal>
Lanes volume_strain(const state::Particles<D>& particles, const LinkTable<D>& links, std::size_t block) {
  Block<D> at(particles, block);
  Lanes sum{};
  for (const auto& direction : links.directions) {
    if (direction.pattern[block] == 0) continue;
    at.look(direction);
    const Lanes share = links.patterns[static_cast<std::size_t>(direction.pattern[block])].lanes;
    sum += share * direction.law.divergence * at.template strain<removal>(direction.law).stretch;
  }
  return sum;
}

inline Lanes moment(const LaneComponents<2>& arm, const LaneComponents<2>& force, std::size_t) {
  return arm[0] * force[1] - arm[1] * force[0];
}
inline Lanes moment(const LaneComponents<3>& arm, const LaneComponents<3>& force, std::size_t axis) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  return arm[next] * force[last] - arm[last] * force[next];
}

/// Forces and torques on the particles of a block, as accelerations.
template <int D, RotationRemoval removal>
void block_accelerations(const state::Particles<D>& particles, const LinkTable<D>& links, const state::Column& pressure,
                         std::size_t block, state::FreedomColumns<D>& acceleration) {
  Block<D> at(particles, block);
  const Lanes own_modulus = at.own(particles.shear_modulus), own_pressure = at.own(pressure);
  std::array<Lanes, state::particle_freedoms<D>> sum{};
  for (const auto& direction : links.directions) {
    if (direction.pattern[block] == 0) continue;
    at.look(direction);
    const Lanes share = links.patterns[static_cast<std::size_t>(direction.pattern[block])].lanes;
    const auto strain = at.template strain<removal>(direction.law);
    const Lanes spring = share * direction.law.spring * 0.5 * (own_modulus + at.others(particles.shear_modulus));
    const Lanes push = share * direction.law.divergence * (own_pressure + at.others(pressure));
    const auto force = laws::link_force<D, Lanes>(strain, spring, push);
    const LaneComponents<D> arm = at.template arm<removal>(strain, direction.law);
    for (std::size_t i = 0; i < D; ++i) sum[i] += force.force[i];
    for (std::size_t i = D; i < sum.size(); ++i) sum[i] += 0.5 * moment(arm, force.turning, i - D);
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    store_lanes(&acceleration[i][block * lane_count], sum[i] * at.own(particles.inverse_inertia_of(i)));
}

}  // namespace

template <int D>
ElasticForces<D>::ElasticForces(LinkTable<D> links, RotationRemoval removal) : links_(std::move(links)), removal_(removal) {}

template <int D>
template <RotationRemoval removal>
void ElasticForces<D>::evaluate_with(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) {
  pressure_.resize(particles.padded());
  const std::size_t blocks = particles.padded() / lane_count;
  const Real volume = particles.volume();
  parallel::parallel_for(blocks, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const Lanes strain = volume_strain<D, removal>(particles, links_, block);
      store_lanes(&pressure_[block * lane_count], volume * load_lanes(&particles.lame[block * lane_count]) * strain);
    }
  });
  parallel::parallel_for(blocks, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block)
      block_accelerations<D, removal>(particles, links_, pressure_, block, acceleration);
  });
}

template <int D>
void ElasticForces<D>::evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) {
  if constexpr (D == 2)
    if (removal_ == RotationRemoval::mean_angle) return evaluate_with<RotationRemoval::mean_angle>(particles, acceleration);
  evaluate_with<RotationRemoval::mean_rotation>(particles, acceleration);
}

template <int D>
Real ElasticForces<D>::energy(const state::Particles<D>& particles) {
  const bool mean_angle = D == 2 && removal_ == RotationRemoval::mean_angle;
  Real total = 0;
  for (std::size_t block = 0; block < particles.padded() / lane_count; ++block) {
    Block<D> at(particles, block);
    Lanes energy{}, divergence{};
    for (const auto& direction : links_.directions) {
      if (direction.pattern[block] == 0) continue;
      at.look(direction);
      const Lanes share = links_.patterns[static_cast<std::size_t>(direction.pattern[block])].lanes;
      const auto strain = [&] {
        if constexpr (D == 2)
          if (mean_angle) return at.template strain<RotationRemoval::mean_angle>(direction.law);
        return at.template strain<RotationRemoval::mean_rotation>(direction.law);
      }();
      const Lanes spring = direction.law.spring * 0.5 * (at.own(particles.shear_modulus) + at.others(particles.shear_modulus));
      // Half of a link's energy: its other particle has the other half.
      energy += share * 0.25 * spring * laws::product<D, Lanes>(strain.deformation, strain.deformation);
      divergence += share * direction.law.divergence * strain.stretch;
    }
    energy += 0.5 * particles.volume() * at.own(particles.lame) * divergence * divergence;
    for (int lane = 0; lane < lane_count; ++lane) total += energy[lane];
  }
  return total;
}

template class ElasticForces<2>;
template class ElasticForces<3>;

}  // namespace sazare::methods::mps
