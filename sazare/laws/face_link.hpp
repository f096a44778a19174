#pragma once

/// Two straight faces joined by N springs and dashpots: the link of two pseudo-rectangle elements, or of an element and a wall.
///
///     u(xi) = a + b xi                   displacement of the normal spring at xi, closing is positive [m]     (2.1), (14.1)
///     v                                  displacement of the shear springs [m]                                (2.2), (14.2)
///     P_i = K_n u(xi_i) + eta_n u'(xi_i) force of a normal spring and its dashpot [N]                         (6.1), (7.1)
///     Q_i = K_s v + eta_s v'             force of a shear spring and its dashpot [N]                          (6.2), (7.2)
///     xi_i = (2i - 1 - N)/N, or +-1      places of the springs over half of the face                          (13.1), (13.2)
///
///     n, s    from the first element to the second, and 90 degrees to the right of that
///     theta   rotation of an element since they were joined [rad]
///     r1, r2  distance of the face from the centres [m]       r   half of the face [m]
///
/// Formula `exact` (2), (3): n turns with the mean of both rotations, and with half of their difference d = (theta_1 - theta_2)/2
///
///     a = (r1 + r2) cos d - n.(x2 - x1),   b = 2 r sin d,   v = -s.(x2 - x1) + (r2 - r1) sin d
///
/// A face whose middle stands e1 and e2 along s beside the two centres, as in an irregular packing, adds (e1 + e2) sin d to a
/// and (e1 - e2) cos d to v.
///
/// Formula `small` (14), (15): n along the line of centres, D its length, l_i = D r_i/(r1 + r2)
///
///     a = r1 + r2 - D,   b = r (theta_1 - theta_2),   v' = s.(x1' - x2') - l_1 theta_1' - l_2 theta_2'
///
/// and of a wall, where r1 = 0, n is the wall's and D the distance from it.
///
/// Formula `older` is (16): v' without the translations s.(x1' - x2'); for comparison only.
///
/// [Matsui1999]. Deviations: forces and moments are the exact derivatives of the springs' energy (work of the force for v of
/// (15)). The paper's (12) takes the arms r and r xi of the unturned face, which is the same to first order. Its n is that of
/// the first element or of the wall; turned by the mean rotation the link does not feel a common rotation, and v is the same
/// for all springs. Its (2.2) with (2.4) counts r theta twice; here it counts once.

#include <cstddef>
#include <type_traits>
#include <vector>

#include "sazare/core/vector_of.hpp"

namespace sazare::laws {

enum class FaceFormula { exact, small, older };

/// Where the springs of a face stand: in the middles of N equal parts, or at its two ends.
enum class SpringPlaces { centres, ends };

/// Springs of a face and what they bear, each.
struct FaceSprings {
  Real first_reach = 0;      ///< r1 [m]
  Real second_reach = 0;     ///< r2 [m]
  Real half_face = 0;        ///< r [m]
  Real normal = 0;           ///< K_n [N/m]
  Real shear = 0;            ///< K_s [N/m]
  Real normal_damping = 0;   ///< eta_n [N s/m]
  Real shear_damping = 0;    ///< eta_s [N s/m]
  Real tension_limit = 0;    ///< sigma_t A/N [N]
  Real cohesion_limit = 0;   ///< c A/N [N]
  Real friction = 0;         ///< tan phi
  std::vector<Real> places;  ///< xi

  static constexpr bool is_eccentric = false;

  /// The first element is a wall: its face goes through its centre, and n is its own.
  bool is_wall() const { return first_reach == 0; }
  Real count() const { return static_cast<Real>(places.size()); }
  Real last_place() const { return places.back(); }
  Real square_sum() const {
    Real sum = 0;
    for (const Real xi : places) sum += xi * xi;
    return sum;
  }
};

/// The face of one link of an irregular packing, of springs that have its own strengths; `T` is Real or Lanes.
template <class T>
struct Facet {
  T first_reach{}, second_reach{};      ///< r1, r2 [m]
  T first_shift{}, second_shift{};      ///< e1, e2 [m]
  T half_face{};                        ///< r [m]
  T normal{}, shear{};                  ///< K_n, K_s [N/m]
  T normal_damping{}, shear_damping{};  ///< eta_n, eta_s [N s/m]
  T tension_limit{}, cohesion_limit{};  ///< [N]
  Real friction = 0;                    ///< tan phi

