#pragma once

/// What the links of a pack of particles are like now: several particles at a time, one direction of the lattice after the
/// other.

#include "sazare/core/lane_math.hpp"
#include "sazare/methods/mps/link_table.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::methods::mps {

/// How the rotation is taken out of a link's deformation.
enum class RotationRemoval {
  mean_rotation,  ///< by the mean of the two rotations, (12)
  mean_angle,     ///< by the rotation of the mean angle, (11); 2-D only
};

/// Numbers that a frame of D x D numbers takes by rows, or a rotation in 2-D its cosine and sine.
template <std::size_t N>
using Frames = std::array<state::Column, N>;

/// The particles of a pack and their neighbours in one direction. A particle's frame turns (and, where it has flowed, stretches)
/// the links as they began.
template <int D, std::size_t N>
class LinkPack {
public:
  LinkPack(const state::Particles<D>& particles, const Frames<N>& frames, std::size_t pack)
      : particles_(particles), frames_(frames), begin_(pack * lane_count) {
    for (int i = 0; i < D; ++i) displacement_[i] = own(particles.displacement[static_cast<std::size_t>(i)]);
    for (std::size_t i = 0; i < N; ++i) frame_[i] = own(frames[i]);
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
    std::array<Lanes, N> mean;
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5 * (frame_[i] + others(frames_[i]));
    if constexpr (removal == RotationRemoval::mean_angle) {
      const Lanes scale = 1.0 / square_root(mean[0] * mean[0] + mean[1] * mean[1]);
      for (Lanes& number : mean) number *= scale;
    }
    return laws::link_strain<D, Lanes>(apart(law), turned(mean, law));
  }

  /// r, which a missing neighbour (the particle itself) leaves as it began.
  VectorOf<Lanes, D> apart(const laws::LinkDirection<D>& law) const {
    VectorOf<Lanes, D> result;
    for (int i = 0; i < D; ++i)
      result[i] = law.start[i] + (others(particles_.displacement[static_cast<std::size_t>(i)]) - displacement_[i]);
    return result;
  }

  /// The link as it began in the particles' own frame where that is what turns it, else in the mean angle's.
  template <RotationRemoval removal>
  VectorOf<Lanes, D> arm(const laws::LinkStrain<D, Lanes>& strain, const laws::LinkDirection<D>& law) const {
    if constexpr (removal == RotationRemoval::mean_rotation) return turned(frame_, law);
    return apart(law) - strain.deformation;
  }

private:
  static VectorOf<Lanes, D> turned(const std::array<Lanes, N>& frame, const laws::LinkDirection<D>& law) {
    VectorOf<Lanes, D> arm{};
    if constexpr (N == 2) {
      arm[0] = frame[0] * law.start[0] - frame[1] * law.start[1];
      arm[1] = frame[1] * law.start[0] + frame[0] * law.start[1];
    } else {
      for (int i = 0; i < D; ++i)
        for (int k = 0; k < D; ++k) arm[i] += frame[static_cast<std::size_t>(D * i + k)] * law.start[k];
    }
    return arm;
  }

  const state::Particles<D>& particles_;
  const Frames<N>& frames_;
  std::size_t begin_;
  VectorOf<Lanes, D> displacement_;
  std::array<Lanes, N> frame_;
  bool in_a_row_ = false;
  std::size_t first_ = 0;
  const Index* places_ = nullptr;
};

inline Lanes lane_moment(const VectorOf<Lanes, 2>& arm, const VectorOf<Lanes, 2>& force, int) {
  return arm[0] * force[1] - arm[1] * force[0];
}
inline Lanes lane_moment(const VectorOf<Lanes, 3>& arm, const VectorOf<Lanes, 3>& force, int axis) {
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  return arm[next] * force[last] - arm[last] * force[next];
}

}  // namespace sazare::methods::mps
