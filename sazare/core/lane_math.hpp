#pragma once

/// Columns in memory to and from lanes, and functions of lanes.

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include "sazare/core/lanes.hpp"
#include "sazare/core/time.hpp"

namespace sazare {

/// Numbers of a column at `lane_count` places.
inline Lanes gather_lanes(const Real* column, const Index* places) {
#ifdef __AVX512F__
  return _mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(places)), column, sizeof(Real));
#else
  Lanes lanes;
  for (int lane = 0; lane < lane_count; ++lane) lanes[lane] = column[places[lane]];
  return lanes;
#endif
}

/// `lane_count` places of columns. Places in a row are read in one piece, which takes a fraction of a gather's time.
class LanePlaces {
public:
  explicit LanePlaces(const Index* places) : places_(places), in_a_row_(true) {
    for (int lane = 1; lane < lane_count; ++lane) in_a_row_ = in_a_row_ & (places[lane] == places[0] + lane);
  }
  Lanes of(const Real* column) const { return in_a_row_ ? load_lanes(column + places_[0]) : gather_lanes(column, places_); }

private:
  const Index* places_;
  bool in_a_row_;
};

struct SineCosine {
  Lanes sine;
  Lanes cosine;
};

/// Sine and cosine of angles up to 1e6 rad, within 2e-16 + 1e-16 |angle|. Polynomials of FreeBSD's k_sin.c and k_cos.c after
/// a reduction to [-pi/4, pi/4] by multiples of pi/2 in two parts.
inline SineCosine sine_cosine(Lanes angle) {
  constexpr Real shift = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to a whole number
  constexpr Real two_over_pi = 0.63661977236758134308;
  constexpr Real half_pi_high = 1.57079632673412561417, half_pi_low = 6.07710050650619224932e-11;
  const Lanes quadrant = (angle * two_over_pi + shift) - shift;
  const Lanes x = (angle - quadrant * half_pi_high) - quadrant * half_pi_low;
  const Lanes z = x * x;
  const Lanes sine =
      x + x * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const Lanes cosine =
      1 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)))));
  // Quadrant modulo 4, as numbers -2, -1, 0, 1, 2.
  const Lanes turn = quadrant - 4 * ((quadrant * 0.25 + shift) - shift);
  const Lanes odd = turn * turn;  // 0, 1 or 4
  const LaneMask swapped = odd == 1.0;
  const LaneMask sine_negative = swapped ? turn < 0.0 : odd == 4.0;
  const LaneMask cosine_negative = swapped ? turn > 0.0 : odd == 4.0;
  const Lanes s = swapped ? cosine : sine, c = swapped ? sine : cosine;
  return {sine_negative ? -s : s, cosine_negative ? -c : c};
}

}  // namespace sazare