  static constexpr bool is_eccentric = true;
  static bool is_wall() { return false; }
};

/// (13.1) and (13.2).
inline std::vector<Real> spring_places(SpringPlaces layout, int count) {
  if (layout == SpringPlaces::ends) return {-1, 1};
  std::vector<Real> places;
  for (int i = 1; i <= count; ++i) places.push_back(static_cast<Real>(2 * i - 1 - count) / count);
  return places;
}

/// Where two elements are and how they move; `T` is Real or Lanes.
template <class T>
struct FacePair {
  VectorOf<T, 2> apart;                    ///< x2 - x1 [m]
  VectorOf<T, 2> approach;                 ///< x1' - x2' [m/s]
  T spin_sum{}, spin_difference{};         ///< theta_1' + theta_2', theta_1' - theta_2' [rad/s]
  T turn{};                                ///< theta_1 - theta_2 [rad]
  VectorOf<T, 2> first_axis, second_axis;  ///< n as each element has turned it; formula exact, and walls
};

/// What the springs of a link do, linear along the face, and the arms of their forces.
template <class T>
struct FaceMotion {
  VectorOf<T, 2> normal;           ///< n; s is (n_y, -n_x)
  T closing{}, slope{};            ///< a, b [m]
  T closing_rate{}, slope_rate{};  ///< a', b' [m/s]
  T shear{};                       ///< v of formula exact [m]
  T shear_rate{};                  ///< v' [m/s]
  T offset{};                      ///< arm of the normal force that turns both alike [m]
  T lag{}, arm{};                  ///< of u(xi): (lag + arm xi) is its derivative by half of the difference of the spins [m]
  T first_arm{}, second_arm{};     ///< l_1, l_2 [m]
};

/// `Face` is FaceSprings or Facet<T>, the latter with formula exact only.
template <FaceFormula formula, class T, class Face>
FaceMotion<T> face_motion(const FacePair<T>& pair, const Face& face) {
  static_assert(formula == FaceFormula::exact || !Face::is_eccentric);
  FaceMotion<T> motion;
  const auto reach = face.first_reach + face.second_reach;
  if constexpr (formula == FaceFormula::exact) {
    const T x = 0.5 * (pair.first_axis[0] + pair.second_axis[0]), y = 0.5 * (pair.first_axis[1] + pair.second_axis[1]);
    const T cosine = square_root(x * x + y * y), inverse = 1.0 / cosine;
    const T sine = 0.5 * inverse * (pair.first_axis[1] * pair.second_axis[0] - pair.first_axis[0] * pair.second_axis[1]);
    motion.normal = {x * inverse, y * inverse};
    const T along = motion.normal[0] * pair.apart[0] + motion.normal[1] * pair.apart[1];
    const T across = motion.normal[1] * pair.apart[0] - motion.normal[0] * pair.apart[1];
    const auto difference = face.second_reach - face.first_reach;
    motion.closing = reach * cosine - along;
    motion.slope = 2 * face.half_face * sine;
    motion.shear = difference * sine - across;
    motion.offset = 0.5 * across;
    motion.lag = -0.5 * reach * sine;
    motion.arm = face.half_face * cosine;
    motion.first_arm = 0.5 * (along - difference * cosine);
    motion.second_arm = 0.5 * (along + difference * cosine);
    if constexpr (Face::is_eccentric) {
      const T sum = face.first_shift + face.second_shift, skew = face.first_shift - face.second_shift;
      motion.closing += sum * sine;
      motion.shear += skew * cosine;
      motion.lag += 0.5 * sum * cosine;
      motion.first_arm += 0.5 * skew * sine;
      motion.second_arm -= 0.5 * skew * sine;
    }
  } else {
    T distance = square_root(pair.apart[0] * pair.apart[0] + pair.apart[1] * pair.apart[1]);
    const T inverse = 1.0 / distance;
    motion.normal = {pair.apart[0] * inverse, pair.apart[1] * inverse};
    if (face.is_wall()) {
      motion.normal = pair.first_axis;
      distance = motion.normal[0] * pair.apart[0] + motion.normal[1] * pair.apart[1];
    }
    motion.closing = reach - distance;
    motion.slope = face.half_face * pair.turn;
    motion.offset = T{};
    motion.lag = T{};
    motion.arm = T{} + face.half_face;
    motion.first_arm = distance * (face.first_reach / reach);
    motion.second_arm = distance * (face.second_reach / reach);
  }
  const T along = motion.normal[0] * pair.approach[0] + motion.normal[1] * pair.approach[1];
  const T across = motion.normal[1] * pair.approach[0] - motion.normal[0] * pair.approach[1];
  motion.closing_rate = along + motion.offset * pair.spin_sum + motion.lag * pair.spin_difference;
  motion.slope_rate = motion.arm * pair.spin_difference;
  const T turning = 0.5 * (motion.first_arm + motion.second_arm) * pair.spin_sum +
                    0.5 * (motion.first_arm - motion.second_arm) * pair.spin_difference;
  motion.shear_rate = formula == FaceFormula::older ? -turning : across - turning;
  return motion;
}

/// On the second element; on the first the opposite force.
template <class T>
struct FaceForce {
  VectorOf<T, 2> force;               ///< [N]
  T first_moment{}, second_moment{};  ///< [N m]
};

/// From P = sum P_i, `tilt` = sum P_i xi_i and Q = sum Q_i; (12) with the arms of the turned faces.
template <class T>
FaceForce<T> face_force(const FaceMotion<T>& motion, T normal, T tilt, T shear) {
  const T turning = motion.lag * normal + motion.arm * tilt, common = motion.offset * normal;
  return {{motion.normal[0] * normal + motion.normal[1] * shear, motion.normal[1] * normal - motion.normal[0] * shear},
          motion.first_arm * shear - common - turning,
          motion.second_arm * shear - common + turning};
}

/// A spring that can break and slip; section 2 (3).
struct SpringState {
  Real slip = 0;                            ///< elastic shear displacement [m], or with formula exact what v is at rest
  Real last_rate = 0, last_shear_rate = 0;  ///< that its dashpots saw when they last acted [m/s]
  bool joined = true;                       ///< whether it acts
  bool whole = true;                        ///< never broken: only then has it strength and cohesion
};

/// What a spring does in a step, and the energy it loses.
struct SpringForce {
  Real normal = 0, shear = 0;  ///< P_i, Q_i [N]
  Real dashpot_loss = 0;       ///< [J]
  Real friction_loss = 0;      ///< [J]
  Real fracture_loss = 0;      ///< [J]
};

/// The shear displacement that a spring with the memory `slip` has elastically before it slips. `exact`: v is known, otherwise it
/// grows by v' over dt.
template <class T>
T elastic_shear(FaceFormula formula, T slip, T shear, T shear_rate, Real elapsed) {
  return formula == FaceFormula::exact ? shear - slip : slip + elapsed * shear_rate;
}

/// What a spring bears, (8) to (11); `Limit` is Real, or Lanes where every lane has limits of its own.
template <class Limit>
struct SpringStrength {
  Limit tension{};    ///< sigma_t A/N [N]
  Limit cohesion{};   ///< c A/N [N]
  Real friction = 0;  ///< tan phi
};

/// The strength of one spring of a face. A spring that has broken has neither strength nor cohesion left.
template <class Face>
auto spring_strength(const Face& face, bool whole = true) {
  using Limit = std::remove_cvref_t<decltype(face.tension_limit)>;
  return whole ? SpringStrength<Limit>{face.tension_limit, face.cohesion_limit, face.friction}
               : SpringStrength<Limit>{{}, {}, face.friction};
}

/// Whether a spring breaks under its normal force K_n u, compression positive [N]: its pull is more than its strength.
template <class Limit, class T>
auto breaks(const SpringStrength<Limit>& strength, T pressure) {
  return pressure < -strength.tension;
}

/// The shear force at which a spring slips under its normal force [N]: c A/N + K_n u tan phi, and never less than 0.
template <class Limit, class T>
T shear_limit(const SpringStrength<Limit>& strength, T pressure) {
  return maximum(strength.cohesion + strength.friction * pressure, T{});
}

/// Whether a spring slips that would have this shear force [N].
template <class T>
auto slips(T trial, T limit) {
  return maximum(trial, -trial) > limit;
}

/// Whether a spring breaks or slips of a face whose springs have all the same elastic shear displacement. The weakest one does so
/// first: the last one on the side that opens most.
template <class Face, class T>
auto yields(const Face& face, const FaceMotion<T>& motion, T elastic, Real last_place) {
  const auto strength = spring_strength(face);
  const T least = face.normal * (motion.closing - last_place * maximum(motion.slope, -motion.slope));
  const auto broken = breaks(strength, least), slipping = slips(face.shear * elastic, shear_limit(strength, least));
  return broken | slipping;  // of lanes or of one spring
}

/// Energy lost where a spring slips in a step: the mean of its forces before and after times the slip. That is the work of the
/// forces that act less what the spring gains.
inline Real slip_loss(Real before, Real trial, Real after, Real stiffness) {
  return 0.5 * (before + after) * (trial - after) / stiffness;
}

/// One spring at xi through (8) to (11): `shear` is v of formula exact.
template <class Face>
SpringForce advance_spring(SpringState& spring, const Face& face, FaceFormula formula, const FaceMotion<Real>& motion, Real xi,
                           Real elapsed) {
  const Real closing = motion.closing + motion.slope * xi, rate = motion.closing_rate + motion.slope_rate * xi;
  const auto rest = [&](Real elastic) { spring.slip = formula == FaceFormula::exact ? motion.shear - elastic : elastic; };
  SpringForce result;
  result.dashpot_loss = 0.5 * elapsed *
                        (face.normal_damping * spring.last_rate * (spring.last_rate + rate) +
                         face.shear_damping * spring.last_shear_rate * (spring.last_shear_rate + motion.shear_rate));
  spring.last_rate = spring.last_shear_rate = 0;
  if (!spring.joined) {
    if (closing < 0) return result;
    spring.joined = true;
    rest(0);
  }
  Real elastic = elastic_shear(formula, spring.slip, motion.shear, motion.shear_rate, elapsed);
  const Real pressure = face.normal * closing;
  const SpringStrength<Real> strength = spring_strength(face, spring.whole);
  if (breaks(strength, pressure)) {
    // Its force ends half a step ago: what the leapfrog had stored is the product with the displacement of a step before.
    result.fracture_loss =
        0.5 * (pressure * (closing - elapsed * rate) + face.shear * elastic * (elastic - elapsed * motion.shear_rate));
    spring.joined = spring.whole = false;
    return result;
  }
  const Real limit = shear_limit(strength, pressure), trial = face.shear * elastic;
  result.normal = pressure + face.normal_damping * rate;
  spring.last_rate = rate;
  if (slips(trial, limit)) {
    result.shear = trial < 0 ? -limit : limit;
    elastic = result.shear / face.shear;
    const Real before = trial - face.shear * elapsed * motion.shear_rate;
    result.friction_loss = slip_loss(before, trial, result.shear, face.shear);
  } else {
    result.shear = trial + face.shear_damping * motion.shear_rate;
    spring.last_shear_rate = motion.shear_rate;
  }
  rest(elastic);
  return result;
}

}  // namespace sazare::laws
